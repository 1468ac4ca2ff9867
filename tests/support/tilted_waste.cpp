// Writes what samplers lose under a geometric normal, as rows of a table (kernels/doc/ggx_cone2026.md):
//   tilted_waste
// Of each tilt of the geometric normal, alpha and angle of view: the mean over 72 azimuths of the tilt, with wo above both
// normals, of the part that is lost of all visible normals, of those above the shading normal (conic2026), of those above the
// geometric normal (its cone), and of the smaller of the two (tilted2026). In double, from the areas.
#include <algorithm>
#include <cmath>
#include <cstdio>

#define VNDF_REAL double
#include "vndf/ggx_tilted2026.h"

namespace {

struct Waste {
    double plain = 0, shading = 0, geometric = 0, smaller = 0;
};

Waste waste(double tilt, double angle, const vndf_double2& alpha) {
    constexpr int azimuths = 72;
    Waste mean;
    int count = 0;
    const vndf_double3 wo{std::sin(angle), 0, std::cos(angle)};
    for (int i = 0; i < azimuths; ++i) {
        const double turn = 2 * VNDF_PI * (i + 0.5) / azimuths;
        const vndf_double3 ng{std::sin(tilt) * std::cos(turn), std::sin(tilt) * std::sin(turn),
                              std::cos(tilt)};
        if (!(wo.x * ng.x + wo.z * ng.z > 0)) continue;
        const double kept = vndf_ggx_sigma_tilted(wo, ng, alpha), z = vndf_ggx_sigma_visible(wo, alpha),
                     n = vndf_ggx_sigma_cap(wo, ng, 1, alpha);
        mean.plain += 1 - kept / vndf_ggx_sigma(wo, alpha);
        mean.shading += 1 - kept / z;
        mean.geometric += 1 - kept / n;
        mean.smaller += 1 - kept / std::min(z, n);
        ++count;
    }
    return {mean.plain / count, mean.shading / count, mean.geometric / count, mean.smaller / count};
}

}  // namespace

int main() {
    const double degree = VNDF_PI / 180;
    for (const double tilt : {5., 15., 30., 60.})
        for (const vndf_double2& alpha : {vndf_double2{.1, .1}, {.5, .5}, {.2, .8}}) {
            std::printf("%g | %g, %g", tilt, alpha.x, alpha.y);
            for (const double angle : {30., 60., 80.}) {
                const Waste w = waste(tilt * degree, angle * degree, alpha);
                std::printf(" | %.3f, %.3f, %.3f, **%.3f**", w.plain, w.shading, w.geometric, w.smaller);
            }
            std::printf("\n");
        }
}
