// What a material is at least and at most somewhere on it, its textures counted.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "render/scene.h"

namespace vndf::render {

// Red, green, blue, alpha of a texture's texels, from 0 to 255.
struct TexelRange {
    std::array<std::uint32_t, 4> least{255, 255, 255, 255}, most{255, 255, 255, 255};
};

// Of every bitmap of a scene once.
class TexelRanges {
  public:
    explicit TexelRanges(const Scene& scene);
    // Of what a material has in a slot; of white where it has none.
    TexelRange of(std::size_t material, Slot slot) const;

  private:
    const Scene& scene_;
    std::vector<TexelRange> ranges_;
};

// The material with each of its textured numbers at its least and at its most, in every combination; untextured itself alone.
std::vector<Material> variants(const Scene& scene, const TexelRanges& ranges, std::size_t material);

bool anisotropic(const Material& m);

}  // namespace vndf::render
