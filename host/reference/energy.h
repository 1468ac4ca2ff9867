// What single scattering loses: of a conductor that reflects everything, and of a dielectric, by quadrature of the visible normals.
#pragma once

#include <boost/math/quadrature/gauss.hpp>

#include "reference/materials.h"

namespace vndf::reference {

// The part of a reflection along wi that does not come out of the surface.
template <class N>
double reflection_loss(bool separable, const View<double>& o, const Vec3<double>& wi) {
    const View<double> i = view(wi, o.alpha_x, o.alpha_y);
    return 1 - (separable ? g1<N>(i) : weight<N>(o, i));
}

// Gauss and Legendre's nodes on [0, 1]. The horizon cuts through what is integrated, so that there are many; errors are about
// 5e-5.
template <class F>
void unit_nodes(const F& f) {
    using Rule = boost::math::quadrature::gauss<double, 100>;
    for (std::size_t i = 0; i < Rule::abscissa().size(); ++i)
        for (const int sign : {-1, 1}) f((1 + sign * Rule::abscissa()[i]) / 2, Rule::weights()[i] / 2);
}

// Normals visible from a direction, with their shares. GGX: the product of a semicircle and of an angle beta (stretched.h).
template <class F>
void visible_normals(Ggx, const View<double>& o, const F& f) {
    unit_nodes([&](double u, double share_t) {
        const double tau = pi<double>() * u, t = std::cos(tau), root = std::sin(tau);
        unit_nodes([&](double v, double share_beta) {
            const double beta = v * o.nu, density = o.nu * std::sin(o.nu - beta) / (1 - std::cos(o.nu));
            const double along = root * std::cos(beta), x = along * o.ex - t * o.ey,
                         y = along * o.ey + t * o.ex;
            f(normalised<double>({o.alpha_x * x, o.alpha_y * y, root * std::sin(beta)}),
              2 * root * root * share_t * density * share_beta);
        });
    });
}

// Beckmann: of a visible slope in the plane of incidence and a Gaussian one across.
template <class F>
void visible_normals(Beckmann, const View<double>& o, const F& f) {
    constexpr double reach = 5.5;
    const Slopes<double> s = beckmann_slopes(o.sin_theta, o.cos_theta);
    const double top = std::min(s.a, reach);
    unit_nodes([&](double u, double share_x) {
        const double x = top - u * (top + reach);
        const double px = share_x * (top + reach) * beckmann_slope_pdf(s, slope_at(s, x));
        unit_nodes([&](double v, double share_y) {
            const double y = reach * (2 * v - 1);
            f(normalised<double>({-o.alpha_x * (x * o.ex - y * o.ey), -o.alpha_y * (x * o.ey + y * o.ex), 1}),
              px * share_y * 2 * reach * std::exp(-y * y) * rcp_sqrt_pi<double>());
        });
    });
}

// What a conductor that reflects everything loses.
template <class N>
double directional_loss(bool separable, const Vec3<double>& wo, double alpha_x, double alpha_y) {
    const View<double> o = view(wo, alpha_x, alpha_y);
    double loss = 0;
    visible_normals(N{}, o, [&](const Vec3<double>& m, double share) {
        loss += share * reflection_loss<N>(separable, o, reflect(wo, m));
    });
    return loss;
}

// What a dielectric reflects and refracts of the light along wo: a reflection counts above the surface, a refraction below it.
struct GlassParts {
    double reflected = 0, refracted = 0;
};
template <class N>
GlassParts directional_parts(bool separable, const Vec3<double>& wo, double alpha_x, double alpha_y,
                             double eta) {
    const View<double> o = view(wo, alpha_x, alpha_y);
    GlassParts parts;
    visible_normals(N{}, o, [&](const Vec3<double>& m, double share) {
        const double f = fresnel_dielectric<double>(dot(wo, m), eta);
        const Vec3<double> back = reflect(wo, m), through = refract(wo, m, eta);
        if (back.z > 0) parts.reflected += share * f * (1 - reflection_loss<N>(separable, o, back));
        if (through.z < 0)
            parts.refracted += share * (1 - f) *
                               g1<N>(view(Vec3<double>{through.x, through.y, -through.z}, alpha_x, alpha_y));
    });
    return parts;
}

}  // namespace vndf::reference
