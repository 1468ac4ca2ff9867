#include "gltf/tangents.h"

#include <algorithm>
#include <deque>
#include <numeric>

namespace vndf::gltf {
namespace {

constexpr std::uint32_t none = Tangents::none;

// A triangle that has a say: where u and v grow, each of length 1, and whether they run counterclockwise. Without coordinates
// that span an area it belongs to whatever group reaches it.
struct Face {
    Vec3 along_u{}, along_v{};
    bool counterclockwise = false, any = true, healthy = false;
    std::array<std::uint32_t, 3> neighbours{none, none, none};  // across the edge from corner k to the next
    std::array<std::uint32_t, 3> groups{none, none, none};
};

// For each vertex the first that is the same.
std::vector<std::uint32_t> welded(const TangentMesh& mesh) {
    const auto key = [&](std::uint32_t i) {
        const Vec3 &p = mesh.places[i], &n = mesh.normals[i];
        return std::array<double, 8>{p[0], p[1], p[2], n[0], n[1], n[2], mesh.uv[i][0], mesh.uv[i][1]};
    };
    std::vector<std::uint32_t> order(mesh.places.size()), first(order.size());
    std::iota(order.begin(), order.end(), 0);
    std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
        const auto x = key(a), y = key(b);
        return x != y ? x < y : a < b;
    });
    for (std::size_t k = 0; k < order.size(); ++k)
        first[order[k]] = k > 0 && key(order[k]) == key(order[k - 1]) ? first[order[k - 1]] : order[k];
    return first;
}

Face face_of(const TangentMesh& mesh, const Corners& c) {
    Face face;
    const Vec3 &a = mesh.places[c[0]], &b = mesh.places[c[1]], &d = mesh.places[c[2]];
    face.healthy = a != b && a != d && b != d;
    const Vec3 ab = difference(b, a), ad = difference(d, a);
    const std::array<double, 2>&s = mesh.uv[c[0]], &t = mesh.uv[c[1]], &r = mesh.uv[c[2]];
    const double u1 = t[0] - s[0], v1 = t[1] - s[1], u2 = r[0] - s[0], v2 = r[1] - s[1];
    const double area = u1 * v2 - v1 * u2;
    face.counterclockwise = area > 0;
    const double sign = area > 0 ? 1 : -1;
    face.along_u = unit(sum(sum({}, sign * v2, ab), -sign * v1, ad));
    face.along_v = unit(sum(sum({}, -sign * u2, ab), sign * u1, ad));
    face.any = area == 0 || is_zero(face.along_u) || is_zero(face.along_v);
    return face;
}

// An edge joins the first two triangles that run along it in opposite ways, then the next two.
void join(const std::vector<Corners>& triangles, std::vector<Face>& faces) {
    struct Edge {
        std::uint32_t low, high, face, corner;
        bool up;
    };
    std::vector<Edge> edges;
    for (std::uint32_t f = 0; f < triangles.size(); ++f)
        for (std::uint32_t k = 0; faces[f].healthy && k < 3; ++k) {
            const std::uint32_t a = triangles[f][k], b = triangles[f][(k + 1) % 3];
            edges.push_back({std::min(a, b), std::max(a, b), f, k, a < b});
        }
    std::sort(edges.begin(), edges.end(), [](const Edge& a, const Edge& b) {
        return std::array{a.low, a.high, a.face, a.corner} < std::array{b.low, b.high, b.face, b.corner};
    });
    std::deque<const Edge*> waiting;  // all of one way
    for (const Edge& edge : edges) {
        if (!waiting.empty() && (waiting.front()->low != edge.low || waiting.front()->high != edge.high))
            waiting.clear();
        if (waiting.empty() || waiting.front()->up == edge.up) {
            waiting.push_back(&edge);
            continue;
        }
        const Edge& other = *waiting.front();
        waiting.pop_front();
        faces[edge.face].neighbours[edge.corner] = other.face;
        faces[other.face].neighbours[other.corner] = edge.face;
    }
}

std::uint32_t corner_at(const Corners& triangle, std::uint32_t vertex) {
    return triangle[0] == vertex ? 0 : triangle[1] == vertex ? 1 : 2;
}

// The triangles around a vertex from this one on, as far as they run the same way round.
std::vector<std::uint32_t> gather(const std::vector<Corners>& triangles, std::vector<Face>& faces,
                                  std::uint32_t first, std::uint32_t corner, std::uint32_t group) {
    const std::uint32_t vertex = triangles[first][corner];
    const bool counterclockwise = faces[first].counterclockwise;
    std::vector<std::uint32_t> members, open{first};
    while (!open.empty()) {
        const std::uint32_t f = open.back();
        open.pop_back();
        Face& face = faces[f];
        const std::uint32_t k = corner_at(triangles[f], vertex);
        if (face.groups[k] != none) continue;
        if (face.any && face.groups == Corners{none, none, none}) face.counterclockwise = counterclockwise;
        if (face.counterclockwise != counterclockwise) continue;
        face.groups[k] = group;
        members.push_back(f);
        for (const std::uint32_t side : {(k + 2) % 3, k})
            if (face.neighbours[side] != none) open.push_back(face.neighbours[side]);
    }
    return members;
}

// The mean over triangles around a vertex, by the angle that each has there as seen along the normal.
Vec3 mean_tangent(const TangentMesh& mesh, const std::vector<Corners>& triangles,
                  const std::vector<Face>& faces, const std::vector<std::uint32_t>& members,
                  std::uint32_t vertex) {
    const Vec3 &normal = mesh.normals[vertex], &place = mesh.places[vertex];
    Vec3 total{};
    for (const std::uint32_t f : members) {
        if (faces[f].any) continue;
        const std::uint32_t k = corner_at(triangles[f], vertex);
        const auto towards = [&](std::uint32_t other) {
            return unit(across(difference(mesh.places[triangles[f][other % 3]], place), normal));
        };
        const double angle = std::acos(std::clamp(dot(towards(k + 1), towards(k + 2)), -1.0, 1.0));
        total = sum(total, angle, unit(across(faces[f].along_u, normal)));
    }
    return unit(total);
}

}  // namespace

Tangents tangents_of(const TangentMesh& mesh) {
    const std::vector<std::uint32_t> first = welded(mesh);
    std::vector<Corners> triangles = mesh.triangles;
    std::vector<Face> faces;
    faces.reserve(triangles.size());
    for (Corners& triangle : triangles) {
        for (std::uint32_t& corner : triangle) corner = first[corner];
        faces.push_back(face_of(mesh, triangle));
    }
    join(triangles, faces);
    Tangents tangents;
    for (std::uint32_t f = 0; f < faces.size(); ++f)
        for (std::uint32_t k = 0; k < 3; ++k) {
            if (faces[f].any || !faces[f].healthy || faces[f].groups[k] != none) continue;
            const auto group = static_cast<std::uint32_t>(tangents.groups.size());
            const std::vector<std::uint32_t> members = gather(triangles, faces, f, k, group);
            const Vec3 tangent = mean_tangent(mesh, triangles, faces, members, triangles[f][k]);
            const float sign = is_zero(tangent) ? 0.0f : faces[f].counterclockwise ? -1.0f : 1.0f;
            const render::Vec t = narrow(tangent);
            tangents.groups.push_back({t[0], t[1], t[2], sign});
        }
    tangents.group_of.reserve(faces.size());
    for (const Face& face : faces) tangents.group_of.push_back(face.groups);
    return tangents;
}

}  // namespace vndf::gltf
