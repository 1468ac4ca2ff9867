// A path tracer as one writes it in C++ over Embree: rtcIntersect1 and rtcOccluded1, a path from its beginning to its end on
// one thread. It shades by the stages of kernels/render, each for one path, so that only the rays and the form differ.
#pragma once

#if CLVNDF_EMBREE == 3
#include <embree3/rtcore.h>
#define CLVNDF_CALL(function, ray)     \
    RTCIntersectContext context;       \
    rtcInitIntersectContext(&context); \
    function(scene, &context, ray)
#else
#include <embree4/rtcore.h>
#define CLVNDF_CALL(function, ray) function(scene, ray, nullptr)
#endif

#include "kernels/render/materials.cl"
#include "kernels/render/paths.cl"

#include "render/scene.h"

namespace vndf::bench {

inline RTCScene embree_scene(RTCDevice device, const render::Scene& scene) {
    const RTCScene made = rtcNewScene(device);
    rtcSetSceneFlags(made, RTC_SCENE_FLAG_ROBUST);
    const RTCGeometry mesh = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
    rtcSetSharedGeometryBuffer(mesh, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, scene.vertices.data(), 0,
                               sizeof(render::Vertex), scene.vertices.size());
    rtcSetSharedGeometryBuffer(mesh, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, scene.triangles.data(), 0,
                               sizeof(render::Triangle), scene.triangles.size());
    rtcCommitGeometry(mesh);
    rtcAttachGeometry(made, mesh);
    rtcReleaseGeometry(mesh);
    rtcCommitScene(made);
    return made;
}

// The ray from planes x, y, z and dx, dy, dz of item i.
inline RTCRay embree_ray(const float* from, const float* to, std::size_t stride, std::size_t i) {
    RTCRay ray{};
    ray.org_x = from[i], ray.org_y = from[stride + i], ray.org_z = from[2 * stride + i];
    ray.dir_x = to[i], ray.dir_y = to[stride + i], ray.dir_z = to[2 * stride + i];
    ray.tfar = 3.0e38f;
    ray.mask = ~0u;
    return ray;
}

inline RTCRayHit embree_hit(RTCScene scene, const RTCRay& ray) {
    RTCRayHit hit{};
    hit.ray = ray;
    hit.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    CLVNDF_CALL(rtcIntersect1, &hit);
    return hit;
}

inline bool embree_occluded(RTCScene scene, RTCRay ray) {
    CLVNDF_CALL(rtcOccluded1, &ray);
    return ray.tfar < 0;
}

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
    uint slot = 0, triangle = 0, material = 0, alive = 1;
    vndf_render_item = 0;
    vndf_render_generate(t.view, t.words, pixel, 1, path, &slot, light);
    for (uint bounce = 0; alive; ++bounce) {
        const RTCRayHit found = embree_hit(scene, embree_ray(path, path + VNDF_PATH_DX, 1, 0));
        triangle = found.hit.geomID == RTC_INVALID_GEOMETRY_ID ? VNDF_MISS : found.hit.primID;
        hit[VNDF_HIT_B1] = found.hit.u, hit[VNDF_HIT_B2] = found.hit.v;
        vndf_render_leave(t.sky, path, &triangle, &slot, 1, 1, light);
        if (triangle == VNDF_MISS || bounce == max_bounces) break;
        const uint quad = VNDF_QUAD_BOUNCE * bounce;
        vndf_render_surface(t.sizes, t.vertices, t.triangles, hit, &triangle, 1, 1, path, surface, &material);
        vndf_render_lights(t.sky, t.words, VNDF_QUAD_LIGHT + quad, &slot, pixel, surface, 1, to);
        vndf_render_connect(t.sizes, t.materials, &material, surface, path, 1, to);
        const float* const arriving = to + VNDF_LIGHT_RED;
        if ((arriving[0] != 0 || arriving[1] != 0 || arriving[2] != 0) &&
            !embree_occluded(scene, embree_ray(path, to, 1, 0)))
            for (int channel = 0; channel < 3; ++channel) light[channel] += arriving[channel];
        vndf_render_scatter(t.sizes, t.materials, &material, surface, t.words, VNDF_QUAD_BSDF + quad, &slot,
                            pixel, 1, path);
        vndf_render_survive(&material, surface, t.words, VNDF_QUAD_BSDF + quad, &slot, pixel, 1, bounce >= 3,
                            path, &alive);
    }
    for (int channel = 0; channel < 3; ++channel) rgb[channel] += light[channel];
}

}  // namespace vndf::bench
