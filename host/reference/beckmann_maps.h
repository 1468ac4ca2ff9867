// The Beckmann samplers; as ggx_maps.h.
#pragma once

#include "reference/sample.h"

namespace vndf::reference {

// The normal of stretched slopes x, y in the frame of e, whose density at alpha = 1 is `pdf`.
template <class R>
Sample<R> beckmann_unstretch(const View<R>& v, const R& x, const R& y, const R& pdf) {
    const R sx = v.alpha_x * (x * v.ex - y * v.ey), sy = v.alpha_y * (x * v.ey + y * v.ex);
    const R length = hypotenuse(hypotenuse(sx, sy), R(1));
    return {{-sx / length, -sy / length, 1 / length},
            pdf * (length / v.alpha_x) * (length / v.alpha_y) * length};
}
template <class R>
Sample<R> beckmann_from_slopes(const View<R>& v, const Slopes<R>& s, const Slope<R>& x, const R& y) {
    using std::exp;
    return beckmann_unstretch<R>(v, x.x, y, beckmann_slope_pdf(s, x) * rcp_sqrt_pi<R>() * exp(-y * y));
}

// The standard Gaussian slope with the mass u below it.
template <class R>
R gaussian_slope(const R& u, const R& v) {
    return u < v ? R(-erfc_inv<R>(2 * u)) : erfc_inv<R>(2 * v);
}

// u1 -> slope x by inversion of its distribution function, u2 -> slope y.
template <class R>
Sample<R> beckmann_jakob2014(const Arguments<R>& in) {
    const View<R> v = view(in);
    if (nothing_visible(v)) return undefined<R>({-v.ex, -v.ey, R(0)});
    const Slopes<R> s = beckmann_slopes(v.sin_theta, v.cos_theta);
    return beckmann_from_slopes(v, s, beckmann_slope_inverse(s, in.u1, in.v1), gaussian_slope(in.u2, in.v2));
}

// u1 -> one of three parts of the slope's range and the slope there, by the masses (of N(a)):
//   x < -a from the term e^(-x^2) x:       e^(-a^2) / sqrt(pi),
//   x < -a from the constant term:         a erfc(a),
//   |x| < a, both signs at once:           2 a erf(a); the sign is chosen with u2, which is used again for y.
template <class R>
Sample<R> beckmann_heitz_deon2014(const Arguments<R>& in) {
    using std::erf, std::erfc, std::exp, std::log, std::sqrt;
    const View<R> v = view(in);
    if (v.up < 0) return undefined<R>({R(0), R(0), R(1)});
    const Slopes<R> s = beckmann_slopes(v.sin_theta, v.cos_theta);
    const R &a = s.a, beyond = erfc(a);
    const R tail = rcp_sqrt_pi<R>() * exp(-a * a), constant = a * beyond, rest = 2 * a * erf(a);
    const R mass = in.u1 * s.weight;
    R x, y = gaussian_slope(in.u2, in.v2);
    if (mass < tail) {
        x = -sqrt(a * a - log(mass / tail));
    } else if (mass < tail + constant) {
        x = -erfc_inv<R>((mass - tail) / constant * beyond);
    } else {
        const R upper = in.v1 * s.weight / rest;  // 1 - U of the centre
        const bool left = upper > Real<R>(0.5);
        const R less = left ? R((mass - tail - constant) / rest) : upper;
        x = erfc_inv<R>(2 * less + (1 - 2 * less) * beyond);
        if (left) x = -x;
        const R p = Real<R>(0.5) - x / (2 * a), q = Real<R>(0.5) + x / (2 * a);
        // A number used up by the choice of the sign is kept from 0 as u is, without hiding how it varies.
        const auto kept = [&](const R& u) { return u < in.least_u ? R(u + (in.least_u - value_of(u))) : u; };
        const bool mirror = in.u2 > p;
        y = mirror ? gaussian_slope<R>(kept((in.u2 - p) / q), in.v2 / q)
                   : gaussian_slope<R>(in.u2 / p, kept((p - in.u2) / p));
        if (mirror) x = -x;
    }
    return beckmann_from_slopes(v, s, {x, a - x}, y);
}

// u1 -> slope length: the part 1 - e^(-r^2) is shorter than r; it is 1 - u1 that the paper's logarithm takes.
template <class R>
Sample<R> beckmann_walter2007(const Arguments<R>& in) {
    using std::cos, std::log, std::log1p, std::sin, std::sqrt;
    const R q = in.u1 < in.v1 ? R(-log1p(-in.u1)) : R(-log(in.v1));
    const R r = sqrt(q), phi = 2 * pi<R>() * in.u2;
    View<R> up;
    up.alpha_x = in.alpha_x, up.alpha_y = in.alpha_y, up.ex = R(1), up.ey = R(0);
    // The direction of the normal, not of the slope, lies at phi; e^(-r^2) = 1 - u1.
    return beckmann_unstretch<R>(up, -r * cos(phi), -r * sin(phi), in.v1 / pi<R>());
}

}  // namespace vndf::reference
