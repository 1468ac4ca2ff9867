// Directions about a normal n, in the frame that all are given in.
//
// What is across n is w - (w . n) / (n . n) n, twice: the second time takes away what rounding left along n, so that it has its
// own relative accuracy however near w is to n.
#pragma once

#include <cmath>
#include <initializer_list>

#include "reference/terms.h"

namespace vndf::reference {

template <class R>
Vec3<R> cross(const Vec3<R>& a, const Vec3<R>& b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

// A sum of vectors about n.
template <class R>
struct About {
    Vec3<R> across;  // in the given frame
    R sine, cosine;  // |across| and the part along n, of no unit length
};
template <class R>
About<R> about(const Vec3<R>& n, std::initializer_list<Vec3<R>> vectors) {
    const R square = dot(n, n);
    Exact<R> product{};
    R parts[3];
    for (const Vec3<R>& w : vectors)
        product.add_product(w.x, n.x), product.add_product(w.y, n.y), product.add_product(w.z, n.z);
    const R share = product.value() / square;
    for (int k = 0; k < 3; ++k) {
        const auto component = [k](const Vec3<R>& v) { return k == 0 ? v.x : k == 1 ? v.y : v.z; };
        Exact<R> sum{};
        for (const Vec3<R>& w : vectors) sum.add(component(w));
        sum.add_product(-share, component(n));
        parts[k] = sum.value();
    }
    Vec3<R> across{parts[0], parts[1], parts[2]};
    const R rest = dot(across, n) / square;
    across = {std::fma(-rest, n.x, across.x), std::fma(-rest, n.y, across.y), std::fma(-rest, n.z, across.z)};
    return {across, hypotenuse(hypotenuse(across.x, across.y), across.z),
            product.value() / std::sqrt(square)};
}
// As a direction of the local frame whose azimuth does not matter.
template <class R>
Vec3<R> upright(const About<R>& w) {
    return {w.sine, R(0), w.cosine};
}

// m in the local frame whose x axis is the part of o across n.
template <class R>
Vec3<R> beside(const About<R>& o, const About<R>& m, const Vec3<R>& n) {
    if (!(o.sine > 0)) return upright(m);
    const Vec3<R> x = scaled<R>(o.across, 1 / o.sine), y = cross(normalised(n), x);
    return {dot(x, m.across), dot(y, m.across), m.cosine};
}

template <class N, class R>
R pdf_wm_world(const Vec3<R>& wo, const Vec3<R>& n, const Vec3<R>& wm, const R& alpha) {
    const About<R> o = about(n, {wo}), m = about(n, {wm});
    const R cosine = dot(wo, wm);
    const View<R> v = view(upright(o), alpha, alpha);
    if (!(m.cosine > 0 && cosine > 0) || nothing_visible(v)) return R(0);
    return cosine * N::template visible<R>(beside(o, m, n), v);
}

// A half vector that faces away from wo, as rounding alone makes it, counts as one across wo for Beckmann, whose exponents of D
// and sigma would otherwise add up.
template <class N, class R>
R pdf_wi_world(const Vec3<R>& wo, const Vec3<R>& n, const Vec3<R>& wi, const R& alpha) {
    const About<R> o = about(n, {wo}), m = about(n, {wo, wi});
    const View<R> v = view(upright(o), alpha, alpha);
    if (!(m.cosine > 0) || nothing_visible(v)) return R(0);
    Vec3<R> h = beside(o, m, n);
    const R length = hypotenuse(hypotenuse(h.x, h.y), h.z);
    if (std::is_same_v<N, Beckmann> && o.cosine < 0 && o.sine * h.x + o.cosine * h.z < 0)
        h.x = -o.cosine * h.z / o.sine;
    return N::template visible<R>(scaled<R>(h, 1 / length), v) / 4;
}

// --- Frames ---

// The image of x under the shortest turn from z to n, for n.z < 0 from -z: Rodrigues' formula.
template <class R>
Vec3<R> tangent(const Vec3<R>& normal) {
    const Vec3<R> n = normalised(normal), x{R(1), R(0), R(0)}, pole{R(0), R(0), n.z < 0 ? R(-1) : R(1)};
    const Vec3<R> axis = cross(pole, n);
    const R sine = hypotenuse(axis.x, axis.y);
    if (!(sine > 0)) return x;
    const Vec3<R> k = scaled<R>(axis, 1 / sine), kx = cross(k, x);
    const R angle = std::atan2(sine, std::abs(n.z)), s = std::sin(angle),
            versine = 2 * squared(R(std::sin(angle / 2)));
    const Vec3<R> across = cross(k, kx);
    return {x.x + s * kx.x + versine * across.x, x.y + s * kx.y + versine * across.y,
            x.z + s * kx.z + versine * across.z};
}
template <class R>
Vec3<R> tangent_along(const Vec3<R>& n, const Vec3<R>& w) {
    const About<R> a = about(n, {w});
    return a.sine > 0 ? scaled<R>(a.across, 1 / a.sine) : tangent(n);
}
// t . w; of vectors that are not quite unit or across each other (n x t) . (n x w), by Lagrange's identity.
template <class R>
Vec3<R> to_frame(const Vec3<R>& w, const Vec3<R>& n, const Vec3<R>& t) {
    return {dot(n, n) * dot(t, w) - dot(n, t) * dot(n, w), dot(cross(n, t), w), dot(n, w)};
}
template <class R>
Vec3<R> from_frame(const Vec3<R>& w, const Vec3<R>& n, const Vec3<R>& t) {
    const Vec3<R> b = cross(n, t);
    return {w.x * t.x + w.y * b.x + w.z * n.x, w.x * t.y + w.y * b.y + w.z * n.y,
            w.x * t.z + w.y * b.z + w.z * n.z};
}

}  // namespace vndf::reference
