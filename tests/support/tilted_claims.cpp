#define VNDF_REAL double
#include "vndf/ggx_polygon.h"
#include "vndf/ggx_tilted2026.h"

#include "reference/direction_quadrature.h"
#include "tilted_claims.h"

namespace vndf::claims {
namespace {

using reference::Directions;
using reference::Vec3;

Vec3<double> anywhere(Random& random) {
    const double z = 2 * random.uniform() - 1, phi = 2 * VNDF_PI * random.uniform(),
                 s = std::sqrt((1 - z) * (1 + z));
    return {s * std::cos(phi), s * std::sin(phi), z};
}
// A view that quadrature can do with, from above the surface.
struct WideLobe {
    Vec3<double> wo;
    vndf_double2 alpha;
    double length;  // of alpha wo
};
WideLobe wide_lobe(Random& random) {
    const Lobe at = random_lobe(random, 0.05, 2);
    const double z = 0.05 + 0.95 * at.z, scale = std::sqrt((1 - z) * (1 + z)) / std::hypot(at.x, at.y);
    const Vec3<double> wo{at.x * scale, at.y * scale, z};
    return {wo, {at.alpha_x, at.alpha_y}, std::hypot(at.alpha_x * wo.x, at.alpha_y * wo.y, wo.z)};
}
vndf_double3 direction(const Vec3<double>& v) {
    return {v.x, v.y, v.z};
}

}  // namespace

TiltedLobe random_tilt(Random& random, double least_alpha, double most_alpha) {
    for (;;) {
        TiltedLobe t{random_lobe(random, least_alpha, most_alpha), 0, 0, 1};
        const double tilt = random.log_uniform(1e-3, 1.5), phi = 2 * VNDF_PI * random.uniform();
        t.x = std::sin(tilt) * std::cos(phi), t.y = std::sin(tilt) * std::sin(phi), t.z = std::cos(tilt);
        if (t.at.x * t.x + t.at.y * t.y + t.at.z * t.z > 1e-3) return t;
    }
}

double worst_sigma_tilted(std::uint64_t lobes) {
    std::atomic<double> worst{0};
    for_blocks(lobes, [&](Random& random) {
        const auto [wo, alpha, length] = wide_lobe(random);
        const Vec3<double> ng = anywhere(random);
        const double sigma = vndf_ggx_sigma_tilted(direction(wo), direction(ng), alpha);
        raise(worst, std::abs(sigma - Directions(wo, alpha.x, alpha.y).lune(ng)) / length);
    });
    return worst;
}

double worst_polygon_mass(std::uint64_t polygons) {
    std::atomic<double> worst{0};
    for_blocks(polygons, [&](Random& random) {
        const auto [wo, alpha, length] = wide_lobe(random);
        const Vec3<double> centre = anywhere(random);
        const double size = random.log_uniform(0.02, 1);
        const Vec3<double> u = reference::normalised<double>(std::abs(centre.x) < 0.6
                                                                 ? Vec3<double>{0, -centre.z, centre.y}
                                                                 : Vec3<double>{centre.z, 0, -centre.x}),
                           v{centre.y * u.z - centre.z * u.y, centre.z * u.x - centre.x * u.z,
                             centre.x * u.y - centre.y * u.x};
        const int corners = random.bits() % 2 ? 3 : 4;
        std::vector<Vec3<double>> at_corners;
        for (int k = 0; k < corners; ++k) {
            const double phi = 2 * VNDF_PI * (k + 0.9 * random.uniform()) / corners, c = size * std::cos(phi),
                         s = size * std::sin(phi);
            at_corners.push_back(reference::normalised<double>(
                {centre.x + c * u.x + s * v.x, centre.y + c * u.y + s * v.y, centre.z + c * u.z + s * v.z}));
        }
        const vndf_double3 o = direction(wo), a = direction(at_corners[0]), b = direction(at_corners[1]),
                           c = direction(at_corners[2]);
        const double mass = corners == 3 ? vndf_ggx_triangle_mass(o, a, b, c, alpha)
                                         : vndf_ggx_quad_mass(o, a, b, c, direction(at_corners[3]), alpha);
        raise(worst, std::abs(mass - Directions(wo, alpha.x, alpha.y).polygon(at_corners)) / length);
    });
    return worst;
}

double worst_cap_mass(std::uint64_t caps) {
    std::atomic<double> worst{0};
    for_blocks(caps, [&](Random& random) {
        auto [wo, alpha, length] = wide_lobe(random);
        if (random.bits() % 2) wo.z = -wo.z;
        const Vec3<double> l = anywhere(random);
        const double one_minus_cos = random.log_uniform(1e-3, 1.99);
        const double mass = vndf_ggx_cap_mass(direction(wo), direction(l), one_minus_cos, alpha);
        raise(worst, std::abs(mass - Directions(wo, alpha.x, alpha.y).cap(l, one_minus_cos)) / length);
    });
    return worst;
}

}  // namespace vndf::claims
