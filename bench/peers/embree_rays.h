// Scenes and rays of Embree, robust: rtcIntersect1 and rtcOccluded1, whatever its version.
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

#include "kernels/render/queues.h"
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

}  // namespace vndf::bench
