// A rough mirror under a white sky, on the CPU without OpenCL: which part of the light does it send on? Every sampled
// direction brings its weight, brdf * cos(theta) / density; their mean is the answer. Exit status 0 if it is the known
// one.
//
// CMake: find_package(clvndf) and the target clvndf::vndf. Without: c++ loop.cpp $(pkg-config --cflags --libs clvndf)
#include <cmath>
#include <cstdio>

#include <vndf/vndf.h>

int main() {
    const vndf_float3 wo = {0.6f, 0.0f, 0.8f};  // towards the viewer: unit, z along the normal of the surface
    const vndf_float2 alpha = {0.5f, 0.1f};
    const int side = 1024;

    double sum = 0, largest = 0;
    for (int i = 0; i < side * side; ++i) {
        const vndf_float2 u = {(i % side + 0.5f) / side,
                               (i / side + 0.5f) / side};                   // your random numbers in [0, 1]
        const vndf_float3 wm = vndf_ggx_sample_wm_dupuy2023(wo, alpha, u);  // the normal of a microfacet
        const vndf_float3 wi = vndf_reflect(wo, wm);
        if (wi.z <= 0) continue;  // into the surface: its light is lost
        const float weight = vndf_ggx_weight(wo, wi, alpha);

        // The same by hand, which multiple importance sampling needs: brdf * cos(theta) = D G2 / (4 wo.z), the density.
        const float brdf_cos = vndf_ggx_ndf(wm, alpha) * vndf_ggx_g2(wo, wi, alpha) / (4 * wo.z);
        largest = std::fmax(largest, std::fabs(brdf_cos / vndf_ggx_pdf_wi(wo, wi, alpha) / weight - 1));
        sum += weight;
    }
    const double reflected = sum / side / side;
    std::printf("reflected: %.4f of the light; brdf cos / density is the weight within %.0e\n", reflected,
                largest);
    return std::fabs(reflected - 0.80472) < 1e-4 && largest < 1e-5 ? 0 : 1;
}
