// The distributions' terms and densities, of the vectors as given (not normalised).
#pragma once

#include "reference/beckmann_maps.h"
#include "reference/conic_maps.h"
#include "reference/ggx_maps.h"

namespace vndf::reference {

template <class R>
R largest(Precision precision) {
    return precision == Precision::f32 ? R(std::numeric_limits<float>::max())
                                       : R(std::numeric_limits<double>::max());
}

// What the distributions supply: P22 at alpha = 1, D, sigma, Lambda, and D / sigma in one exponent.
struct Ggx {
    template <class R>
    static R p22(const R& square) {
        return 1 / (pi<R>() * squared(R(1 + square)));
    }
    template <class R>
    static R ndf(const Vec3<R>& m, const R& ax, const R& ay) {
        if (!(m.z > 0)) return R(0);
        const R q = squared(R(m.x / ax)) + squared(R(m.y / ay)) + squared(m.z);
        return 1 / (pi<R>() * (q * ax) * (q * ay));
    }
    template <class R>
    static R sigma(const View<R>& v) {
        using std::sin;
        return v.length * squared(R(sin(v.nu / 2)));
    }
    // sigma = (1 + Lambda) z: half the gap between the stretched length and its z.
    template <class R>
    static R lambda(const View<R>& v) {
        using std::sin;
        return squared(R(sin(v.theta / 2))) * (v.length / v.up);
    }
    template <class R>
    static R visible(const Vec3<R>& m, const View<R>& v) {
        return ndf(m, v.alpha_x, v.alpha_y) / sigma(v);
    }
    template <class R>
    static R visible_by_cosines(const Vec3<R>& m, const Vec3<R>&, const View<R>& v) {
        return visible(m, v);
    }
};

struct Beckmann {
    template <class R>
    static R p22(const R& square) {
        using std::exp;
        return exp(-square) / pi<R>();
    }
    template <class R>
    static R exponent(const Vec3<R>& m, const R& ax, const R& ay) {
        return squared(R(m.x / m.z / ax)) + squared(R(m.y / m.z / ay));
    }
    // e^(shift) D
    template <class R>
    static R ndf(const Vec3<R>& m, const R& ax, const R& ay, const R& shift = R(0)) {
        using std::exp;
        if (!(m.z > 0)) return R(0);
        const R height = exp(shift - exponent(m, ax, ay)), z2 = m.z * m.z;
        return height > 0 ? R(height / (ax * z2) / (ay * z2) / pi<R>()) : R(0);
    }
    template <class R>
    static R sigma(const View<R>& v) {
        using std::erfc, std::exp;
        if (nothing_visible(v)) return R(0);
        const Slopes<R> s = beckmann_slopes(v.across, v.up);
        if (s.a < 0) return v.across * s.weight * exp(-s.a * s.a) / 2;
        return (v.up * erfc(-s.a) + v.across * rcp_sqrt_pi<R>() * exp(-s.a * s.a)) / 2;
    }
    // sigma / z - 1 = first(a) e^(-a^2) / (2 a) for a > 0, -1 minus that for |a| behind the surface.
    template <class R>
    static R lambda(const View<R>& v) {
        using std::abs, std::exp;
        const R a = abs(beckmann_slopes(v.across, v.up).a);
        const R above = gaussian_tail<R>(a).first * exp(-a * a) / (2 * a);
        return v.up < 0 ? R(-1 - above) : above;
    }
    template <class R>
    static R visible(const Vec3<R>& m, const View<R>& v) {
        const Slopes<R> s = beckmann_slopes(v.across, v.up);
        if (!(s.a < 0)) return ndf(m, v.alpha_x, v.alpha_y) / sigma(v);
        return ndf(m, v.alpha_x, v.alpha_y, R(s.a * s.a)) / (v.across * s.weight / 2);
    }
    // The same of directions whose azimuths are not known, (sine, 0, cosine). Behind the surface the exponents of D and sigma
    // are (tan(theta_m) / alpha)^2 and (cot(theta_o) / alpha)^2; a normal steeper than any visible one counts as one across wo.
    template <class R>
    static R visible_by_cosines(const Vec3<R>& m, const Vec3<R>& wo, const View<R>& v) {
        using std::abs;
        const Slopes<R> s = beckmann_slopes(v.across, v.up);
        if (!(s.a < 0)) return visible(m, v);
        // sin^2(theta_m) - cos^2(theta_o), or the same by the other two.
        const R co = abs(wo.z),
                gap = m.x < wo.x ? R((m.x - co) * (m.x + co)) : R((wo.x - m.z) * (wo.x + m.z));
        const R left = gap > 0 ? R(gap / squared(R(m.z * wo.x * v.alpha_x))) : R(0),
                shift = exponent(m, v.alpha_x, v.alpha_y) - left;
        return ndf(m, v.alpha_x, v.alpha_y, shift) / (v.across * s.weight / 2);
    }
};

// Lambda; at the pole z = 0 what z -> 0 from above gives, which the caller makes finite.
template <class N, class R>
R lambda(const View<R>& v) {
    if (!(v.up > 0) && !(v.up < 0)) return R(std::numeric_limits<Real<R>>::infinity());
    return N::template lambda<R>(v);
}
template <class N, class R>
R g1(const View<R>& v) {
    return v.up > 0 ? R(1 / (1 + lambda<N>(v))) : R(0);
}
template <class N, class R>
R g2(const View<R>& o, const View<R>& i) {
    return o.up > 0 && i.up > 0 ? R(1 / (1 + lambda<N>(o) + lambda<N>(i))) : R(0);
}

// G2 / G1(wo)
template <class N, class R>
R weight(const View<R>& o, const View<R>& i) {
    const R shadow = i.up > 0 ? lambda<N>(i) : R(0), mask = o.up > 0 ? lambda<N>(o) : R(0);
    return o.up > 0 && i.up > 0 ? R((1 + mask) / (1 + mask + shadow)) : R(0);
}

// max(wo . wm, 0) D(wm) / sigma(wo)
template <class N, class R>
R pdf_wm(const Vec3<R>& wo, const Vec3<R>& wm, const R& ax, const R& ay) {
    const View<R> v = view(wo, ax, ay);
    const R cosine = dot(wo, wm);
    return wm.z > 0 && cosine > 0 && !nothing_visible(v) ? R(cosine * N::template visible<R>(wm, v)) : R(0);
}

// pdf_wm(h) / (4 wo . h) = D(h) / (4 sigma(wo)) for the half vector h.
template <class N, class R>
R pdf_wi(const Vec3<R>& wo, const Vec3<R>& wi, const R& ax, const R& ay) {
    const View<R> v = view(wo, ax, ay);
    const Vec3<R> h = normalised<R>({wo.x + wi.x, wo.y + wi.y, wo.z + wi.z});
    return h.z > 0 && !nothing_visible(v) ? R(N::template visible<R>(h, v) / 4) : R(0);
}

// D(h) G2 / (4 wo.z wi.z): the quotient of the cosines and 1 + Lambda(wo) + Lambda(wi), which is infinite at the horizon.
template <class N, class R>
R brdf(const Vec3<R>& wo, const Vec3<R>& wi, const R& ax, const R& ay) {
    const View<R> o = view(wo, ax, ay), i = view(wi, ax, ay);
    const Vec3<R> h = normalised<R>({wo.x + wi.x, wo.y + wi.y, wo.z + wi.z});
    if (!(wo.z > 0 && wi.z > 0)) return R(0);
    const R wide = 4 * wo.z * wi.z * (1 + lambda<N>(o) + lambda<N>(i));
    return N::template ndf<R>(h, ax, ay) / wide;
}

// The same by cosines, with directions (sine, 0, cosine): pdf_wm over the cosine wo . wm.
template <class N, class R>
R visible_by_cosines(const Vec3<R>& wo, const Vec3<R>& wm, const R& alpha) {
    const View<R> v = view(wo, alpha, alpha);
    return wm.z > 0 && !nothing_visible(v) ? R(N::template visible_by_cosines<R>(wm, wo, v)) : R(0);
}

// o_z + k cos(theta) of the stretched reflection o, and its change when each component of wi moves by 1: with
// h = wo + wi and q = |A^-1 h|^2, o_z + cos(theta) = 2 (wo . h) h_z / (q t), wo . h = |h|^2 / 2.
template <class R>
struct Margin {
    R inside, per_unit;
};
template <class R>
Margin<R> eto_margin(const Vec3<R>& wo, const Vec3<R>& wi, const View<R>& v, const Bound<R>& b) {
    using std::abs;
    const Vec3<R> h{wo.x + wi.x, wo.y + wi.y, wo.z + wi.z};
    const R sx = h.x / v.alpha_x, sy = h.y / v.alpha_y, q = sx * sx + sy * sy + h.z * h.z, h2 = dot(h, h);
    const R height = h2 * h.z / (q * v.length);
    const R slope_q = 2 * (abs(sx) / v.alpha_x + abs(sy) / v.alpha_y + abs(h.z));
    const R slope_h2 = 2 * (abs(h.x) + abs(h.y) + abs(h.z));
    // Between here and the edge: where rounding is all that is left of h, the change is not linear.
    const R edge = b.gap * v.cos_theta, reached = abs(height) > edge ? R(abs(height)) : edge;
    return {height - edge, reached * slope_q / q + (slope_h2 * abs(h.z) + h2) / (q * v.length)};
}

// D(h) / (2 (k z + t)) on the bounded cap; outside by more than the rounding of wi can explain: 0.
template <class R>
R ggx_pdf_wi_bounded(const Vec3<R>& wo, const Vec3<R>& wi, const View<R>& v, const Bound<R>& b,
                     Precision precision) {
    const Margin<R> margin = eto_margin(wo, wi, v, b);
    const R unit = R(precision == Precision::f32 ? 0x1p-24 : 0x1p-53);
    if (margin.inside < -8 * unit * margin.per_unit) return R(0);
    const Vec3<R> h = normalised<R>({wo.x + wi.x, wo.y + wi.y, wo.z + wi.z});
    return Ggx::ndf(h, v.alpha_x, v.alpha_y) / (2 * v.length * b.up);
}

// sigma of the normals that reflect wo above the horizon, and D(h) over 4 times it there.
template <class R>
R sigma_visible(const View<R>& v) {
    return v.up > 0 ? ggx_sigma_visible(v) : Ggx::sigma(v);
}
template <class R>
R ggx_pdf_wi_conic2026(const Vec3<R>& wo, const Vec3<R>& wi, const R& ax, const R& ay) {
    if (!(wo.z > 0)) return pdf_wi<Ggx, R>(wo, wi, ax, ay);
    const Vec3<R> h = normalised<R>({wo.x + wi.x, wo.y + wi.y, wo.z + wi.z});
    return wi.z > 0 ? R(Ggx::ndf(h, ax, ay) / (4 * ggx_sigma_visible(view(wo, ax, ay)))) : R(0);
}

// The visible slope x in the plane of incidence at alpha = 1.
template <class R>
View<R> view_of_cosine(const R& cos_theta) {
    using std::sqrt;
    const R square = (1 - cos_theta) * (1 + cos_theta);
    return view<R>({square > 0 ? R(sqrt(square)) : R(0), R(0), cos_theta}, R(1), R(1));
}
template <class R>
R ggx_slope_pdf(const R& c, const R& x) {
    using std::sqrt;
    const View<R> v = view_of_cosine(c);
    if (nothing_visible(v)) return R(0);
    // The projected slopes, over their mass (1 + c) / 2.
    const R visible = c - x * v.sin_theta, square = 1 + x * x;
    return visible > 0 ? R(visible / (1 + c) / (square * sqrt(square))) : R(0);
}
template <class R>
R ggx_slope_cdf(const R& c, const R& x) {
    using std::atan2;
    const View<R> v = view_of_cosine(c);
    return nothing_visible(v) ? R(1) : ggx_beta_cdf<R>(atan2(R(1), R(-x)), v.theta, v.nu);
}
template <class R>
R ggx_slope_cdf_inverse(const R& c, const R& u, const R& rest) {
    using std::cos, std::sin;
    const View<R> v = view_of_cosine(c);
    if (nothing_visible(v)) return R(-std::numeric_limits<Real<R>>::infinity());
    const R beta = ggx_beta<R>(u, rest, v.theta, v.nu).beta;
    return -cos(beta) / sin(beta);
}
template <class R>
Slope<R> slope_at(const Slopes<R>& s, const R& x) {
    return {x, s.a - x};
}
template <class R>
R beckmann_slope_pdf(const R& c, const R& x) {
    const View<R> v = view_of_cosine(c);
    if (nothing_visible(v)) return R(0);
    const Slopes<R> s = beckmann_slopes(v.sin_theta, v.cos_theta);
    return beckmann_slope_pdf(s, slope_at(s, x));
}
template <class R>
R beckmann_slope_cdf(const R& c, const R& x) {
    using std::exp;
    const View<R> v = view_of_cosine(c);
    if (nothing_visible(v)) return R(1);
    const Slopes<R> s = beckmann_slopes(v.sin_theta, v.cos_theta);
    return exp(beckmann_slope_log_cdf(s, slope_at(s, x)));
}
template <class R>
R beckmann_slope_cdf_inverse(const R& c, const R& u) {
    const View<R> v = view_of_cosine(c);
    if (nothing_visible(v)) return R(-std::numeric_limits<Real<R>>::infinity());
    return beckmann_slope_inverse<R>(beckmann_slopes(v.sin_theta, v.cos_theta), u, 1 - u).x;
}

// Snell: the tangential part of -wo is divided by eta. A dot product of rounded vectors beyond 1 counts as 1
// in the transmitted cosine.
template <class R>
Vec3<R> refract(const Vec3<R>& wo, const Vec3<R>& wm, const R& eta) {
    using std::sqrt;
    const R c = dot(wo, wm), c1 = c > 1 ? R(1) : c;
    const R square = (eta * eta - (1 - c1) * (1 + c1)) / (eta * eta);
    if (!(c > 0) || !(eta > 0) || square < 0) return {R(0), R(0), R(0)};
    const R k = c / eta - sqrt(square);
    return {k * wm.x - wo.x / eta, k * wm.y - wo.y / eta, k * wm.z - wo.z / eta};
}

// Walter's Equation 17 with h = wo + eta wi, m = h / |h|: eta^2 |wi . m| / (wo . m + eta wi . m)^2, the denominator |h|^2.
// Near eta = 1 and wi = -wo it is a matter of the last bits of the arguments: h is a rounded sum and the rest, and so are
// the sums for wi . h.
template <class R>
struct Exact {
    R sum, rest;  // |rest| <= half an ulp of the sum
    void add(const R& x) {
        const R s = sum + x, t = s - sum, error = (sum - (s - t)) + (x - t);
        sum = s, rest += error;
    }
    void add_product(const R& x, const R& y) {
        const R p = x * y;
        add(p), rest += std::fma(x, y, -p);
    }
    R value() const { return sum + rest; }
};
template <class R>
R jacobian_refract(const Vec3<R>& wo, const Vec3<R>& wi, const R& eta) {
    using std::abs, std::sqrt;
    const R o[3] = {wo.x, wo.y, wo.z}, i[3] = {wi.x, wi.y, wi.z};
    R square = 0;
    Exact<R> along{};
    for (int k = 0; k < 3; ++k) {
        Exact<R> h{o[k], 0};
        h.add_product(eta, i[k]);
        square += squared(h.value());
        const R rest = (h.sum - h.value()) + h.rest;
        along.add_product(i[k], h.value()), along.rest += i[k] * rest;
    }
    if (!(square > 0)) return R(std::numeric_limits<Real<R>>::infinity());
    // Below the square of a unit |wi . m| is not told from 0.
    const R cosine = abs(along.value()) / sqrt(square);
    return squared(eta) / square * cosine;
}

}  // namespace vndf::reference
