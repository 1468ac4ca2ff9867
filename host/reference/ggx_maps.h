// The GGX samplers: (u1, u2) -> direction, each the inverse of integrals of its density (stretched.h), in the roles
// that its paper gives to u1 and u2. The direction comes with its density.
#pragma once

#include "reference/sample.h"

namespace vndf::reference {

// A unit normal of the stretched frame, as a sum over e, p and z, and its cosine with the stretched wo.
template <class R>
struct StretchedNormal {
    R e, p, z, cosine;
};

// Unstretching m -> A m / |A m|, A = diag(alpha_x, alpha_y, 1), changes solid angles by det A / |A m|^3.
template <class R>
Sample<R> ggx_unstretch(const View<R>& v, const StretchedNormal<R>& m) {
    using std::sin;
    const Vec3<R> g{v.alpha_x * (m.e * v.ex - m.p * v.ey), v.alpha_y * (m.e * v.ey + m.p * v.ex), m.z};
    const R length = hypotenuse(hypotenuse(g.x, g.y), g.z);
    const R sigma = squared(R(sin(v.nu / 2)));  // (1 + cos theta) / 2
    const R pdf = m.cosine / (pi<R>() * sigma) * (length / v.alpha_x) * (length / v.alpha_y) * length;
    return {{g.x / length, g.y / length, g.z / length}, pdf};
}

// The normal of given t and beta.
template <class R>
StretchedNormal<R> ggx_normal(const R& t, const R& root, const Beta<R>& b) {
    using std::cos, std::sin;
    return {root * cos(b.beta), t, root * sin(b.beta), root * b.facing};
}

template <class R>
Sample<R> ggx_horizontal(const View<R>& v) {
    return undefined<R>({v.ex, v.ey, R(0)});
}

// u1 -> beta (that is the slope x = -cot(beta)), u2 -> the slope y across, whose sign is that of -t.
template <class R>
Sample<R> ggx_heitz_deon2014_exact(const Arguments<R>& in) {
    const View<R> v = view(in);
    if (nothing_visible(v)) return ggx_horizontal(v);
    const Beta<R> b = ggx_beta<R>(in.u1, in.v1, v.theta, v.nu);
    const Semicircle<R> s = semicircle<R>(in.v2, in.u2);
    return ggx_unstretch(v, ggx_normal(s.t, s.root, b));
}

// z(U) of the published rational fit to the positive half of the inverse of C_z, and dz/dU. Near U = 1 its
// denominator nearly vanishes, so there it is expanded about that end.
template <class R>
void published_fit(const R& u, const R& v, R& z, R& dz) {
    const bool low = u < v;
    const R& x = low ? u : v;
    using T = Real<R>;
    const auto c = [](double numerator, double denominator) { return T(numerator) / T(denominator); };
    const T n0 = low ? T(0) : c(357, 1e5), n1 = low ? c(46341, 1e5) : c(18242, 1e5),
            n2 = low ? c(-73369, 1e5) : c(8786, 1e5), n3 = low ? c(27385, 1e5) : c(-27385, 1e5);
    const T d0 = low ? c(597999, 1e6) : c(492, 1e6), d1 = low ? T(-1) : c(101941, 1e6),
            d2 = low ? c(309420, 1e6) : c(588639, 1e6), d3 = low ? c(93073, 1e6) : c(-93073, 1e6);
    const R n = n0 + x * (n1 + x * (n2 + x * n3)), d = d0 + x * (d1 + x * (d2 + x * d3));
    const R dn = n1 + x * (2 * n2 + x * (3 * n3)), dd = d1 + x * (2 * d2 + x * (3 * d3));
    z = n / d;
    dz = (dn - z * dd) / d * (low ? T(1) : T(-1));
}

// The same with the fit in place of the conditional inverse: its density differs by the ratio of the density
// of z under the fit, 1 / (2 dz/dU), to (2 / pi) / (1 + z^2)^2.
template <class R>
Sample<R> ggx_heitz_deon2014(const Arguments<R>& in) {
    using std::sqrt;
    const View<R> v = view(in);
    if (v.up < 0) return undefined<R>({R(0), R(0), R(1)});
    const Beta<R> b = ggx_beta<R>(in.u1, in.v1, v.theta, v.nu);
    const bool positive = in.u2 > Real<R>(0.5);
    const R less = positive ? in.v2 : in.u2;  // 1 - U = 2 less
    R z, dz;
    published_fit<R>(1 - 2 * less, 2 * less, z, dz);
    const R square = 1 + z * z, root = 1 / sqrt(square), t = z * root;
    Sample<R> sample = ggx_unstretch(v, ggx_normal(positive ? R(-t) : t, root, b));
    sample.pdf = sample.pdf * pi<R>() * square * square / (4 * dz);
    return sample;
}

// A point (t, s) of the plane across wo, t along p, with the part F of the slice at t below it.
template <class R>
Sample<R> ggx_from_slice(const View<R>& v, const R& t, const R& root, const R& f, const R& rest) {
    return ggx_unstretch(v, ggx_normal(t, root, ggx_beta<R>(f, rest, v.theta, v.nu)));
}

// 1 - |s| / root of a point (t, s) of the unit disk with root^2 = 1 - t^2 and rest = 1 - t^2 - s^2.
template <class R>
R slice_rest(const R& s, const R& root, const R& rest) {
    using std::abs;
    return rest / (root * (root + abs(s)));
}

// u1 -> azimuth, u2 -> squared radius of a disk, whose slices across p are moved and scaled to the visible
// ones. At normal incidence w1 = x: e = -y.
template <class R>
Sample<R> ggx_heitz2018(const Arguments<R>& in) {
    using std::cos, std::sin, std::sqrt;
    View<R> v = view(in.wo, in.alpha_x, in.alpha_y);
    if (!(v.across > 0)) v.ex = R(0), v.ey = R(-1);
    rotate(v, in.rotation);
    if (nothing_visible(v)) return ggx_horizontal(v);
    const R phi = 2 * pi<R>() * in.u1, radius = sqrt(in.u2);
    const R t = radius * cos(phi), s = radius * sin(phi), root = sqrt(in.v2 + s * s);
    const R less = slice_rest<R>(s, root, in.v2) / 2;
    return s < 0 ? ggx_from_slice<R>(v, t, root, less, 1 - less)
                 : ggx_from_slice<R>(v, t, root, 1 - less, less);
}

// u1 -> squared radius, u2 -> angle over two half disks: the one across wo, of area pi / 2, above, and the
// shadow of the one in the tangent plane, of area cos(theta) pi / 2, below. T1 = -p; at normal incidence T1 =
// x: e = y.
template <class R>
Sample<R> ggx_heitz2017(const Arguments<R>& in) {
    using std::cos, std::sin, std::sqrt;
    View<R> v = view(in.wo, in.alpha_x, in.alpha_y);
    if (!(v.across > 0)) v.ex = R(0), v.ey = R(1);
    rotate(v, in.rotation);
    if (v.up < 0) return undefined<R>({R(0), R(0), R(1)});
    const R both = 1 + v.cos_theta, radius = sqrt(in.u1);
    const bool upper = in.u2 * both < 1;
    // The angle from T1, counted backwards in the lower half.
    const R angle = pi<R>() * both * (upper ? in.u2 : R(in.v2 / v.cos_theta));
    const R t = -radius * cos(angle), s = radius * sin(angle), root = sqrt(in.v1 + s * s);
    const R less = slice_rest<R>(s, root, in.v1);
    const R above = upper ? R(less / both) : R(1 - v.cos_theta * less / both);
    const R below = (upper ? R(v.cos_theta + s / root) : R(v.cos_theta * less)) / both;
    return ggx_from_slice<R>(v, t, root, below, above);
}

// The cap of stretched reflections: directions within 2 half of z; co_half = pi / 2 - half, gap = nu / 2 -
// half.
template <class R>
struct Cap {
    R half, co_half, gap;
};
template <class R>
Cap<R> whole_cap(const View<R>& v) {
    return {v.nu / 2, v.theta / 2, R(0)};
}

// The bound of Eto & Tokuyoshi: only reflections with o_z > -k cos(theta), where k = (1 - a^2) s^2 /
// (s^2 + a^2 z^2) with s = 1 + sqrt(1 - z^2) of the unit wo. gap: 1 - k; up: 1 + k cos(theta).
template <class R>
struct Bound {
    R k, gap, up;
};
template <class R>
Bound<R> bound(const View<R>& v, const Vec3<R>& wo) {
    R a = v.alpha_x < v.alpha_y ? v.alpha_x : v.alpha_y;
    if (a > 1) a = R(1);
    const R sine = hypotenuse(wo.x, wo.y);
    const R s2 = squared(R(1 + sine)), a2 = a * a, z2 = squared(wo.z), below = s2 + a2 * z2;
    const R k = (1 - a) * (1 + a) * s2 / below;
    return {k, a2 * (s2 + z2) / below, 1 + k * v.cos_theta};
}

// The polygon bound: 1 - k = 1 / R, R the largest (X / alpha_x^2 + Y / alpha_y^2 + z^2) / (X + Y + z^2) over the
// squares X, Y >= 0 with (1 - sin)^2 <= X + Y <= (1 + sin)^2 and Y <= (1 + |wo.y|)^2, y the axis of the smaller alpha: a
// quotient of linear functions is largest at a vertex. With N the numerator,
// 1 + k cos(theta) = ((X / alpha_x^2 + Y / alpha_y^2)(1 + cos) + (z^2 - X - Y) + (1 - cos)(X + Y)) / N.
template <class R>
Bound<R> polygon_bound(const View<R>& v, const Vec3<R>& view) {
    using std::abs, std::sin;
    const Vec3<R> wo = normalised(view);
    const bool swap = v.alpha_x < v.alpha_y;
    const R &low = swap ? v.alpha_x : v.alpha_y, &high = swap ? v.alpha_y : v.alpha_x;
    const R y = abs(swap ? wo.x : wo.y), sine = hypotenuse(wo.x, wo.y), z2 = squared(wo.z);
    const R less = z2 / (1 + sine);  // 1 - sin
    const R least = squared(less), most = squared(R(1 + sine)), side = squared(R(1 + y));
    const R up = 2 * squared(R(sin(v.nu / 2))), down = 2 * squared(R(sin(v.theta / 2)));
    const R flat = 2 * sine;  // z^2 - least = flat (1 - sin), z^2 - most = -flat (1 + sin)
    struct Vertex {
        R x, y, above;  // above: z^2 - x - y
    };
    const Vertex vertices[] = {{R(0), least, flat * less},
                               {least, R(0), flat * less},
                               {most, R(0), -flat * (1 + sine)},
                               {most - side, side, -flat * (1 + sine)},
                               {R(0), side, z2 - side}};
    Bound<R> best{R(1), R(0), R(0)};
    bool first = true;
    for (const Vertex& w : vertices) {
        if (w.x < 0) continue;
        const R scaled = w.x * squared(R(low / high)) + w.y, numerator = scaled + low * low * z2;
        const R gap = low * low * (w.x + w.y + z2) / numerator;
        if (!first && !(gap < best.gap)) continue;
        best = {1 - gap, gap, (scaled * up + low * low * (w.above + down * (w.x + w.y))) / numerator};
        first = false;
    }
    return best;
}

template <class R>
Cap<R> bounded_cap(const View<R>& v, const Bound<R>& b) {
    using std::atan2, std::sin, std::sqrt;
    // tan^2(half) = (1 + k c) / (1 - k c); the directions at height -c and -k c differ by the angle 2 gap.
    const R one_minus_c = 2 * squared(R(sin(v.theta / 2)));
    const R &up = b.up, down = b.gap + b.k * one_minus_c;
    const R half = atan2(R(sqrt(up)), R(sqrt(down))), co_half = atan2(R(sqrt(down)), R(sqrt(up)));
    // cos(theta) - k cos(theta) = 2 sin(co_half + theta / 2) sin(gap)
    const R sin_gap = b.gap * v.cos_theta / (2 * sin(co_half + v.theta / 2));
    return {half, co_half, atan2(sin_gap, R(sqrt(1 - sin_gap * sin_gap)))};
}

// The half vector of the stretched wo and a direction uniform on the cap: `turn` is its azimuth less pi, u2 the
// part of the cap's area nearer to z. The direction's part across z is split along e, and the sums are taken as
// products of sines, so that nothing cancels where the azimuths are opposite and the polar angles equal.
template <class R>
StretchedNormal<R> half_vector(const View<R>& v, const Cap<R>& cap, const R& turn, const R& u2, const R& v2) {
    using std::atan2, std::cos, std::sin;
    const CapAngle<R> polar = cap_angle<R>(u2, v2, cap.half, cap.co_half);
    // The polar angles 2 x and theta = pi - nu; their sum is pi - 2 left.
    const R co_x = polar.rest + cap.co_half, left = polar.rest + cap.gap;
    const bool steep = polar.x < co_x;
    const R across = sin(2 * (steep ? polar.x : co_x));
    const R between = steep ? R(polar.x + v.nu / 2) : R(co_x + v.theta / 2);
    const R cos_between = steep ? R(cos(between)) : R(-cos(between));
    // sin(theta) - across cos(w) and cos(theta) + cos(2 x)
    const R w = turn - atan2(v.ey, v.ex);
    const R he = 2 * across * squared(R(sin(w / 2))) + 2 * cos_between * sin(left);
    const R hp = -across * sin(w), hz = 2 * sin(left) * sin(between);
    const R length = hypotenuse(hypotenuse(he, hp), hz);
    return {he / length, hp / length, hz / length, length / 2};
}

// u1 -> azimuth about z, u2 -> height on the cap.
template <class R>
Sample<R> ggx_dupuy2023(const Arguments<R>& in) {
    const View<R> v = view(in);
    if (nothing_visible(v)) return ggx_horizontal(v);
    return ggx_unstretch(v,
                         half_vector<R>(v, whole_cap(v), 2 * pi<R>() * (in.u1 - Real<R>(0.5)), in.u2, in.v2));
}

template <class R>
Vec3<R> reflect(const Vec3<R>& wo, const Vec3<R>& wm) {
    const R twice = 2 * dot(wo, wm);
    return {twice * wm.x - wo.x, twice * wm.y - wo.y, twice * wm.z - wo.z};
}

// The reflection of wo about the unstretched m, given sigma of the normals that are sampled. The density of stretched
// reflections is (s . m) / sigma up to a constant; it picks up |A m|^3 / det A of unstretching and 1 / (4 wo . wm) of the
// reflection, wo . wm = |stretched wo| (s . m) / |A m|.
template <class R>
Sample<R> ggx_reflected(const Arguments<R>& in, const View<R>& v, const StretchedNormal<R>& m,
                        const R& sigma) {
    const R gx = m.e * v.ex - m.p * v.ey, gy = m.e * v.ey + m.p * v.ex;
    const R x = v.alpha_x * gx, y = v.alpha_y * gy, length = hypotenuse(hypotenuse(x, y), m.z);
    const R length2 = squared(x) + squared(y) + squared(m.z);
    return {reflect<R>(in.wo, {x / length, y / length, m.z / length}),
            length2 / v.alpha_x * (length2 / v.alpha_y) / (4 * pi<R>() * sigma)};
}

// The cap under a bound (the whole one behind the surface), reflected.
template <class R, Bound<R> (*bound)(const View<R>&, const Vec3<R>&)>
Sample<R> ggx_bounded(const Arguments<R>& in) {
    using std::sin;
    const View<R> v = view(in);
    if (nothing_visible(v)) return undefined<R>(reflect<R>(in.wo, {v.ex, v.ey, R(0)}));
    const Cap<R> cap = v.up > 0 ? bounded_cap(v, bound(v, in.wo)) : whole_cap(v);
    const StretchedNormal<R> m = half_vector<R>(v, cap, 2 * pi<R>() * (in.u1 - Real<R>(0.5)), in.u2, in.v2);
    return ggx_reflected<R>(in, v, m, squared(R(sin(cap.half))) * v.length);
}
template <class R>
Sample<R> ggx_eto2023(const Arguments<R>& in) {
    return ggx_bounded<R, bound<R>>(in);
}
template <class R>
Sample<R> ggx_eto2023_polygon(const Arguments<R>& in) {
    return ggx_bounded<R, polygon_bound<R>>(in);
}

// The frame (t1, t2, n) in which the world-space listing works: z and n mirrored onto each other. t1 and t2
// are the images of x and y, with the reference axis that n is not opposite to, so that every n is fine.
// Right-handed for n.z >= 0, left-handed below, where the listing reflects about n - z instead.
template <class R>
struct Frame {
    Vec3<R> t1, t2, n;
};
template <class R>
Frame<R> frame(const Vec3<R>& n) {
    const bool below = n.z < 0;
    const R s = 1 / (1 + (below ? R(-n.z) : n.z)), off = -n.x * n.y * s;
    return {
        {1 - n.x * n.x * s, off, below ? n.x : R(-n.x)}, {off, 1 - n.y * n.y * s, below ? n.y : R(-n.y)}, n};
}
template <class R>
Vec3<R> to_local(const Frame<R>& f, const Vec3<R>& v) {
    return {dot(f.t1, v), dot(f.t2, v), dot(f.n, v)};
}
template <class R>
Vec3<R> to_world(const Frame<R>& f, const Vec3<R>& v) {
    return {f.t1.x * v.x + f.t2.x * v.y + f.n.x * v.z, f.t1.y * v.x + f.t2.y * v.y + f.n.y * v.z,
            f.t1.z * v.x + f.t2.z * v.y + f.n.z * v.z};
}

// The cap in that frame, its azimuth counted from -t1: phi = 2 pi u1 - pi. (The listing mirrors the
// tangential part of wo and of the result; for n = z both cancel.)
template <class R>
Sample<R> ggx_benyoub2024(const Arguments<R>& in) {
    const Frame<R> f = frame(in.n);
    View<R> v = view(to_local(f, in.wo), in.alpha_x, in.alpha_x);
    rotate(v, in.rotation);
    if (nothing_visible(v)) return undefined<R>(to_world<R>(f, {v.ex, v.ey, R(0)}));
    const R turn = 2 * pi<R>() * (in.u1 < in.v1 ? in.u1 : R(-in.v1));
    Sample<R> sample = ggx_unstretch(v, half_vector<R>(v, whole_cap(v), turn, in.u2, in.v2));
    sample.direction = to_world(f, sample.direction);
    return sample;
}

// u1 -> slope length: of the slopes 1 / (pi (1 + r^2)^2) at alpha = 1 the part r^2 / (1 + r^2) is shorter
// than r; u2 -> azimuth before unstretching.
template <class R>
Sample<R> ggx_walter2007(const Arguments<R>& in) {
    using std::cos, std::sin, std::sqrt;
    const R phi = 2 * pi<R>() * in.u2, sine = sqrt(in.u1), cosine = sqrt(in.v1);
    View<R> up;  // normal incidence
    up.alpha_x = in.alpha_x, up.alpha_y = in.alpha_y, up.ex = R(1), up.ey = R(0), up.nu = R(pi<R>());
    return ggx_unstretch(up, {sine * cos(phi), sine * sin(phi), cosine, cosine});
}

}  // namespace vndf::reference
