// What is seen of regions of normals between arcs: spherical polygons of reflections, what is above two normals, and caps whose
// cone leaves the hemisphere of normals.
//
// v . V / pi of a region is the integral of D / 4 over its reflections, V = 1/2 the integral of m x dm along its boundary, here as
// the difference of antiderivatives along the rim of each arc's cone, in the axes of cap_maps.h. That this is the integral is
// tested by quadrature over directions (tests/support/cone_claims.cpp).
#pragma once

#include <vector>

#include "reference/tilted_maps.h"
#include "reference/world.h"

namespace vndf::reference {

// An arc of reflections from a to b through `middle`, on the rim of a cap; counter-clockwise about its axis.
template <class R>
struct Arc {
    Vec3<R> a, middle, b;
    Light<R> cap;
};

// v . V of an arc.
template <class R>
R arc_area(const Vec3<R>& wo, const R& alpha_x, const R& alpha_y, const Arc<R>& arc) {
    using std::asin, std::asinh, std::atan2, std::cos, std::sin, std::sqrt;
    LightView<R> view = light_view(wo, arc.cap, alpha_x, alpha_y);
    if (view.kappa < 0) {
        // -wo is in the cap: the rim of its complement, the other way round.
        const Arc<R> back{
            arc.b, arc.middle, arc.a, {scaled(arc.cap.l, R(-1)), 2 - arc.cap.one_minus_cos, R(1)}};
        return -arc_area(wo, alpha_x, alpha_y, back);
    }
    view.outside = true;
    const Cone<R> c = cap_cone(view);
    const R p = sqrt(c.p2), q = sqrt(c.q2), rim_p = sqrt(c.co_p2), rim_q = sqrt(c.co_q2);
    const auto turn = [&](const Vec3<R>& wi) {
        const Vec3<R> h{(wo.x + wi.x) / alpha_x, (wo.y + wi.y) / alpha_y, wo.z + wi.z};
        return R(atan2(dot(c.e2, h) / q, dot(c.e1, h) / p));
    };
    const R start = turn(arc.a);
    const auto from_start = [&](const Vec3<R>& wi) {
        const R by = turn(wi) - start;
        return by < 0 ? R(by + 2 * pi<R>()) : by;
    };
    // The way that passes the middle.
    R by = from_start(arc.b);
    if (by < from_start(arc.middle)) by = by - 2 * pi<R>();
    const R end = start + by, square = c.co_p2 - c.co_q2, k = square > 0 ? R(sqrt(square)) : R(0);
    R first, second;
    if (k > Real<R>(1e-7)) {
        const auto arc_sine = [&](const R& phi) {
            const R x = k * sin(phi) / rim_p;
            return R(asin(x > 1 ? R(1) : x < -1 ? R(-1) : x));
        };
        first = -q * c.co_p2 / k * (arc_sine(end) - arc_sine(start)) / 2;
        second = rim_q > 0
                     ? R(p * c.co_q2 / k * (asinh(k * cos(end) / rim_q) - asinh(k * cos(start) / rim_q)) / 2)
                     : R(0);
    } else {
        first = -q * rim_p * (sin(end) - sin(start)) / 2;
        second = p * rim_q * (cos(end) - cos(start)) / 2;
    }
    return view.length * (c.s0 * (p * q * by / 2) + c.s1 * first + c.s2 * second);
}

// The same of the horizon of normals, between the half vectors of a and b, less than half a turn.
template <class R>
R level_area(const Vec3<R>& wo, const R& alpha_x, const R& alpha_y, const Vec3<R>& a, const Vec3<R>& b) {
    using std::atan2;
    const R ax = (wo.x + a.x) / alpha_x, ay = (wo.y + a.y) / alpha_y, bx = (wo.x + b.x) / alpha_x,
            by = (wo.y + b.y) / alpha_y;
    return wo.z * atan2(R(ax * by - ay * bx), R(ax * bx + ay * by)) / 2;
}

template <class R>
R ggx_cap_mass(const Vec3<R>& wo, const Light<R>& cap, const R& alpha_x, const R& alpha_y) {
    using std::sqrt;
    const R all = Ggx::sigma(view(wo, alpha_x, alpha_y));
    if (light_view(wo, cap, alpha_x, alpha_y).kappa < 0) {
        const Light<R> rest{scaled(cap.l, R(-1)), 2 - cap.one_minus_cos, R(1)};
        return all - ggx_cap_mass(wo, rest, alpha_x, alpha_y);
    }
    // The points of the rim with the height -wo.z, below which normals are below the surface.
    const R across = hypotenuse(cap.l.x, cap.l.y), cosine = 1 - cap.one_minus_cos;
    const R along = (cosine + wo.z * cap.l.z) / across, square = wo.x * wo.x + wo.y * wo.y - along * along;
    if (across > 0 && square > 0) {
        const R off = sqrt(square), x = cap.l.x / across, y = cap.l.y / across;
        const Vec3<R> a{along * x - off * y, along * y + off * x, -wo.z},
            b{along * x + off * y, along * y - off * x, -wo.z};
        const R sine = sqrt(cap.one_minus_cos * (2 - cap.one_minus_cos));
        const Vec3<R> top{cosine * cap.l.x - sine * cap.l.z * x, cosine * cap.l.y - sine * cap.l.z * y,
                          cosine * cap.l.z + sine * across};
        return (arc_area(wo, alpha_x, alpha_y, Arc<R>{a, top, b, cap}) +
                level_area(wo, alpha_x, alpha_y, b, a)) /
               pi<R>();
    }
    return cap.l.z * cosine + wo.z > 0 ? ggx_sigma_cap(wo, {cap.l, cap.one_minus_cos, R(1)}, alpha_x, alpha_y)
                                       : R(0);
}

template <class R>
R ggx_sigma_tilted(const Vec3<R>& wo, const Vec3<R>& ng, const R& alpha_x, const R& alpha_y) {
    const R size = hypotenuse(ng.x, ng.y);
    if (!(wo.z > 0)) return ggx_cap_mass(wo, Light<R>{ng, R(1), R(1)}, alpha_x, alpha_y);
    if (!(size > 0)) return ng.z > 0 ? ggx_sigma_visible(view(wo, alpha_x, alpha_y)) : R(0);
    // The corners, and where each horizon is highest over the other.
    const R x = ng.x / size, y = ng.y / size;
    const Vec3<R> left{-y, x, R(0)}, right{y, -x, R(0)}, above_ng{x, y, R(0)},
        above_z{-ng.z * x, -ng.z * y, size}, z{R(0), R(0), R(1)};
    return (arc_area(wo, alpha_x, alpha_y, Arc<R>{right, above_ng, left, {z, R(1), R(1)}}) +
            arc_area(wo, alpha_x, alpha_y, Arc<R>{left, above_z, right, {ng, R(1), R(1)}})) /
           pi<R>();
}

// Of a polygon within half of the sphere, by unit vectors: cut off at the horizon, edge by edge.
template <class R>
R ggx_polygon_mass(const Vec3<R>& wo, const std::vector<Vec3<R>>& vertices, const R& alpha_x,
                   const R& alpha_y) {
    if (!(wo.z > 0)) return R(0);
    std::vector<Vec3<R>> above;
    for (std::size_t i = 0; i < vertices.size(); ++i) {
        const Vec3<R>&a = vertices[i], &b = vertices[(i + 1) % vertices.size()];
        if (a.z > 0) above.push_back(a);
        if ((a.z > 0) == (b.z > 0)) continue;
        const R side(a.z > 0 ? -1 : 1);
        above.push_back(
            normalised<R>({side * (b.z * a.x - a.z * b.x), side * (b.z * a.y - a.z * b.y), R(0)}));
    }
    R sum(0);
    for (std::size_t i = 0; i < above.size(); ++i) {
        const Vec3<R>&a = above[i], &b = above[(i + 1) % above.size()];
        const Vec3<R> k = cross(a, Vec3<R>{b.x - a.x, b.y - a.y, b.z - a.z});
        if (!(dot(k, k) > 0)) continue;
        const Vec3<R> middle = normalised<R>({a.x + b.x, a.y + b.y, a.z + b.z});
        sum += arc_area(wo, alpha_x, alpha_y, Arc<R>{a, middle, b, {normalised(k), R(1), R(1)}});
    }
    return std::abs(sum) / pi<R>();
}

}  // namespace vndf::reference
