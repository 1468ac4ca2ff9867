// The reflections above the surface and above a geometric normal: the smaller of the cones of conic_maps.h and, with 90 degrees
// about that normal, of cap_maps.h, without what the other lacks.
#pragma once

#include "reference/cap_maps.h"

namespace vndf::reference {

// The areas of both cones; that of ng is infinite where wo is below it, and where ng is z.
template <class R>
struct Tilted {
    View<R> v;
    LightView<R> of_ng;
    R sigma_z, sigma_ng;
    bool about_ng() const { return sigma_ng < sigma_z; }
    R sigma() const { return about_ng() ? sigma_ng : sigma_z; }
};
template <class R>
Tilted<R> tilted(const Vec3<R>& wo, const Vec3<R>& ng, const R& alpha_x, const R& alpha_y) {
    Tilted<R> t{view(wo, alpha_x, alpha_y), light_view(wo, Light<R>{ng, R(1), R(1)}, alpha_x, alpha_y), R(0),
                R(std::numeric_limits<Real<R>>::infinity())};
    t.sigma_z = t.v.up > 0 ? R(ggx_sigma_visible(t.v)) : Ggx::sigma(t.v);
    const bool level = !(value_of(ng.x) != 0 || value_of(ng.y) != 0);
    if (t.of_ng.outside && !level) t.sigma_ng = t.of_ng.length * cone_area(cap_cone(t.of_ng));
    return t;
}

template <class R>
Sample<R> ggx_tilted2026(const Arguments<R>& in) {
    const Sample<R> lost{{R(0), R(0), R(0)}, R(0)};
    const Tilted<R> t = tilted(in.wo, in.ng, in.alpha_x, in.alpha_y);
    if (nothing_visible(t.v)) return lost;
    // Where rounding decides which is the smaller, or on which side of ng wo is, either cone may be taken: no derivative.
    if constexpr (!std::is_same_v<R, Real<R>>) {
        const double ratio = value_of(t.sigma_ng) / value_of(t.sigma_z), side = value_of(t.of_ng.kappa);
        const bool level = !(value_of(in.ng.x) != 0 || value_of(in.ng.y) != 0);
        if (!level && (std::abs(ratio - 1) < 0x1p-14 || std::abs(side) < 0x1p-18)) {
            const R nan = in.wo.x * std::numeric_limits<double>::quiet_NaN();
            return {{nan, nan, nan}, nan};
        }
    }
    Arguments<R> about_ng = in;
    about_ng.l = in.ng, about_ng.one_minus_cos = about_ng.cap_part = R(1);
    const Sample<R> s = t.about_ng() ? ggx_cone2026(about_ng) : ggx_conic2026(in);
    const bool above_ng = t.about_ng() || dot(s.direction, in.ng) > 0;
    // A lost sample moves with the inputs, too.
    const bool kept = s.direction.z > 0 && above_ng && s.pdf > 0;
    return kept || !std::is_same_v<R, Real<R>> ? s : lost;
}

// D(h) / (4 sigma) of the smaller cone, above both.
template <class R>
R ggx_pdf_wi_tilted2026(const Vec3<R>& wo, const Vec3<R>& ng, const Vec3<R>& wi, const R& alpha_x,
                        const R& alpha_y) {
    const Vec3<R> h = normalised<R>({wo.x + wi.x, wo.y + wi.y, wo.z + wi.z});
    const R sigma = tilted(wo, ng, alpha_x, alpha_y).sigma();
    if (!(wi.z > 0) || !(dot(wi, ng) > 0) || !(h.z > 0) || !(sigma > 0)) return R(0);
    return Ggx::ndf(h, alpha_x, alpha_y) / (4 * sigma);
}

// How far wi is above the nearer of the horizons.
template <class R>
R horizon_margin(const Vec3<R>& wi, const Vec3<R>& ng) {
    const Vec3<R> i = normalised(wi);
    const R over = dot(i, ng);
    return std::abs(value_of(i.z)) < std::abs(value_of(over)) ? i.z : over;
}

}  // namespace vndf::reference
