// The stages that know materials: compiled once for each VNDF_NDF and VNDF_FRESNEL, both set by CMake.
#include "kernels/render/materials.cl"
#include "render/cpp_run.h"

namespace vndf::render {

Runs VNDF_CAT(VNDF_CAT(cpp_materials_, VNDF_NDF), VNDF_CAT(_, VNDF_FRESNEL))() {
    return {{"media", Runner<vndf_render_media>::run},     {"surface", Runner<vndf_render_surface>::run},
            {"dress", Runner<vndf_render_dress>::run},     {"leave", Runner<vndf_render_leave>::run},
            {"lights", Runner<vndf_render_lights>::run},   {"glow", Runner<vndf_render_glow>::run},
            {"spheres", Runner<vndf_render_spheres>::run}, {"connect", Runner<vndf_render_connect>::run},
            {"scatter", Runner<vndf_render_scatter>::run}};
}

}  // namespace vndf::render
