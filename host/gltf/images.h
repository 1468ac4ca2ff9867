// Textures of the file, their images decoded when a material that is used asks for them.
#pragma once

#include <map>
#include <optional>
#include <utility>

#include "gltf/accessors.h"
#include "gltf/warnings.h"
#include "render/scene.h"

namespace vndf::gltf {

class Images {
  public:
    Images(const Item& root, const Accessors& accessors, Resources& resources, const Limits& limits,
           render::Scene& scene, Warnings& warnings);
    // The number in scene.textures of the one that an index in the file names; nothing of one without an image that is read.
    std::optional<std::uint32_t> texture(const Item& index);

  private:
    std::uint32_t bitmap(const Item& index);
    render::Texture sampler_of(const Item& texture) const;

    Item textures_, images_, samplers_;
    const Accessors& accessors_;
    Resources& resources_;
    const Limits& limits_;
    std::uint64_t pixels_left_;
    render::Scene& scene_;
    Warnings& warnings_;
    std::map<std::size_t, std::optional<std::uint32_t>> texture_of_;
    std::map<std::size_t, std::uint32_t> bitmap_of_;
};

}  // namespace vndf::gltf
