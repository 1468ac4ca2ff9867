// The Beckmann distribution (Gaussian slopes) with Smith masking: its terms and its densities.
//
// Conventions of vndf.h; the names of ggx.h. `alpha` is (alpha_x, alpha_y), each raised to 1e-8. Densities and terms
// use the vectors literally, without normalising them.
//
// Symbols: l = |(alpha_x w.x, alpha_y w.y)|, a = w.z / l (the cotangent of the stretched polar angle), and
// I(x) = 1 - sqrt(pi) x erfcx(x) = sqrt(pi) e^(x^2) ierfc(x). The part of the surface that is hidden from a is
// hidden(a) = l e^(-a^2) I(|a|) / (2 sqrt(pi)): sigma is w.z + hidden above the horizon and hidden below it, so that
// nothing cancels. Where e^(-a^2) meets another exponential, the exponents are combined first.
//
// Accuracy, unless stated: relative error in units of 2^-24 (double: 2^-53), times (1 + 2 q) where q is the exponent of
// the Gaussian; asserted by `clvndf check`.
#ifndef VNDF_BECKMANN_H
#define VNDF_BECKMANN_H

#include "config.h"
#include "math.h"
#include "frame.h"

// A direction as the slopes of the stretched surface see it.
struct vndf_impl_slopes {
    VNDF_REAL a;         // |cot theta|, at most 2^60
    VNDF_REAL hidden;    // I(|a|) / (2 sqrt(pi)): without l e^(-a^2)
    VNDF_REAL gaussian;  // e^(-a^2)
};
// 2^60: beyond it a Gaussian is cut nowhere, or seen at a cosine that rounds to 0; l = 0 is normal incidence.
VNDF_FN struct vndf_impl_slopes vndf_impl_slopes_of(VNDF_REAL l, VNDF_REAL z) {
    struct vndf_impl_slopes s;
    VNDF_REAL limit = VNDF_R(1152921504606846976.0);
    s.a = l > VNDF_R(0.0) ? vndf_impl_min(vndf_impl_abs(z) / l, limit) : limit;
    s.hidden = VNDF_R(0.5) * VNDF_1_SQRT_PI * vndf_impl_ierfcx(s.a);
    s.gaussian = vndf_impl_expx2(s.a);
    return s;
}

// scale e^(-x^2 - y^2), where the rounding of the squares is compensated.
VNDF_FN VNDF_REAL vndf_impl_gaussian(VNDF_REAL x, VNDF_REAL y, VNDF_REAL scale) {
    VNDF_REAL xx = x * x, square = VNDF_FMA(y, y, xx);
    VNDF_REAL low = VNDF_FMA(x, x, -xx) + (VNDF_FMA(y, y, xx - square));
    // Beyond the range of the exponential (low is infinite or NaN if x^2 overflows) the result is 0.
    return vndf_impl_scaled_exp(-square, square < -VNDF_IMPL_EXP_MIN ? -low : VNDF_R(0.0), scale);
}

// D for a normal (x, y, z) of any length, times `scale`.
VNDF_FN VNDF_REAL vndf_impl_beckmann_d(VNDF_REAL x, VNDF_REAL y, VNDF_REAL z, VNDF_REAL alpha_x,
                                       VNDF_REAL alpha_y) {
    VNDF_REAL z2 = z * z;
    VNDF_REAL d =
        vndf_impl_gaussian(x / alpha_x / z, y / alpha_y / z, VNDF_1_PI / ((z2 * alpha_x) * (z2 * alpha_y)));
    return z > VNDF_R(0.0) ? vndf_impl_finite(d) : VNDF_R(0.0);
}

// The distribution of normals D.
// Source: Walter et al., Microfacet Models for Refraction through Rough Surfaces, 2007, Equation 25 (m = wm), in the
//     anisotropic vector form of Heitz, Understanding the Masking-Shadowing Function, 2014.
// wm: unit normal, local frame.
// alpha: in [1e-8, 1e3] each.
// return: per steradian of wm per unit projected area: its integral with wm.z is 1; 0 for wm.z <= 0.
// Accuracy: 8 (1 + 2 q).
VNDF_FN VNDF_REAL vndf_beckmann_ndf(VNDF_REAL3 wm, VNDF_REAL2 alpha) {
    return vndf_impl_beckmann_d(wm.x, wm.y, wm.z, vndf_impl_alpha(alpha.x), vndf_impl_alpha(alpha.y));
}

// The distribution of slopes P22.
// Source: Heitz & d'Eon, Importance Sampling Microfacet-Based BSDFs with the Distribution of Visible Normals, 2014,
//     supplement 1, Section 3.1, scaled by alpha.
// slope: (x, y) of the normal (-x, -y, 1), any real numbers.
// return: per unit of slope area, integral 1.
// Accuracy: 8 (1 + 2 q).
VNDF_FN VNDF_REAL vndf_beckmann_p22(VNDF_REAL2 slope, VNDF_REAL2 alpha) {
    return vndf_impl_beckmann_d(slope.x, slope.y, VNDF_R(1.0), vndf_impl_alpha(alpha.x),
                                vndf_impl_alpha(alpha.y));
}

// Smith's Lambda.
// Source: Heitz 2014, Equation 66, as e^(-a^2) I(a) / (2 sqrt(pi) a), which does not cancel.
// w: unit vector, local frame.
// return: >= 0 above the horizon. Below it, sigma(w) / w.z - 1 = -1 - Lambda(-w), so that (1 + Lambda) w.z is the
//     projected area everywhere. The largest finite number at the pole w.z = 0.
// Accuracy: 8 (1 + 2 q), q = a^2.
VNDF_FN VNDF_REAL vndf_beckmann_lambda(VNDF_REAL3 w, VNDF_REAL2 alpha) {
    struct vndf_impl_view v = vndf_impl_stretch(w, alpha);
    struct vndf_impl_slopes s = vndf_impl_slopes_of(v.l, w.z);
    VNDF_REAL pole = s.hidden * s.gaussian / s.a;
    VNDF_REAL upper = vndf_impl_finite(vndf_impl_abs(w.z) > VNDF_R(0.0) ? pole : VNDF_REAL_MAX);
    return w.z < VNDF_R(0.0) ? -VNDF_R(1.0) - upper : upper;
}

// The projected area of the microsurface seen from w.
// Source: Heitz & d'Eon 2014, supplement 1, Section 3.2: w.z / G1(w), as max(w.z, 0) + hidden(a).
// w: unit vector, local frame, anywhere on the sphere.
// return: >= 0, per unit area of the macrosurface. Integral of D max(w . m, 0).
// Accuracy: 8, below the horizon 8 (1 + 2 q), q = a^2.
VNDF_FN VNDF_REAL vndf_beckmann_sigma(VNDF_REAL3 w, VNDF_REAL2 alpha) {
    struct vndf_impl_view v = vndf_impl_stretch(w, alpha);
    struct vndf_impl_slopes s = vndf_impl_slopes_of(v.l, w.z);
    return VNDF_FMA(v.l * s.gaussian, s.hidden, vndf_impl_max(w.z, VNDF_R(0.0)));
}

// Smith masking of one direction, for a normal that faces it.
// Source: Heitz 2014, Equation 43: 1 / (1 + Lambda).
// w: unit vector, local frame.
// return: in [0, 1]; 0 for w.z <= 0.
// Accuracy: 8.
VNDF_FN VNDF_REAL vndf_beckmann_g1(VNDF_REAL3 w, VNDF_REAL2 alpha) {
    return w.z > VNDF_R(0.0) ? VNDF_R(1.0) / (VNDF_R(1.0) + vndf_beckmann_lambda(w, alpha)) : VNDF_R(0.0);
}

// Height-correlated masking and shadowing of a reflection.
// Source: Heitz 2014, Equation 99: 1 / (1 + Lambda(wo) + Lambda(wi)).
// wo, wi: unit vectors, local frame.
// return: in [0, 1]; 0 unless both are above the horizon.
// Accuracy: 8.
VNDF_FN VNDF_REAL vndf_beckmann_g2(VNDF_REAL3 wo, VNDF_REAL3 wi, VNDF_REAL2 alpha) {
    VNDF_REAL sum = VNDF_R(1.0) + vndf_beckmann_lambda(wo, alpha) + vndf_beckmann_lambda(wi, alpha);
    return wo.z > VNDF_R(0.0) && wi.z > VNDF_R(0.0) ? VNDF_R(1.0) / sum : VNDF_R(0.0);
}

// Separable masking and shadowing: G1(wo) G1(wi).
// Source: Heitz 2014, Equation 98.
// wo, wi: unit vectors, local frame.
// return: in [0, 1]; 0 unless both are above the horizon.
// Accuracy: 8.
VNDF_FN VNDF_REAL vndf_beckmann_g2_separable(VNDF_REAL3 wo, VNDF_REAL3 wi, VNDF_REAL2 alpha) {
    return vndf_beckmann_g1(wo, alpha) * vndf_beckmann_g1(wi, alpha);
}

// The component of the slope of (x, y, .) across the stretched wo, times l and the height of the normal:
// x wo.y alpha_y / alpha_x - y wo.x alpha_x / alpha_y. Behind the surface both terms may be 1e8 times their difference:
// products and quotients carry their rounding errors along.
VNDF_FN VNDF_REAL vndf_impl_slope_across(VNDF_REAL3 wo, VNDF_REAL x, VNDF_REAL y, VNDF_REAL alpha_x,
                                         VNDF_REAL alpha_y) {
    VNDF_REAL up = alpha_y / alpha_x, down = alpha_x / alpha_y;
    VNDF_REAL up_low = VNDF_FMA(-up, alpha_x, alpha_y) / alpha_x;
    VNDF_REAL down_low = VNDF_FMA(-down, alpha_y, alpha_x) / alpha_y;
    VNDF_REAL p = x * wo.y, q = y * wo.x;
    VNDF_REAL p_low = VNDF_FMA(x, wo.y, -p), q_low = VNDF_FMA(y, wo.x, -q);
    VNDF_REAL low = VNDF_FMA(p, up_low, p_low * up) - VNDF_FMA(q, down_low, q_low * down);
    return vndf_impl_difference_of_products(p, up, q, down) + low;
}

// weight D / sigma(wo) for a normal (x, y, z): 1 / height^4 of D is `rise`^2, and cosine is wo . (x, y, z), exact to
// rounding. Behind the surface the exponents of D and sigma combine: with the slope A + tau along wo and y across,
// A = |a|, q - A^2 = tau (2 A + tau) + y^2.
VNDF_FN VNDF_REAL vndf_impl_beckmann_visible(VNDF_REAL3 wo, VNDF_REAL x, VNDF_REAL y, VNDF_REAL z,
                                             VNDF_REAL cosine, VNDF_REAL rise, VNDF_REAL weight,
                                             VNDF_REAL2 alpha) {
    struct vndf_impl_view v = vndf_impl_stretch(wo, alpha);
    struct vndf_impl_slopes s = vndf_impl_slopes_of(v.l, wo.z);
    int front = wo.z >= VNDF_R(0.0);
    VNDF_REAL sx = x / v.alpha_x / z, sy = y / v.alpha_y / z;
    VNDF_REAL tau = cosine / (z * v.l);
    VNDF_REAL across = vndf_impl_slope_across(wo, x, y, v.alpha_x, v.alpha_y) / (z * v.l);
    VNDF_REAL steep = VNDF_FMA(tau, VNDF_FMA(VNDF_R(2.0), s.a, tau), across * across);
    VNDF_REAL exponent = front ? VNDF_FMA(sx, sx, sy * sy) : steep;
    // Small factors first: below the horizon l I(a) may be as small as weight.
    VNDF_REAL share = front ? weight / VNDF_FMA(v.l * s.gaussian, s.hidden, wo.z) : weight / v.l / s.hidden;
    VNDF_REAL scale = VNDF_1_PI * share * (rise / v.alpha_x) * (rise / v.alpha_y);
    VNDF_REAL result = vndf_impl_finite(vndf_impl_scaled_exp(-exponent, VNDF_R(0.0), scale));
    return z > VNDF_R(0.0) && (front || v.l > VNDF_R(0.0)) ? result : VNDF_R(0.0);
}

// The distribution of visible normals: the density of every vndf_beckmann_sample_wm_* but walter2007.
// Source: Heitz & d'Eon, Importance Sampling Microfacet-Based BSDFs with the Distribution of Visible Normals, 2014:
//     max(wo . wm, 0) D(wm) / sigma(wo).
// wo: unit vector, local frame, anywhere on the sphere (at -z nothing is visible: 0).
// wm: unit normal, local frame.
// return: per steradian of wm; 0 for wm.z <= 0 or wo . wm <= 0.
// Accuracy: 16 (1 + 2 q).
VNDF_FN VNDF_REAL vndf_beckmann_pdf_wm(VNDF_REAL3 wo, VNDF_REAL3 wm, VNDF_REAL2 alpha) {
    VNDF_REAL cosine = vndf_impl_dot(wo.x, wo.y, wo.z, wm.x, wm.y, wm.z);
    VNDF_REAL rise = VNDF_R(1.0) / (wm.z * wm.z);
    VNDF_REAL pdf = vndf_impl_beckmann_visible(wo, wm.x, wm.y, wm.z, cosine, rise, cosine, alpha);
    return cosine > VNDF_R(0.0) ? pdf : VNDF_R(0.0);
}

// The density of the reflection of wo about a visible normal.
// Source: Heitz & d'Eon 2014, with the reflection Jacobian: D(h) / (4 sigma(wo)), h = wo + wi.
// wo: unit vector, local frame, anywhere on the sphere.
// wi: unit vector, local frame, anywhere on the sphere: a reflection may fall below the horizon.
// return: per steradian of wi; 0 where the half vector points to or below the horizon.
// Accuracy: 16 (1 + 2 q) for the vectors as given. Below alpha = 1e-2 the rounding of wi moves the density by more
//     than that: use a sampler's _with_pdf form there.
VNDF_FN VNDF_REAL vndf_beckmann_pdf_wi(VNDF_REAL3 wo, VNDF_REAL3 wi, VNDF_REAL2 alpha) {
    VNDF_REAL x = wo.x + wi.x, y = wo.y + wi.y, z = wo.z + wi.z;
    VNDF_REAL cosine =
        vndf_impl_dot(wo.x, wo.y, wo.z, wi.x, wi.y, wi.z) + vndf_impl_dot(wo.x, wo.y, wo.z, wo.x, wo.y, wo.z);
    VNDF_REAL tx = x / z, ty = y / z;
    VNDF_REAL rise = VNDF_FMA(tx, tx, VNDF_FMA(ty, ty, VNDF_R(1.0)));
    return vndf_impl_beckmann_visible(wo, x, y, z, cosine, rise, VNDF_R(0.25), alpha);
}

// The density of the plain NDF sampler: D(wm) wm.z.
// Source: Walter et al. 2007, Equation 24.
// wm: unit normal, local frame.
// return: per steradian of wm; 0 for wm.z <= 0.
// Accuracy: 16 (1 + 2 q).
VNDF_FN VNDF_REAL vndf_beckmann_pdf_wm_walter2007(VNDF_REAL3 wm, VNDF_REAL2 alpha) {
    return vndf_impl_finite(vndf_beckmann_ndf(wm, alpha) * wm.z);
}

// --- Visible slopes at alpha = 1, in the plane of incidence ---
//
// t = -x is the slope towards the view direction, d = c + s t with c, s = cos, sin of its polar angle, tau = d / s.
// Their distribution is the tail of F(t) = integral of d e^(-t^2) / sqrt(pi) beyond t over F(-cot theta) = sigma.

// The view direction, s > 0 or c > 0.
struct vndf_impl_incidence_slopes {
    VNDF_REAL c, s;
    VNDF_REAL a, top;  // |c / s| and max(-c / s, 0): t = top + offset, where the offset keeps the digits
    VNDF_REAL hidden;
    VNDF_REAL gaussian;
    VNDF_REAL norm;  // sigma in front; behind the surface hidden, without s e^(-a^2)
    VNDF_REAL edge;  // in front: 2 sqrt(pi) sigma e^(a^2) / s
    int front;
};
VNDF_FN struct vndf_impl_incidence_slopes vndf_impl_beckmann_incidence(VNDF_REAL c, VNDF_REAL s) {
    struct vndf_impl_incidence_slopes i;
    struct vndf_impl_slopes slopes = vndf_impl_slopes_of(s, c);
    i.front = c >= VNDF_R(0.0);
    i.c = c;
    i.s = s;
    i.a = slopes.a;
    i.top = i.front ? VNDF_R(0.0) : slopes.a;
    i.hidden = slopes.hidden;
    i.gaussian = slopes.gaussian;
    i.norm = i.front ? VNDF_FMA(s * slopes.gaussian, slopes.hidden, c) : slopes.hidden;
    i.edge = VNDF_R(2.0) * VNDF_SQRT_PI * i.norm / (s * slopes.gaussian);
    return i;
}

// F(t) / sigma at t = top + offset and its derivative.
struct vndf_impl_tail {
    VNDF_REAL share;    // F / sigma, in [0, 1]
    VNDF_REAL density;  // -dF / dt / sigma
    VNDF_REAL d;        // d, behind the surface tau
};
VNDF_FN struct vndf_impl_tail vndf_impl_beckmann_tail(struct vndf_impl_incidence_slopes i, VNDF_REAL offset) {
    struct vndf_impl_tail r;
    VNDF_REAL t = i.top + offset, x = vndf_impl_abs(t);
    // Behind the surface t^2 - top^2 = offset (2 top + offset); in front this is t^2.
    VNDF_REAL e_square = offset * VNDF_FMA(VNDF_R(2.0), i.top, offset);
    VNDF_REAL low = VNDF_FMA(offset, VNDF_FMA(VNDF_R(2.0), i.top, offset), -e_square);
    VNDF_REAL share = VNDF_R(1.0) / i.norm;
    VNDF_REAL e = vndf_impl_scaled_exp(-e_square, -low, share);
    // In front: c erfc(t) / 2 + s e / (2 sqrt(pi)); behind: e (tau + top I(t)) / (2 sqrt(pi) t).
    VNDF_REAL beyond = VNDF_R(0.5) * i.c * vndf_impl_erfcx(x) * e;
    VNDF_REAL upper = t < VNDF_R(0.0) ? VNDF_FMA(i.c, share, -beyond) : beyond;
    VNDF_REAL edge = VNDF_R(0.5) * VNDF_1_SQRT_PI * e;
    VNDF_REAL behind = edge * VNDF_FMA(i.top, vndf_impl_ierfcx(x), offset) / t;
    r.share = i.front ? VNDF_FMA(i.s, edge, upper) : behind;
    r.d = i.front ? VNDF_FMA(i.s, t, i.c) : offset;
    r.density = r.d * VNDF_1_SQRT_PI * e;
    return r;
}

// The marginal density of visible slopes in the plane of incidence, alpha = 1.
// Source: Heitz & d'Eon 2014, supplement 1, Section 3.2.
// cos_theta: of the view direction, in [-1, 1] (at -1 nothing is visible: 0).
// x: slope of the normal (-x, ., 1), positive away from the view direction.
// return: per unit of slope, integral 1 over x < cot(theta); 0 beyond.
// Accuracy: 16 (1 + 2 q).
VNDF_FN VNDF_REAL vndf_beckmann_slope_pdf(VNDF_REAL cos_theta, VNDF_REAL x) {
    struct vndf_impl_incidence_slopes i =
        vndf_impl_beckmann_incidence(cos_theta, vndf_impl_sin_from_cos(cos_theta));
    VNDF_REAL visible = vndf_impl_visible_cosine(cos_theta, x);
    VNDF_REAL tau = i.front ? visible : visible / i.s;
    VNDF_REAL exponent = i.front ? x * x : tau * VNDF_FMA(VNDF_R(2.0), i.top, tau);
    VNDF_REAL pdf = vndf_impl_scaled_exp(-exponent, VNDF_R(0.0), VNDF_1_SQRT_PI * tau / i.norm);
    return visible > VNDF_R(0.0) ? vndf_impl_finite(pdf) : VNDF_R(0.0);
}

// Its cumulative distribution.
// Source: Heitz & d'Eon 2014, supplement 1, Section 3.2.
// cos_theta, x: as for vndf_beckmann_slope_pdf.
// return: in [0, 1]; 1 for x >= cot(theta), and for cos_theta = -1, where nothing is visible.
// Accuracy: 16 (1 + 2 q).
VNDF_FN VNDF_REAL vndf_beckmann_slope_cdf(VNDF_REAL cos_theta, VNDF_REAL x) {
    struct vndf_impl_incidence_slopes i =
        vndf_impl_beckmann_incidence(cos_theta, vndf_impl_sin_from_cos(cos_theta));
    VNDF_REAL visible = vndf_impl_visible_cosine(cos_theta, x);
    VNDF_REAL cdf = vndf_impl_beckmann_tail(i, i.front ? -x : visible / i.s).share;
    return visible > VNDF_R(0.0) && cdf < VNDF_R(1.0) ? cdf : VNDF_R(1.0);
}

// One step towards the offset with share u: Halley's on log(share / u), whose logarithm is 2 (r - 1) / (r + 1) near
// r = 1. `low` and `high` bracket the root (<=: a converged root lies on the bracket); a step that leaves them, far
// from the root, bisects.
struct vndf_impl_root {
    VNDF_REAL offset, low, high;
};
VNDF_FN struct vndf_impl_root vndf_impl_beckmann_step(struct vndf_impl_incidence_slopes i, VNDF_REAL u,
                                                      struct vndf_impl_root root) {
    struct vndf_impl_tail tail = vndf_impl_beckmann_tail(i, root.offset);
    VNDF_REAL excess = tail.share - u;
    int below = excess > VNDF_R(0.0);
    root.low = below ? root.offset : root.low;
    root.high = below ? root.high : root.offset;
    VNDF_REAL rate = tail.density / tail.share;
    VNDF_REAL newton = VNDF_R(2.0) * excess / ((tail.share + u) * rate);
    VNDF_REAL curvature = (i.front ? i.s : VNDF_R(1.0)) / tail.d - VNDF_R(2.0) * (i.top + root.offset) + rate;
    VNDF_REAL denominator = VNDF_FMA(VNDF_R(0.5) * newton, curvature, VNDF_R(1.0));
    denominator = vndf_impl_min(vndf_impl_max(denominator, VNDF_R(0.5)), VNDF_R(2.0));
    VNDF_REAL next = root.offset + newton / denominator;
    int inside = next >= root.low && next <= root.high;
    root.offset = inside ? next : VNDF_R(0.5) * (root.low + root.high);
    return root;
}

// Where to start: the offset within a factor 2 of t + cot(theta), which three steps (double: four) bring to rounding.
//
// In front, with g = a + erfcinv(2 u) by Winitzki's approximation: t + a is near g + 0.35 / g for large g, where the
// Gaussian is cut far away, and below sqrt(L / k), L = -log(u), for small ones, k = s e^(-a^2) / (2 sqrt(pi) sigma) being
// half the slope of the density at its end. Behind the surface offset (2 top + offset) lies between L, for top = 0, and
// the root of y - log(1 + y) = L, for top = infinity, near sqrt(2 L) + 3/4 L.
VNDF_FN struct vndf_impl_root vndf_impl_beckmann_start(struct vndf_impl_incidence_slopes i, VNDF_REAL u) {
    struct vndf_impl_root root;
    VNDF_REAL rest = VNDF_R(1.0) - u, m = vndf_impl_min(u, rest);
    VNDF_REAL log_r = vndf_impl_log(VNDF_R(4.0) * u * rest);
    // -log(1 - m) to 1 % on [0, 1/2], and log(u) from it.
    VNDF_REAL q =
        VNDF_FMA(VNDF_FMA(VNDF_FMA(VNDF_R(0.534), m, VNDF_R(0.278)), m, VNDF_R(0.5)), m, VNDF_R(1.0)) * m;
    VNDF_REAL big_l = u > VNDF_R(0.5) ? q : VNDF_R(1.38629436) - log_r - q;

    VNDF_REAL linear = VNDF_FMA(VNDF_R(0.5), log_r, VNDF_R(4.33074675));
    VNDF_REAL square = VNDF_SQRT(VNDF_FMA(linear, linear, VNDF_R(-6.80272109) * log_r)) - linear;
    VNDF_REAL root_l = VNDF_SQRT(big_l);
    VNDF_REAL normal = VNDF_SQRT(vndf_impl_max(square, VNDF_R(0.0)));
    normal = u > VNDF_R(0.5) ? -normal : normal;
    VNDF_REAL g = normal + i.a;
    VNDF_REAL hinge = vndf_impl_max(normal, -i.a) +
                      VNDF_R(0.7) / (vndf_impl_abs(g) + VNDF_SQRT(VNDF_FMA(g, g, VNDF_R(1.4))));
    VNDF_REAL edge = VNDF_FMA(root_l, VNDF_SQRT(i.edge), -i.a);

    VNDF_REAL reach = VNDF_SQRT(VNDF_R(2.0) * VNDF_SQRT_PI * i.hidden);
    VNDF_REAL grazing = i.a * reach;  // 0 for top = 0, 1 / sqrt(2) for top = infinity
    VNDF_REAL v = VNDF_FMA(VNDF_R(2.0) * grazing, root_l,
                           big_l * VNDF_FMA(VNDF_R(-0.5) * grazing, grazing, VNDF_R(1.0)));
    VNDF_REAL v_high = VNDF_R(1.1) * VNDF_FMA(VNDF_R(1.41421356), root_l, big_l);

    root.offset = i.front ? vndf_impl_min(hinge, edge) : v / (i.a + VNDF_SQRT(VNDF_FMA(i.a, i.a, v)));
    root.low = i.front ? vndf_impl_max(-i.a, VNDF_R(-8.0)) : VNDF_R(0.0);
    root.high = i.front ? VNDF_R(1.1) * root_l : v_high / (i.a + VNDF_SQRT(VNDF_FMA(i.a, i.a, v_high)));
    return root;
}

// The offset beyond which the share u of the visible slopes lies: the root of the distribution, monotone in u.
VNDF_FN VNDF_REAL vndf_impl_beckmann_offset(struct vndf_impl_incidence_slopes i, VNDF_REAL u) {
    struct vndf_impl_root root = vndf_impl_beckmann_start(i, u);
    root = vndf_impl_beckmann_step(i, u, root);
    root = vndf_impl_beckmann_step(i, u, root);
#if VNDF_DOUBLE
    root = vndf_impl_beckmann_step(i, u, root);
#endif
    return vndf_impl_beckmann_step(i, u, root).offset;
}

// The inverse of vndf_beckmann_slope_cdf.
// Source: Jakob, An Improved Visible Normal Sampling Routine for the Beckmann Distribution, 2014, whose equation in erf x
//     is solved here in x, in forms that do not cancel behind the surface.
// cos_theta: in [-1, 1].
// u1: probability, clamped to [2^-33, 1 - 2^-24] (double: [2^-65, 1 - 2^-53]).
// return: the slope x < cot(theta); minus the largest finite number at cos_theta = -1.
// Accuracy: 16 (1 + condition number).
VNDF_FN VNDF_REAL vndf_beckmann_slope_cdf_inverse(VNDF_REAL cos_theta, VNDF_REAL u1) {
    struct vndf_impl_incidence_slopes i =
        vndf_impl_beckmann_incidence(cos_theta, vndf_impl_sin_from_cos(cos_theta));
    VNDF_REAL x = -(i.top + vndf_impl_beckmann_offset(i, vndf_impl_u(u1)));
    return cos_theta > VNDF_R(-1.0) ? x : -VNDF_REAL_MAX;
}

// --- What the samplers share ---

// The plane of incidence of a stretched view direction: its azimuth, (1, 0) if it has none, and its slopes.
struct vndf_impl_beckmann_frame {
    VNDF_REAL alpha_x, alpha_y, ex, ey, z, l;
    struct vndf_impl_incidence_slopes slopes;
};
VNDF_FN struct vndf_impl_beckmann_frame vndf_impl_beckmann_frame_of(VNDF_REAL3 wo, VNDF_REAL2 alpha) {
    struct vndf_impl_view v = vndf_impl_stretch(wo, alpha);
    struct vndf_impl_beckmann_frame f;
    VNDF_REAL rcp_r = VNDF_R(1.0) / v.r;
    f.alpha_x = v.alpha_x;
    f.alpha_y = v.alpha_y;
    f.ex = v.rcp_l > VNDF_R(0.0) ? v.x * v.rcp_l : VNDF_R(1.0);
    f.ey = v.y * v.rcp_l;
    f.z = v.z;
    f.l = v.l;
    f.slopes = vndf_impl_beckmann_incidence(v.z * rcp_r, v.l * rcp_r);
    return f;
}

// The normal of the slopes (t, y) towards and across e, before the stretch, and its density |g|^3 / (alpha_x alpha_y)
// times `weight` e^(-exponent), g = (alpha_x h_x, alpha_y h_y, 1). All is scaled by a power of two near 1 / t: squares
// of t may overflow.
VNDF_FN struct vndf_impl_sample vndf_impl_beckmann_unstretch(VNDF_REAL ex, VNDF_REAL ey, VNDF_REAL t,
                                                             VNDF_REAL y, VNDF_REAL alpha_x,
                                                             VNDF_REAL alpha_y, VNDF_REAL weight) {
    struct vndf_impl_sample m;
    VNDF_REAL scale = vndf_impl_scale(VNDF_R(1.0) + vndf_impl_abs(t));
    VNDF_REAL ts = t * scale, ys = y * scale;
    VNDF_REAL gx = alpha_x * vndf_impl_difference_of_products(ts, ex, ys, ey);
    VNDF_REAL gy = alpha_y * vndf_impl_difference_of_products(ts, ey, -ys, ex);
    VNDF_REAL length = VNDF_SQRT(VNDF_FMA(gx, gx, VNDF_FMA(gy, gy, scale * scale)));
    VNDF_REAL rcp = VNDF_R(1.0) / length, rise = length / scale;
    m.x = gx * rcp;
    m.y = gy * rcp;
    m.z = scale * rcp;
    m.pdf = vndf_impl_finite(weight * (rise / alpha_x) * (rise / alpha_y) * rise);
    return m;
}

// The normal at `offset` (see the tail above) along and y across the plane of incidence, with its visible density.
VNDF_FN struct vndf_impl_sample vndf_impl_beckmann_normal(struct vndf_impl_beckmann_frame f, VNDF_REAL offset,
                                                          VNDF_REAL y) {
    struct vndf_impl_incidence_slopes i = f.slopes;
    VNDF_REAL t = i.top + offset;
    VNDF_REAL d = i.front ? vndf_impl_max(VNDF_FMA(i.s, t, i.c), VNDF_R(0.0)) : offset;
    VNDF_REAL sum = VNDF_FMA(VNDF_R(2.0), i.top, offset), square = offset * sum;
    VNDF_REAL exponent = VNDF_FMA(y, y, square);
    VNDF_REAL low = VNDF_FMA(offset, sum, -square) + VNDF_FMA(y, y, square - exponent);
    VNDF_REAL weight = vndf_impl_scaled_exp(-exponent, -low, VNDF_1_PI * d / i.norm);
    // At wo = -z nothing is visible.
    weight = i.front || f.l > VNDF_R(0.0) ? weight : VNDF_R(0.0);
    return vndf_impl_beckmann_unstretch(f.ex, f.ey, t, y, f.alpha_x, f.alpha_y, weight);
}

#endif
