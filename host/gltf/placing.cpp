#include "gltf/placing.h"

#include <algorithm>

namespace vndf::gltf {
namespace {

// Of surfaces in the world; what is in float there is what the kernels compute with.
constexpr double farthest = 1e15;                             // of a place
constexpr double smallest_area = 1e-18, largest_area = 1e18;  // twice that; their squares are ordinary floats
constexpr double thinnest = 1e-7;                             // sine of an angle that floats tell from none

static_assert(3 * sizeof(render::Vertex) + sizeof(render::Triangle) == 232);  // as limits.h says

class Placer {
  public:
    Placer(const Surface& surface, const Affine& to_world, std::uint32_t material, render::Scene& scene)
        : surface_(surface),
          to_world_(to_world),
          normals_(to_world.of_normals()),
          mirrored_(to_world.determinant() < 0),
          material_(material),
          scene_(scene),
          number_of_(surface.vertices.size(), none) {}

    void place(Corners corners, Dropped& dropped) {
        if (mirrored_) std::swap(corners[1], corners[2]);
        std::array<render::Vec, 3> places;
        bool in_range = true;
        for (int k = 0; k < 3; ++k) {
            places[k] = narrow(to_world_.point(wide(surface_.vertices[corners[k]].place)));
            for (const float x : places[k]) in_range = in_range && std::abs(x) < farthest;
        }
        if (!in_range) {
            ++dropped.out_of_range;
            return;
        }
        const Vec3 ab = wide(narrow(difference(wide(places[1]), wide(places[0])))),
                   ac = wide(narrow(difference(wide(places[2]), wide(places[0])))), normal = cross(ab, ac);
        const double area = length(normal);
        if (!(area > std::max(smallest_area, thinnest * length(ab) * length(ac)) && area < largest_area)) {
            ++dropped.without_area;
            return;
        }
        render::Triangle triangle{{}, material_};
        for (int k = 0; k < 3; ++k) triangle.corners[k] = corner(corners[k], places[k], unit(normal));
        scene_.triangles.push_back(triangle);
    }

  private:
    static constexpr std::uint32_t none = 0xFFFFFFFF;

    std::uint32_t corner(std::uint32_t local, const render::Vec& place, const Vec3& face) {
        if (number_of_[local] != none) return number_of_[local];
        const Vec3 normal = unit(normals_.direction(wide(surface_.vertices[local].normal)));
        const auto number = static_cast<std::uint32_t>(scene_.vertices.size());
        if (!is_zero(normal)) number_of_[local] = number;
        scene_.vertices.push_back(vertex(surface_.vertices[local], place, is_zero(normal) ? face : normal));
        return number;
    }

    render::Vertex vertex(render::Vertex vertex, const render::Vec& place, const Vec3& normal) const {
        vertex.place = place;
        vertex.normal = narrow(normal);
        const auto [x, y, z, sign] = vertex.tangent;
        const Vec3 tangent = unit(across(unit(to_world_.direction({x, y, z})), normal));
        const render::Vec t = narrow(tangent);
        vertex.tangent = {t[0], t[1], t[2], is_zero(tangent) ? 0.0f : mirrored_ ? -sign : sign};
        return vertex;
    }

    const Surface& surface_;
    const Affine& to_world_;
    Affine normals_;
    bool mirrored_;
    std::uint32_t material_;
    render::Scene& scene_;
    std::vector<std::uint32_t> number_of_;
};

}  // namespace

void place(const Surface& surface, const Affine& to_world, std::uint32_t material, render::Scene& scene,
           Dropped& dropped) {
    Placer placer(surface, to_world, material, scene);
    for (const Corners& triangle : surface.triangles) placer.place(triangle, dropped);
}

}  // namespace vndf::gltf
