// The reflections above the horizon, in the axes of their cone.
//
// A unit normal m of the stretched frame reflects wo above the horizon where
//     m^T Q m > 0,  Q = s z^T + z s^T - cos(theta) A^2,
// s the unit stretched wo: 2 (s . m) m_z > cos(theta) |A m|^2. The axes of Q are found by rotations (Jacobi), the steps
// of the map as the roots of the horizon's equation along straight lines. That the cone is the horizon, the map's density
// and its range are tested for themselves (reference_test.cpp, "conic: ...").
#pragma once

#include <utility>

#include "reference/ggx_maps.h"

namespace vndf::reference {

// Eigenvalues and eigenvectors (columns of v) of a symmetric matrix; rotations keep the digits of small rows.
template <class T>
struct Eigen {
    T value[3], v[3][3];
};
template <class T>
Eigen<T> jacobi(T (&a)[3][3]) {
    using std::abs, std::sqrt;
    Eigen<T> e{};
    for (int i = 0; i < 3; ++i) e.v[i][i] = 1;
    const auto rotate_pair = [&](int p, int q) {
        if (!(abs(a[p][q]) > 0)) return;
        const T theta = (a[q][q] - a[p][p]) / (2 * a[p][q]);
        const T t = (theta < 0 ? -1 : 1) / (abs(theta) + sqrt(theta * theta + 1));
        const T c = 1 / sqrt(t * t + 1), s = t * c;
        a[p][p] -= t * a[p][q], a[q][q] += t * a[p][q];
        a[p][q] = a[q][p] = 0;
        const int r = 3 - p - q;
        const T rp = a[r][p], rq = a[r][q];
        a[r][p] = a[p][r] = c * rp - s * rq;
        a[r][q] = a[q][r] = s * rp + c * rq;
        for (auto& row : e.v) {
            const T x = row[p], y = row[q];
            row[p] = c * x - s * y, row[q] = s * x + c * y;
        }
    };
    for (int sweep = 0; sweep < 12; ++sweep) {
        rotate_pair(0, 2);  // the plane of incidence first: the row across it is small throughout
        rotate_pair(0, 1);
        rotate_pair(1, 2);
    }
    for (int i = 0; i < 3; ++i) e.value[i] = a[i][i];
    return e;
}

// The eigenvalues mu > 0 > -mu2 >= -mu1, the axes e0, e1, e2 as vectors of (e, p, z), and s in them. e1 points towards
// s, where it is across s to the x axis, or to the y axis if that is nearer; e2 = e0 x e1.
template <class R>
struct Cone {
    R mu, mu1, mu2;
    Vec3<R> e0, e1, e2;
    R s0, s1, s2;
    R p2, q2, co_p2, co_q2;  // squares of the semi-axes, and 1 less them
};

// Q in the frame (e, p, z).
template <class R>
void cone_matrix(const View<R>& v, R (&q)[3][3]) {
    const R x2 = squared(v.alpha_x), y2 = squared(v.alpha_y);
    q[0][0] = -v.cos_theta * (x2 * squared(v.ex) + y2 * squared(v.ey));
    q[1][1] = -v.cos_theta * (x2 * squared(v.ey) + y2 * squared(v.ex));
    q[0][1] = q[1][0] = v.cos_theta * (x2 - y2) * v.ex * v.ey;
    q[0][2] = q[2][0] = v.sin_theta;
    q[1][2] = q[2][1] = R(0);
    q[2][2] = v.cos_theta;
}

// Rotations leave an eigenvalue the rounding errors of the largest one. The quotient of Rayleigh, m^T Q m / m^T m in the terms
// of the horizon's equation, has the square of the vector's error instead.
template <class R, class T>
T rayleigh(const View<R>& v, const T (&m)[3][3], int i) {
    const T e = m[0][i], p = m[1][i], z = m[2][i], cosine = value_of(v.cos_theta);
    const T x = value_of(v.alpha_x) * (e * value_of(v.ex) - p * value_of(v.ey)),
            y = value_of(v.alpha_y) * (e * value_of(v.ey) + p * value_of(v.ex));
    return (2 * (value_of(v.sin_theta) * e + cosine * z) * z - cosine * (x * x + y * y + z * z)) /
           (e * e + p * p + z * z);
}

template <class R>
Cone<R> cone(const View<R>& v) {
    using std::sqrt;
    using T = Real<R>;
    R q[3][3];
    cone_matrix(v, q);
    T a[3][3];
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) a[i][j] = value_of(q[i][j]);
    Eigen<T> eigen = jacobi(a);
    for (int i = 0; i < 3; ++i) eigen.value[i] = rayleigh(v, eigen.v, i);

    int order[3] = {2, 0, 1};  // of e0, e1, e2
    for (int i = 1; i < 3; ++i)
        if (eigen.value[order[i]] > eigen.value[order[0]]) std::swap(order[0], order[i]);
    if (eigen.value[order[1]] > eigen.value[order[2]]) std::swap(order[1], order[2]);
    T sign[3] = {1, 1, 1};
    const auto axis = [&](int i, int k) { return sign[i] * eigen.v[k][order[i]]; };
    if (axis(0, 2) < 0) sign[0] = -1;
    // Equal eigenvalues at normal incidence: x and y. Else the sign as above.
    // The last row of Q e = lambda e is s . e = lambda e_z.
    T towards = -axis(1, 2);
    const T x = axis(1, 0) * value_of(v.ex) - axis(1, 1) * value_of(v.ey),
            y = axis(1, 0) * value_of(v.ey) + axis(1, 1) * value_of(v.ex);
    if (!(std::abs(towards) > 0)) towards = std::abs(x) < std::abs(y) ? y : x;
    if (towards < 0) sign[1] = -1;
    const T handed = axis(0, 0) * (axis(1, 1) * axis(2, 2) - axis(1, 2) * axis(2, 1)) +
                     axis(0, 1) * (axis(1, 2) * axis(2, 0) - axis(1, 0) * axis(2, 2)) +
                     axis(0, 2) * (axis(1, 0) * axis(2, 1) - axis(1, 1) * axis(2, 0));
    if (handed < 0) sign[2] = -1;

    // First-order perturbation: d lambda_i = e_i dQ e_i, d e_i = sum over j of e_j (e_j dQ e_i) / (lambda_i - lambda_j).
    R lambda[3], e[3][3];
    for (int i = 0; i < 3; ++i) {
        lambda[i] = R(eigen.value[order[i]]);
        for (int k = 0; k < 3; ++k) e[i][k] = R(axis(i, k));
    }
    if constexpr (!std::is_same_v<R, T>) {
        for (int i = 0; i < 3; ++i)
            for (int j = 0; j < 3; ++j) {
                R d(0);
                for (int k = 0; k < 3; ++k)
                    for (int l = 0; l < 3; ++l) d = d + q[k][l] * (axis(i, k) * axis(j, l));
                const T gap = eigen.value[order[i]] - eigen.value[order[j]];
                for (std::size_t n = 0; n < d.partial.size(); ++n) {
                    if (i == j) lambda[i].partial[n] = d.partial[n];
                    if (i == j || !(std::abs(d.partial[n]) > 0)) continue;
                    for (int k = 0; k < 3; ++k) e[i][k].partial[n] += axis(j, k) * d.partial[n] / gap;
                }
            }
    }
    Cone<R> c;
    c.mu = lambda[0], c.mu1 = -lambda[1], c.mu2 = -lambda[2];
    c.e0 = {e[0][0], e[0][1], e[0][2]}, c.e1 = {e[1][0], e[1][1], e[1][2]},
    c.e2 = {e[2][0], e[2][1], e[2][2]};
    c.s0 = c.mu * c.e0.z, c.s1 = -c.mu1 * c.e1.z, c.s2 = -c.mu2 * c.e2.z;
    c.p2 = c.mu / (c.mu + c.mu1), c.co_p2 = c.mu1 / (c.mu + c.mu1);
    c.q2 = c.mu / (c.mu + c.mu2), c.co_q2 = c.mu2 / (c.mu + c.mu2);
    if (c.co_q2 < 0) c.co_q2 = R(0);
    return c;
}

// The projected area of the region inside the cone: that of an ellipse across e0, seen from s. (Its parts from s1 and s2
// are odd.) Divided by pi.
template <class R>
R cone_area(const Cone<R>& c) {
    using std::sqrt;
    return sqrt(c.p2) * sqrt(c.q2) * c.s0;
}
template <class R>
R ggx_sigma_visible(const View<R>& v) {
    return v.length * cone_area(cone(v));
}

// The line P + epsilon s' to the rim and P2 + tau s to the sphere; s', unit, is (c0, 0, c2).
template <class R>
struct Lines {
    R n, c0, c2, root_p, root_q, rho;
};
template <class R>
Lines<R> lines(const Cone<R>& c) {
    using std::sqrt;
    const R n = hypotenuse(c.s0, c.s2);
    return {n, c.s0 / n, c.s2 / n, sqrt(c.p2), sqrt(c.q2), (c.mu1 - c.mu2) / (c.mu + c.mu1)};
}

// The positive root x of a x^2 + 2 b x = c, c >= 0, a > 0.
template <class R>
R line_root(const R& a, const R& b, const R& c) {
    using std::abs, std::sqrt;
    using T = Real<R>;
    if (!(c > 0)) return b < 0 ? R(-2 * b / a) : R(0);
    const auto f = [](auto x, auto a, auto b, auto c) { return (decltype(a)(x) * a + 2 * b) * x - c; };
    const auto df = [](T x, T a, T b, T) { return 2 * (a * x + b); };
    const T reach = std::sqrt(value_of(c) / value_of(a));
    const T high = value_of(b) > 0 ? std::min(reach, value_of(c) / (2 * value_of(b)))
                                   : reach - 2 * value_of(b) / value_of(a);
    return solve<R>(f, df, T(0), high * (1 + 4 * std::numeric_limits<T>::epsilon()), a, b, c);
}

// u1 -> azimuth, u2 -> squared radius of the disk point (X, Y), and P = (M, p Y, q X) of the chord m1 = p Y between two
// rim points. P2 = P + epsilon s' has the cone coordinates of a rim point; m = P2 + tau s lies on the sphere.
template <class R>
StretchedNormal<R> conic_normal(const Cone<R>& c, const Arguments<R>& in) {
    using std::cos, std::sin, std::sqrt;
    const Lines<R> l = lines(c);
    const R phi = 2 * pi<R>() * in.u1, radius = sqrt(in.u2), x = radius * cos(phi), y = radius * sin(phi);
    const R px = l.root_q * x, py = l.root_p * y;
    const R rim = sqrt(R(c.co_p2 * squared(y) + c.co_q2 * (in.v2 + squared(x))));
    // mu m0^2 - mu1 (1 - m0^2 - m2^2) - mu2 m2^2 along the line, over mu + mu1.
    const R a = squared(l.c0) + l.rho * squared(l.c2), b = l.c0 * rim + l.rho * l.c2 * px;
    const R epsilon = line_root<R>(a, b, R(l.rho * c.q2 * in.v2));
    // |P2 + tau s| = 1, where 1 - |P2|^2 is the part of p^2 that the rim point leaves over y^2.
    const R rim2 = rim + l.c0 * epsilon, m2 = px + l.c2 * epsilon;
    const R part = l.rho * c.q2, over = part > 0 ? R(l.c0 * epsilon / part * (rim + rim2)) : in.v2;
    R along = c.s0 * rim2 + c.s2 * m2 + c.s1 * py;
    if (along < 0) along = R(0);
    const R tau = line_root<R>(R(Real<R>(1)), along, R(c.p2 * over));
    const R m0 = rim2 + tau * c.s0, m1 = py + tau * c.s1, m = m2 + tau * c.s2;
    return {m0 * c.e0.x + m1 * c.e1.x + m * c.e2.x, m0 * c.e0.y + m1 * c.e1.y + m * c.e2.y,
            m0 * c.e0.z + m1 * c.e1.z + m * c.e2.z, along + tau};
}

template <class R>
Sample<R> ggx_conic2026(const Arguments<R>& in) {
    using std::sin;
    const View<R> v = view(in);
    if (nothing_visible(v)) return undefined<R>(reflect<R>(in.wo, {v.ex, v.ey, R(0)}));
    if (!(v.up > 0)) {
        const StretchedNormal<R> m =
            half_vector<R>(v, whole_cap(v), 2 * pi<R>() * (in.u1 - Real<R>(0.5)), in.u2, in.v2);
        return ggx_reflected<R>(in, v, m, squared(R(sin(v.nu / 2))) * v.length);
    }
    const Cone<R> c = cone(v);
    return ggx_reflected<R>(in, v, conic_normal(c, in), v.length * cone_area(c));
}

// The same steps backwards from the half vector; behind the surface those of the cap.
template <class R>
struct DiskPoint {
    R u1, u2;
};
template <class R>
R turn_of(const R& x, const R& y) {
    using std::atan2;
    if (value_of(hypotenuse(x, y)) == 0) return R(0);  // whatever the signs of the zeros
    const R turn = atan2(y, x) / (2 * pi<R>());
    return turn < 0 ? R(turn + 1) : turn;
}
// The moves backwards from a normal of the frame of the cone's axes; cosine = s . m, form = m^T Q m.
template <class R>
DiskPoint<R> disk_point(const Cone<R>& c, const Vec3<R>& m, const R& cosine, const R& form) {
    using std::sqrt;
    const Lines<R> l = lines(c);
    const R m0 = dot(c.e0, m), m1 = dot(c.e1, m), m2 = dot(c.e2, m), height = form / (c.mu + c.mu1);
    const R a = squared(l.c0) + l.rho * squared(l.c2), b = l.c0 * m0 + l.rho * l.c2 * m2;
    const R square = b * b - a * height, root = square > 0 ? R(sqrt(square)) : R(0);
    const R delta = b + root > 0 ? R(height / (b + root)) : R(0), tau = delta / l.n;
    const R rim2 = m0 - l.c0 * delta, x2 = m2 - l.c2 * delta, y = (m1 - c.s1 * tau) / l.root_p;
    const R inside = 1 - y * y;
    const R rim = sqrt(R(c.co_p2 * y * y + c.co_q2 * (inside > 0 ? inside : R(0))));
    const R over = tau * (2 * cosine - tau) / c.p2;
    const R part = rim + rim2 > 0 ? R(over / (l.c0 * (rim + rim2))) : R(0);
    const R x = (x2 - l.c2 * l.rho * c.q2 * part) / l.root_q;
    const R square_radius = x * x + y * y;
    const R rest = part * (l.rho * l.c2 * l.root_q * x + l.c0 * rim + root);
    return {turn_of(x, y), square_radius > Real<R>(0.5) ? R(1 - rest) : square_radius};
}

template <class R>
DiskPoint<R> ggx_invert_conic2026(const Vec3<R>& wo, const Vec3<R>& wi, const View<R>& v) {
    const Vec3<R> h{wo.x + wi.x, wo.y + wi.y, wo.z + wi.z};
    const R gx = h.x / v.alpha_x, gy = h.y / v.alpha_y;
    const R length = hypotenuse(hypotenuse(gx, gy), h.z);
    if (!(length > 0)) return {R(0), R(0)};
    const R ge = (gx * v.ex + gy * v.ey) / length, gp = (gy * v.ex - gx * v.ey) / length, gz = h.z / length;
    const R h2 = dot(h, h), cosine = h2 / (2 * length * v.length);
    if (!(v.up > 0)) {
        const R ox = 2 * cosine * (ge * v.ex - gp * v.ey) - v.sin_theta * v.ex,
                oy = 2 * cosine * (ge * v.ey + gp * v.ex) - v.sin_theta * v.ey;
        using std::sin;
        return {turn_of(ox, oy), 1 - cosine * gz / squared(R(sin(v.nu / 2)))};
    }
    // m^T Q m = wi.z |A m|^2 / length
    const R up = wi.z > 0 ? wi.z : R(0);
    return disk_point<R>(cone(v), {ge, gp, gz}, cosine, up * h2 / (length * length * v.length));
}

}  // namespace vndf::reference
