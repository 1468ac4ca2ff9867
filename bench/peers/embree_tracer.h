// A path tracer as one writes it in C++ over Embree: a path from its beginning to its end on one thread. It shades by the stages
// of kernels/render, each for one path, so that only the rays and the form differ.
#pragma once

#include "bench/peers/embree_rays.h"
#include "kernels/render/materials.cl"
#include "kernels/render/paths.cl"

namespace vndf::bench {

// What the stages read beside the path.
struct Tables {
    vndf_render_view view;
    vndf_render_sky sky;
    vndf_render_sizes sizes;
    const float *vertices, *materials;
    const uint *triangles, *words;
};

// Adds a sample's light to red, green and blue.
inline void embree_path(RTCScene scene, const Tables& t, uint pixel, unsigned max_bounces, float* rgb) {
    float path[VNDF_PATH_PLANES], light[3], hit[VNDF_HIT_PLANES], to[VNDF_LIGHT_PLANES],
        surface[VNDF_SURFACE_PLANES];
    uint slot = 0, triangle = 0, material = 0;
    vndf_render_item = 0;
    vndf_render_generate(t.view, t.words, pixel, 1, path, &slot, light);
    const auto carries = [](const float* rgb) { return rgb[0] != 0 || rgb[1] != 0 || rgb[2] != 0; };
    for (uint bounce = 0; carries(path + VNDF_PATH_RED); ++bounce) {
        const RTCRayHit found = embree_hit(scene, embree_ray(path, path + VNDF_PATH_DX, 1, 0));
        triangle = found.hit.geomID == RTC_INVALID_GEOMETRY_ID ? VNDF_MISS : found.hit.primID;
        hit[VNDF_HIT_B1] = found.hit.u, hit[VNDF_HIT_B2] = found.hit.v;
        vndf_render_leave(t.sky, nullptr, nullptr, path, &triangle, &slot, 1, 1, light);
        if (triangle == VNDF_MISS || bounce == max_bounces) break;
        const uint quad = VNDF_QUAD_BOUNCE * bounce;
        // Without textures, and with no light but the sky: nothing is read of what they have.
        vndf_render_surface(t.sizes, t.vertices, t.triangles, nullptr, nullptr, nullptr, hit, &triangle, 1, 1,
                            path, surface, &material);
        vndf_render_lights(t.sky, nullptr, nullptr, nullptr, nullptr, nullptr, nullptr, nullptr, nullptr,
                           t.sizes, t.vertices, t.triangles, nullptr, nullptr, nullptr, t.materials, t.words,
                           VNDF_QUAD_LIGHT + quad, 0, &slot, pixel, surface, path, 1, to);
        vndf_render_connect(t.sizes, t.materials, &material, nullptr, surface, path, 1, to);
        const float* const arriving = to + VNDF_LIGHT_RED;
        if (carries(arriving) && !embree_occluded(scene, embree_ray(path, to, 1, 0)))
            for (int channel = 0; channel < 3; ++channel) light[channel] += arriving[channel];
        vndf_render_scatter(t.sizes, t.materials, &material, nullptr, surface, t.words, VNDF_QUAD_BSDF + quad,
                            &slot, pixel, 1, path);
        vndf_render_survive(surface, t.words, VNDF_QUAD_BSDF + quad, &slot, pixel, 1, bounce >= 3, path);
    }
    for (int channel = 0; channel < 3; ++channel) rgb[channel] += light[channel];
}

}  // namespace vndf::bench
