// The reflections into a cap wi . l > cos(beta), in the axes of their cone.
//
// A unit normal m of the stretched frame, g = A m, reflects wo into the cap where
//     2 (wo . g)(l . g) > (cos(beta) + wo . l) |g|^2,
// or m^T Q m > 0 with Q = v w^T + w v^T - kappa A^2, v = A wo, w = A l. The axes of Q are found by rotations (Jacobi), in more
// digits than R has; the moves are those of conic_maps.h. That this is the cap, and its area, is tested by quadrature over
// directions (distribution.h, tests/support/cone_claims.cpp).
#pragma once

#include <boost/multiprecision/cpp_bin_float.hpp>

#include "reference/terms.h"

namespace vndf::reference {

// A cap of directions, a light; one_minus_cos counts as 2^-50 (f32) or 2^-108 (f64) where it is less.
template <class R>
struct Light {
    Vec3<R> l;  // unit
    R one_minus_cos;
    R part;  // of what it counts as
};
template <class R>
Light<R> light_of(const Vec3<R>& l, const R& one_minus_cos, Precision precision) {
    const Real<R> least = precision == Precision::f32 ? Real<R>(0x1p-50) : Real<R>(0x1p-108);
    const R size = one_minus_cos < 0 ? R(0) : one_minus_cos > 2 ? R(2) : one_minus_cos;
    return {normalised(l), size < least ? R(least) : size, size < least ? R(size / least) : R(1)};
}

template <class T>
struct WiderOf;
template <>
struct WiderOf<double> {
    using type = long double;
};
template <>
struct WiderOf<long double> {
    using type = boost::multiprecision::cpp_bin_float_quad;
};

template <class R>
struct LightView {
    Vec3<R> wo, l;
    R alpha_x, alpha_y;
    R one_minus_cos, kappa, length;  // length of A wo
    // Whether -wo is outside the cap, by more than 2^-12 of its size if that is below 60 degrees.
    bool outside = true;
};
// cos(beta) + wo . l, with 1 + wo . l as half a square: neither this nor 1 - cos(beta) is rounded where they are all but
// nothing; and of 90 degrees, where wo . l may be that.
template <class R>
R cap_kappa(const Vec3<R>& wo, const Light<R>& cap) {
    const Vec3<R> sum{wo.x + cap.l.x, wo.y + cap.l.y, wo.z + cap.l.z};
    return value_of(cap.one_minus_cos) == 1 ? R(dot(wo, cap.l) + (1 - cap.one_minus_cos))
                                            : R(dot(sum, sum) / 2 - cap.one_minus_cos);
}

template <class R>
LightView<R> light_view(const Vec3<R>& wo, const Light<R>& cap, const R& alpha_x, const R& alpha_y) {
    const R length = hypotenuse(hypotenuse(R(alpha_x * wo.x), R(alpha_y * wo.y)), wo.z);
    const R kappa = cap_kappa(wo, cap), edge = cap.one_minus_cos * Real<R>(0x1p-12);
    return {wo,
            cap.l,
            alpha_x,
            alpha_y,
            cap.one_minus_cos,
            kappa,
            length,
            kappa > (cap.one_minus_cos > Real<R>(0.5) ? R(0) : edge)};
}

template <class S, class R>
LightView<S> widened(const LightView<R>& v) {
    const auto wide = [](const Vec3<R>& a) {
        return Vec3<S>{S(value_of(a.x)), S(value_of(a.y)), S(value_of(a.z))};
    };
    const Light<S> cap{wide(v.l), S(value_of(v.one_minus_cos)), S(1)};
    LightView<S> w{wide(v.wo), cap.l, S(value_of(v.alpha_x)), S(value_of(v.alpha_y)), cap.one_minus_cos,
                   S(0),       S(0)};
    w.kappa = cap_kappa(w.wo, cap);
    return w;
}

template <class R>
void cap_matrix(const LightView<R>& c, R (&q)[3][3]) {
    const R a[3] = {c.alpha_x, c.alpha_y, R(1)}, o[3] = {c.wo.x, c.wo.y, c.wo.z},
            l[3] = {c.l.x, c.l.y, c.l.z};
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) {
            q[i][j] = a[i] * a[j] * (o[i] * l[j] + l[i] * o[j]);
            if (i == j) q[i][j] = q[i][j] - c.kappa * a[i] * a[i];
        }
    // 2 wo.z l.z - kappa = 1 - cos(beta) - |l - r|^2 / 2, r the mirror image of wo.
    const R x = o[0] + l[0], y = o[1] + l[1], z = l[2] - o[2];
    q[2][2] = value_of(c.one_minus_cos) == 1
                  ? R(o[2] * l[2] - o[0] * l[0] - o[1] * l[1] - (1 - c.one_minus_cos))
                  : R(c.one_minus_cos - (x * x + y * y + z * z) / 2);
}

// The frame across e0 that the axes are counted from where the cone is round or v lies across e1: b = z x e0, a x b = e0.
template <class R>
void frame_across(const Vec3<R>& e, Vec3<R>& a, Vec3<R>& b) {
    const R level = hypotenuse(e.x, e.y);
    const bool up = !(level > 0);
    const R x = up ? R(1) : R(e.x / level), y = up ? R(0) : R(e.y / level);
    a = {x * e.z, y * e.z, -level};
    b = {-y, x, R(0)};
}

// All normals that face wo: what a cap with -wo in it stands for.
template <class R>
Cone<R> facing_cone(const Vec3<R>& s) {
    Cone<R> c;
    c.mu = R(1), c.mu1 = c.mu2 = R(0);
    c.e0 = s;
    frame_across(s, c.e1, c.e2);
    c.s0 = R(1), c.s1 = c.s2 = R(0);
    c.p2 = c.q2 = R(1), c.co_p2 = c.co_q2 = R(0);
    return c;
}

// Their map, in which the rim has no height.
template <class R>
StretchedNormal<R> facing_normal(const Cone<R>& c, const Arguments<R>& in) {
    using std::cos, std::sin, std::sqrt;
    const R phi = 2 * pi<R>() * in.u1, radius = sqrt(in.u2), up = sqrt(in.v2);
    const R m1 = radius * sin(phi), m2 = radius * cos(phi);
    return {up * c.e0.x + m1 * c.e1.x + m2 * c.e2.x, up * c.e0.y + m1 * c.e1.y + m2 * c.e2.y,
            up * c.e0.z + m1 * c.e1.z + m2 * c.e2.z, up};
}

template <class R>
Cone<R> cap_cone(const LightView<R>& v) {
    using T = Real<R>;
    using W = typename WiderOf<T>::type;
    const R rcp = 1 / v.length;
    const Vec3<R> s{v.alpha_x * v.wo.x * rcp, v.alpha_y * v.wo.y * rcp, v.wo.z * rcp};
    if (!v.outside) return facing_cone(s);

    const LightView<W> wide = widened<W>(v);
    W a[3][3];
    cap_matrix(wide, a);
    const Eigen<W> eigen = jacobi(a);
    const auto vector = [&](int i) { return Vec3<W>{eigen.v[0][i], eigen.v[1][i], eigen.v[2][i]}; };
    // The quotient of Rayleigh in the terms of the cap, where rotations have left the error of the largest eigenvalue.
    const auto rayleigh = [&](int i) {
        const Vec3<W> m = vector(i), g{wide.alpha_x * m.x, wide.alpha_y * m.y, m.z};
        const W g2 = dot(g, g), twice = 2 * dot(wide.wo, g) / g2;
        const Vec3<W> off{twice * g.x - wide.wo.x - wide.l.x, twice * g.y - wide.wo.y - wide.l.y,
                          twice * g.z - wide.wo.z - wide.l.z};
        const Vec3<W> mirrored{twice * g.x - wide.wo.x, twice * g.y - wide.wo.y, twice * g.z - wide.wo.z};
        const W depth =
            wide.one_minus_cos == 1 ? dot(mirrored, wide.l) : W(wide.one_minus_cos - dot(off, off) / 2);
        return W(g2 * depth / dot(m, m));
    };
    W value[3] = {rayleigh(0), rayleigh(1), rayleigh(2)};
    int order[3] = {0, 1, 2};
    if (eigen.value[1] > eigen.value[order[0]]) std::swap(order[0], order[1]);
    if (eigen.value[2] > eigen.value[order[0]]) std::swap(order[0], order[2]);
    if (value[order[1]] > value[order[2]]) std::swap(order[1], order[2]);
    Vec3<W> axis[3] = {vector(order[0]), vector(order[1]), vector(order[2])};
    const Vec3<W> view{wide.alpha_x * wide.wo.x, wide.alpha_y * wide.wo.y, wide.wo.z};
    const auto turned = [](const Vec3<W>& w) { return Vec3<W>{-w.x, -w.y, -w.z}; };
    if (dot(axis[0], view) < 0) axis[0] = turned(axis[0]);
    Vec3<W> first, second;
    frame_across(axis[0], first, second);
    // e1 points to where v lies from w.
    const Vec3<W> light{wide.alpha_x * wide.l.x, wide.alpha_y * wide.l.y, wide.l.z};
    W towards = dot(axis[1], view) * dot(axis[0], light) - dot(axis[1], light) * dot(axis[0], view);
    using std::abs;
    if (!(abs(towards) > 0)) {
        const W x = dot(axis[1], first), y = dot(axis[1], second);
        towards = abs(x) < abs(y) ? y : x;
    }
    if (towards < 0) axis[1] = turned(axis[1]);
    if (abs(value[order[1]] - value[order[2]]) < W(1e-17) * abs(value[order[1]])) axis[1] = first;
    axis[2] = {axis[0].y * axis[1].z - axis[0].z * axis[1].y, axis[0].z * axis[1].x - axis[0].x * axis[1].z,
               axis[0].x * axis[1].y - axis[0].y * axis[1].x};

    // First-order perturbation, as in conic_maps.h.
    R lambda[3], e[3][3];
    T at[3][3];
    for (int i = 0; i < 3; ++i) {
        at[i][0] = static_cast<T>(axis[i].x), at[i][1] = static_cast<T>(axis[i].y),
        at[i][2] = static_cast<T>(axis[i].z);
        lambda[i] = R(static_cast<T>(value[order[i]]));
        for (int k = 0; k < 3; ++k) e[i][k] = R(at[i][k]);
    }
    if constexpr (!std::is_same_v<R, T>) {
        R q[3][3];
        cap_matrix(v, q);
        for (int i = 0; i < 3; ++i)
            for (int j = 0; j < 3; ++j) {
                R d(0);
                for (int k = 0; k < 3; ++k)
                    for (int l = 0; l < 3; ++l) d = d + q[k][l] * (at[i][k] * at[j][l]);
                const T gap = static_cast<T>(W(value[order[i]] - value[order[j]]));
                for (std::size_t n = 0; n < d.partial.size(); ++n) {
                    if (i == j) lambda[i].partial[n] = d.partial[n];
                    if (i == j || !(std::abs(d.partial[n]) > 0)) continue;
                    for (int k = 0; k < 3; ++k) e[i][k].partial[n] += at[j][k] * d.partial[n] / gap;
                }
            }
    }
    Cone<R> c;
    c.mu = lambda[0], c.mu1 = -lambda[1], c.mu2 = -lambda[2];
    c.e0 = {e[0][0], e[0][1], e[0][2]}, c.e1 = {e[1][0], e[1][1], e[1][2]},
    c.e2 = {e[2][0], e[2][1], e[2][2]};
    c.s0 = dot(c.e0, s), c.s1 = dot(c.e1, s), c.s2 = dot(c.e2, s);
    if (c.mu2 < 0) c.mu2 = R(0);
    c.p2 = c.mu / (c.mu + c.mu1), c.co_p2 = c.mu1 / (c.mu + c.mu1);
    c.q2 = c.mu / (c.mu + c.mu2), c.co_q2 = c.mu2 / (c.mu + c.mu2);
    return c;
}

// Of the whole cone, whether or not it leaves the hemisphere of normals.
template <class R>
R ggx_sigma_cap(const Vec3<R>& wo, const Light<R>& cap, const R& alpha_x, const R& alpha_y) {
    const LightView<R> v = light_view(normalised(wo), cap, alpha_x, alpha_y);
    return v.length * cone_area(cap_cone(v)) * cap.part;
}

// How far inside the cap wi is, as a difference of chords.
template <class R>
R chord_margin(const Vec3<R>& wi, const Light<R>& cap) {
    using std::sqrt;
    const Vec3<R> i = normalised(wi), off{i.x - cap.l.x, i.y - cap.l.y, i.z - cap.l.z};
    const R root = sqrt(R(2 * cap.one_minus_cos)), chord = hypotenuse(hypotenuse(off.x, off.y), off.z);
    return root - chord;
}

template <class R>
Sample<R> ggx_cone2026(const Arguments<R>& in) {
    const Light<R> cap{in.l, in.one_minus_cos, in.cap_part};
    const LightView<R> v = light_view(in.wo, cap, in.alpha_x, in.alpha_y);
    const Cone<R> c = cap_cone(v);
    View<R> frame = view(in.wo, in.alpha_x, in.alpha_y);
    frame.ex = R(1), frame.ey = R(0);  // the axes are given along x, y and z
    const StretchedNormal<R> m = v.outside ? conic_normal(c, in) : facing_normal(c, in);
    Sample<R> s = ggx_reflected<R>(in, frame, m, v.length * cone_area(c) * cap.part);
    if (!(m.z > 0) || (!v.outside && !(chord_margin(s.direction, cap) > 0))) s.pdf = R(0);
    if (!(s.pdf < std::numeric_limits<Real<R>>::infinity())) s.pdf = R(0);  // a cap of no size
    return s;
}

// D(h) / (4 sigma_C) in the cap.
template <class R>
R ggx_pdf_wi_cone2026(const Vec3<R>& wo, const Vec3<R>& wi, const Light<R>& cap, const R& alpha_x,
                      const R& alpha_y) {
    const R sigma = ggx_sigma_cap(wo, cap, alpha_x, alpha_y);
    if (!(chord_margin(wi, cap) > 0) || !(sigma > 0)) return R(0);
    const Vec3<R> h = normalised<R>({wo.x + wi.x, wo.y + wi.y, wo.z + wi.z});
    return Ggx::ndf(h, alpha_x, alpha_y) / (4 * sigma);
}

template <class R>
DiskPoint<R> ggx_invert_cone2026(const Vec3<R>& wo, const Vec3<R>& wi, const Light<R>& cap, const R& alpha_x,
                                 const R& alpha_y) {
    const LightView<R> v = light_view(normalised(wo), cap, alpha_x, alpha_y);
    const Vec3<R> i = normalised(wi), h{v.wo.x + i.x, v.wo.y + i.y, v.wo.z + i.z};
    const R gx = h.x / alpha_x, gy = h.y / alpha_y, length = hypotenuse(hypotenuse(gx, gy), h.z);
    if (!(length > 0)) return {R(0), R(0)};
    const Vec3<R> m{gx / length, gy / length, h.z / length};
    const Cone<R> c = cap_cone(v);
    const R h2 = dot(h, h), cosine = h2 / (2 * length * v.length);
    if (!v.outside) {
        const R m1 = dot(c.e1, m), m2 = dot(c.e2, m), square = squared(m1) + squared(m2);
        return {turn_of(m2, m1), square < Real<R>(0.5) ? square : R(1 - squared(cosine))};
    }
    const Vec3<R> off{i.x - cap.l.x, i.y - cap.l.y, i.z - cap.l.z};
    const R inside = cap.one_minus_cos - dot(off, off) / 2;
    return disk_point<R>(c, m, cosine, (inside > 0 ? inside : R(0)) * h2 / (length * length));
}

}  // namespace vndf::reference
