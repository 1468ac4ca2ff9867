// Materials of the file as the renderer's, those that are used.
#pragma once

#include <map>
#include <optional>

#include "gltf/images.h"
#include "gltf/values.h"

namespace vndf::gltf {

class Materials {
  public:
    Materials(const Item& root, Images& images, render::Scene& scene, Warnings& warnings)
        : items_(root["materials"]), images_(images), scene_(scene), warnings_(warnings), values_(warnings) {}
    // The number in the scene of the one that a primitive names, or of the format's default.
    std::uint32_t use(const Item& index);
    void require(const Item& index) const { index.index(items_.size(), "material"); }

  private:
    render::Dressing dressing_of(const Item& material);
    void read_base(const Item& material, render::Dressing& dressing);
    void read_alpha(const Item& material, render::Dressing& dressing);
    void read_interface(const Item& extensions, render::Dressing& dressing);
    void read_body(const Item& extensions, render::Dressing& dressing);
    void read_coat(const Item& extensions, render::Dressing& dressing);
    void read_anisotropy(const Item& extensions, render::Dressing& dressing);
    void read_normal(const Item& material, render::Dressing& dressing);
    render::TextureUse texture(const Item& info);
    void ignore(const Item& item, const char* what);

    Item items_;
    Images& images_;
    render::Scene& scene_;
    Warnings& warnings_;
    Values values_;
    std::map<std::optional<std::size_t>, std::uint32_t> number_of_;
};

// Of set 0 and 1: whether a texture asks for their coordinates.
std::array<bool, 2> sets_of(const render::Dressing& dressing);
// Whether it matters where the tangent points.
bool needs_tangents(const render::Dressing& dressing);

}  // namespace vndf::gltf
