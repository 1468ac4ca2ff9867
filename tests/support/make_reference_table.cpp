// Writes tests/data/reference_50digits.csv: values of every registered function in 80-digit arithmetic, by a
// formulation of its own. It shares no code with host/reference nor kernels/.
//
//   g++ -std=c++20 -O2 tests/support/make_reference_table.cpp -o make_reference_table
//   ./make_reference_table > tests/data/reference_50digits.csv          (some ten minutes)
// (with the argument samplers, terms, conic, materials, frames, cones or tilts: that part alone)
//
// Everything starts from the distributions of slopes
//   GGX 1 / (pi (1 + x^2 + y^2)^2),  Beckmann exp(-x^2 - y^2) / pi  (alpha = 1),
// and is integrated by tanh-sinh quadrature and inverted by Newton steps whose residual is checked. Where a
// sampler is defined by its listing (2017, 2018, 2014 Beckmann, world space) the listing itself is evaluated,
// with the errata of the papers mended; 80 digits bear its cancellation.
//
// Columns: function (a sampler in its _with_pdf form), precision (whose clamps hold), condition, inputs (hex, exact),
// outputs (50 digits, of which at least 30 hold). condition: sum |x_j| |df/dx_j| over the inputs, for values divided by |f|, by differences;
// pdf_condition: the same of the density, relative to it.
#include <boost/math/constants/constants.hpp>
#include <boost/math/quadrature/tanh_sinh.hpp>
#include <boost/math/special_functions/erf.hpp>
#include <boost/multiprecision/cpp_bin_float.hpp>
#include <cmath>
#include <cstdio>
#include <functional>
#include <iostream>
#include <map>
#include <stdexcept>
#include <string>
#include <vector>

namespace {

using Real =
    boost::multiprecision::number<boost::multiprecision::cpp_bin_float<80>, boost::multiprecision::et_off>;
using Reals = std::vector<Real>;

const Real pi = boost::math::constants::pi<Real>();
const Real root_pi = sqrt(pi);

struct Vec {
    Real x, y, z;
};
Vec operator+(const Vec& a, const Vec& b) {
    return {a.x + b.x, a.y + b.y, a.z + b.z};
}
Vec operator-(const Vec& a, const Vec& b) {
    return {a.x - b.x, a.y - b.y, a.z - b.z};
}
Vec operator*(const Real& s, const Vec& a) {
    return {s * a.x, s * a.y, s * a.z};
}
Real dot(const Vec& a, const Vec& b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}
Vec cross(const Vec& a, const Vec& b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
Real norm(const Vec& a) {
    return sqrt(dot(a, a));
}
Vec unit(const Vec& a) {
    return (1 / norm(a)) * a;
}
Vec reflect(const Vec& i, const Vec& m) {
    return 2 * dot(i, m) * m - i;
}

// --- Quadrature and inversion ---

// Neighbours of a point, for its condition number, need fewer digits, and start from the roots found there.
struct Effort {
    Real quadrature = Real(1e-50), residual = Real(1e-47);
    Reals roots;
    std::size_t next = 0;
    bool again = false;
} effort;

Real integrate(const std::function<Real(Real)>& f, const Real& a, const Real& b) {
    static boost::math::quadrature::tanh_sinh<Real> rule(12);
    if (!(a < b)) return 0;
    // On [0, 1], so that a narrow range far from 0 costs nothing.
    const Real width = b - a;
    return width * rule.integrate([&](const Real& t) { return f(a + width * t); }, Real(0), Real(1),
                                  effort.quadrature);
}

// By Simpson sums in double.
Real rough_root(const std::function<Real(Real)>& density, const Real& lo, const Real& hi, const Real& u,
                const Real& total) {
    constexpr int n = 2048;
    std::vector<double> sum{0};
    const auto at = [&](double t) {
        return static_cast<double>(density(lo + (hi - lo) * Real(t)) / total * (hi - lo));
    };
    // Denser towards both ends: t = s^3 (10 - 15 s + 6 s^2).
    const auto grade = [](double s) { return s * s * s * (10 - 15 * s + 6 * s * s); };
    const auto slope = [](double s) { return 30 * s * s * (1 - s) * (1 - s); };
    for (int i = 0; i < n; ++i) {
        double panel = 0;
        for (const auto& [offset, w] : {std::pair{0., 1.}, {.5, 4.}, {1., 1.}}) {
            const double s = (i + offset) / n;
            panel += w * at(grade(s)) * slope(s);
        }
        sum.push_back(sum.back() + panel / (6 * n));
    }
    int i = 0;
    while (i + 1 < n && sum[i + 1] < static_cast<double>(u) * sum.back()) ++i;
    const double part =
        (static_cast<double>(u) * sum.back() - sum[i]) / std::max(1e-300, sum[i + 1] - sum[i]);
    return lo + (hi - lo) * Real(grade(std::min(1 - 1e-12, std::max(1e-12, (i + part) / n))));
}

// x in [lo, hi] with the integral of `density` from lo to x equal to u times that over the range.
Real invert(const std::function<Real(Real)>& density, const Real& lo, const Real& hi, const Real& u) {
    const Real total = integrate(density, lo, hi), target = u * total;
    Real x = effort.again ? effort.roots[effort.next++] : rough_root(density, lo, hi, u, total);
    Real below = lo, above = hi;
    for (int step = 0; step < 200; ++step) {
        const Real residual = integrate(density, lo, x) - target;
        (residual < 0 ? below : above) = x;
        if (abs(residual) < effort.residual * target) {
            if (!effort.again) effort.roots.push_back(x);
            return x;
        }
        Real next = x - residual / density(x);
        if (!(next > below && next < above)) next = (below + above) / 2;
        x = next;
    }
    throw std::runtime_error("no convergence");
}

// --- Distributions ---

enum class Ndf { ggx, beckmann };

Real p22(Ndf ndf, const Real& x, const Real& y) {
    const Real square = x * x + y * y;
    return ndf == Ndf::ggx ? Real(1 / (pi * (1 + square) * (1 + square))) : Real(exp(-square) / pi);
}

// D(m) = P22(slopes) / cos^4, stretched.
Real d(Ndf ndf, const Vec& m, const Real& ax, const Real& ay) {
    if (m.z <= 0) return 0;
    return p22(ndf, m.x / m.z / ax, m.y / m.z / ay) / (ax * ay * m.z * m.z * m.z * m.z);
}

// The slope along the projection of w has the marginal density P2 of P22; with l = |(ax w.x, ay w.y)|,
// sigma = integral of (w.z - l s) P2(s) over s < w.z / l.
// GGX, s = tan(psi), P2 ds = cos(psi) / 2 dpsi; Beckmann, P2 = exp(-s^2) / sqrt(pi), s = a - v.
struct Marginal {
    Real l, z, lo, hi;
    std::function<Real(Real)>
        density;  // in psi (GGX) or -v (Beckmann), ascending with the slope; unnormalised
    Real scale;   // a factor taken out of the density, as an exponent
};
Marginal marginal(Ndf ndf, const Real& l, const Real& z) {
    Marginal m{l, z, 0, 0, {}, 0};
    if (ndf == Ndf::ggx) {
        m.lo = -pi / 2;
        m.hi = atan2(z, l);  // -pi / 2 at z < 0, l = 0
        m.density = [l, z](const Real& psi) { return (z * cos(psi) - l * sin(psi)) / 2; };
        return m;
    }
    const Real a = l == 0 ? Real(1e60) : z / l, top = a < 14 ? a : Real(14);
    m.scale = a < 0 ? Real(a * a) : Real(0);
    const Real reach = a < 0 ? Real(180 / (sqrt(a * a + 180) - a)) : Real(top + 14);
    m.lo = -reach;
    m.hi = 0;
    m.density = [=](const Real& t) {  // x = top + t
        const Real x = top + t, gap = a < 14 ? Real(-l * t) : Real(z - l * x);
        return gap * exp(a < 0 ? Real(t * (-t - 2 * a)) : Real(-x * x)) / root_pi;
    };
    // gap = z - l x; a < 0: x^2 - a^2 = t (t + 2 a), negated
    return m;
}
Real slope_of(Ndf ndf, const Marginal& m, const Real& at) {
    if (ndf == Ndf::ggx) return tan(at);
    const Real a = m.l == 0 ? Real(1e60) : m.z / m.l;
    return (a < 14 ? a : Real(14)) + at;
}

// e^scale sigma and scale.
struct Scaled {
    Real value, scale;
};
Scaled scaled_sigma(Ndf ndf, const Vec& w, const Real& ax, const Real& ay) {
    const Marginal m = marginal(ndf, sqrt(ax * ax * w.x * w.x + ay * ay * w.y * w.y), w.z);
    return {integrate(m.density, m.lo, m.hi), m.scale};
}
Real sigma(Ndf ndf, const Vec& w, const Real& ax, const Real& ay) {
    const Scaled s = scaled_sigma(ndf, w, ax, ay);
    return s.value * exp(-s.scale);
}
Real lambda(Ndf ndf, const Vec& w, const Real& ax, const Real& ay) {
    if (w.x == 0 && w.y == 0) return w.z > 0 ? 0 : -1;  // sigma = max(w.z, 0), exactly
    return sigma(ndf, w, ax, ay) / w.z - 1;
}
Real pdf_wm(Ndf ndf, const Vec& wo, const Vec& m, const Real& ax, const Real& ay) {
    const Real cosine = dot(wo, m);
    return cosine > 0 ? Real(cosine * d(ndf, m, ax, ay) / sigma(ndf, wo, ax, ay)) : Real(0);
}
Real pdf_wi(Ndf ndf, const Vec& wo, const Vec& wi, const Real& ax, const Real& ay) {
    const Vec m = unit(wo + wi);
    return pdf_wm(ndf, wo, m, ax, ay) / (4 * dot(wo, m));
}

// Equation 5 with Equation 6.
Real bound_k(const Vec& wo, const Real& ax, const Real& ay) {
    Real a = ax < ay ? ax : ay;
    if (a > 1) a = 1;
    const Real s = 1 + sqrt(wo.x * wo.x + wo.y * wo.y);
    return (1 - a * a) * s * s / (s * s + a * a * wo.z * wo.z);
}
// The density of the cap above o_z = -k wo_z, k by `bound`.
using Bound = Real (*)(const Vec& wo, const Real& ax, const Real& ay);
Real pdf_wi_bounded(const Vec& wo, const Vec& wi, const Real& ax, const Real& ay, Bound bound = bound_k) {
    if (wo.z <= 0) return pdf_wi(Ndf::ggx, wo, wi, ax, ay);
    const Vec i = {ax * wo.x, ay * wo.y, wo.z}, m = unit(wo + wi);
    const Vec m_std = unit({m.x / ax, m.y / ay, m.z});
    const Real k = bound(wo, ax, ay);
    if (m.z <= 0 || reflect(unit(i), m_std).z <= -k * unit(i).z) return 0;
    return d(Ndf::ggx, m, ax, ay) / (2 * (k * wo.z + norm(i)));
}

// --- Samplers: direction and density ---

struct Sample {
    Vec direction;
    Real pdf;
};

struct Stretched {
    Vec i;       // unit
    Real theta;  // polar angle
    Real ex, ey;
};
Stretched stretch(const Vec& wo, const Real& ax, const Real& ay, const Real& ex0 = 1, const Real& ey0 = 0) {
    Stretched s;
    s.i = unit({ax * wo.x, ay * wo.y, wo.z});
    const Real l = sqrt(s.i.x * s.i.x + s.i.y * s.i.y);
    s.theta = atan2(l, s.i.z);
    s.ex = l > 0 ? Real(s.i.x / l) : ex0;
    s.ey = l > 0 ? Real(s.i.y / l) : ey0;
    return s;
}
Vec unstretch(const Vec& m, const Real& ax, const Real& ay) {
    return unit({ax * m.x, ay * m.y, m.z});
}
Vec from_slopes(const Stretched& s, const Real& x, const Real& y, const Real& ax, const Real& ay) {
    const Real sx = s.ex * x - s.ey * y, sy = s.ey * x + s.ex * y;
    return unit({-ax * sx, -ay * sy, 1});
}

Real cos2(const Real& x) {
    return cos(x) * cos(x);
}

Sample slopes_ggx(const Vec& wo, const Real& ax, const Real& ay, const Real& u1, const Real& u2, bool fit) {
    const Stretched s = stretch(wo, ax, ay);
    const Marginal m = marginal(Ndf::ggx, sin(s.theta), cos(s.theta));
    const Real x = slope_of(Ndf::ggx, m, invert(m.density, m.lo, m.hi, u1));
    // z = tan(psi): density (2 / pi) / (1 + z^2)^2 dz = (2 / pi) cos^2(psi) dpsi
    Real z, ratio = 1;
    if (fit) {
        const Real u = abs(2 * u2 - 1);
        const auto c = [](const char* digits) { return Real(digits); };
        const auto curve = [&](const Real& v) {
            return v * (v * (v * c("0.27385") - c("0.73369")) + c("0.46341")) /
                   (v * (v * (v * c("0.093073") + c("0.309420")) - 1) + c("0.597999"));
        };
        z = u2 > Real(0.5) ? curve(u) : -curve(u);
        const Real h(1e-25), density = 1 / (2 * (curve(u + h) - curve(u - h)) / (2 * h));
        ratio = density / (2 / pi / ((1 + z * z) * (1 + z * z)));
    } else {
        z = tan(invert(cos2, -pi / 2, pi / 2, u2));
    }
    const Vec n = from_slopes(s, x, z * sqrt(1 + x * x), ax, ay);
    return {n, pdf_wm(Ndf::ggx, wo, n, ax, ay) * ratio};
}

// 2017, the listing with T2 = T1 x V and the factor V.z on the lower half.
Sample half_disks(const Vec& wo, const Real& ax, const Real& ay, const Real& u1, const Real& u2) {
    const Vec v = stretch(wo, ax, ay).i;
    const Vec t1 = v.x == 0 && v.y == 0 ? Vec{1, 0, 0} : unit(cross(v, {0, 0, 1})), t2 = cross(t1, v);
    const Real a = 1 / (1 + v.z), r = sqrt(u1),
               phi = u2 < a ? Real(u2 / a * pi) : Real(pi + (u2 - a) / (1 - a) * pi);
    const Real p1 = r * cos(phi), p2 = r * sin(phi) * (u2 < a ? Real(1) : v.z);
    const Vec n = p1 * t1 + p2 * t2 + sqrt(1 - p1 * p1 - p2 * p2) * v;
    const Vec m = unstretch(n, ax, ay);
    return {m, pdf_wm(Ndf::ggx, wo, m, ax, ay)};
}

// 2018, Dupuy & Benyoub's Listing 2.
Sample cross_section(const Vec& wo, const Real& ax, const Real& ay, const Real& u1, const Real& u2) {
    const Vec v = stretch(wo, ax, ay).i;
    const Vec w1 = v.x == 0 && v.y == 0 ? Vec{1, 0, 0} : unit({-v.y, v.x, 0}), w2 = cross(v, w1);
    const Real phi = 2 * pi * u1, r = sqrt(u2), t1 = r * cos(phi), s = (1 + v.z) / 2;
    const Real t2 = (1 - s) * sqrt(1 - t1 * t1) + s * r * sin(phi), ti = sqrt(1 - t1 * t1 - t2 * t2);
    const Vec m = unstretch(t1 * w1 + t2 * w2 + ti * v, ax, ay);
    return {m, pdf_wm(Ndf::ggx, wo, m, ax, ay)};
}

// The height on the cap by integrating the visible normals' density, carried to the stretched reflection at the
// azimuth phi by the Jacobian 1 / (4 i . m), over the polar angle.
Vec cap_direction(const Stretched& s, const Real& theta_max, const Real& phi, const Real& u2) {
    const auto direction = [&](const Real& theta) {
        return Vec{sin(theta) * cos(phi), sin(theta) * sin(phi), cos(theta)};
    };
    const Real sigma_std =
        integrate([&](const Real& psi) { return (s.i.z * cos(psi) - sin(s.theta) * sin(psi)) / 2; }, -pi / 2,
                  pi / 2 - s.theta);
    const auto density = [&](const Real& theta) {
        const Vec h = direction(theta) + s.i;
        const Real length = norm(h), cosine = length > 0 ? Real(dot(h, s.i) / length) : Real(0);
        if (cosine == 0) return Real(0);  // the very end of the range
        return Real(cosine / pi / sigma_std / (4 * cosine) * sin(theta));
    };
    return direction(invert(density, 0, theta_max, u2));
}

Sample cap(const Vec& wo, const Real& ax, const Real& ay, const Real& u1, const Real& u2) {
    const Stretched s = stretch(wo, ax, ay);
    const Vec m = unstretch(cap_direction(s, pi - s.theta, 2 * pi * u1, u2) + s.i, ax, ay);
    return {m, pdf_wm(Ndf::ggx, wo, m, ax, ay)};
}

Sample bounded_cap(const Vec& wo, const Real& ax, const Real& ay, const Real& u1, const Real& u2) {
    const Stretched s = stretch(wo, ax, ay);
    const Real theta_max = wo.z > 0 ? Real(acos(-bound_k(wo, ax, ay) * s.i.z)) : Real(pi - s.theta);
    const Vec m = unstretch(cap_direction(s, theta_max, 2 * pi * u1, u2) + s.i, ax, ay);
    const Vec wi = reflect(wo, m);
    return {wi, pdf_wi_bounded(wo, wi, ax, ay)};
}

// --- Reflections above the horizon: 2 (s . m) m.z > s.z |A m|^2, m^T Q m > 0 ---

// Eigenvalues and vectors of a symmetric matrix by Jacobi's rotations, and the axes in the order and with the signs of
// the kernels: e0 of the positive eigenvalue, e1 of the lowest, towards s.
struct Cone {
    Vec e0, e1, e2;
    Real mu, mu1, mu2;
};
Cone cone(Real (&a)[3][3], const Vec& s, const std::function<Real(const Cone&)>& side) {
    Real v[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    for (int sweep = 0; sweep < 40; ++sweep)
        for (const auto& [p, q] : {std::pair{0, 1}, {0, 2}, {1, 2}}) {
            if (a[p][q] == 0) continue;
            const Real theta = (a[q][q] - a[p][p]) / (2 * a[p][q]);
            const Real t = (theta < 0 ? -1 : 1) / (abs(theta) + sqrt(theta * theta + 1));
            const Real c = 1 / sqrt(t * t + 1), sine = t * c;
            Real b[3][3];
            for (int i = 0; i < 3; ++i)
                for (int j = 0; j < 3; ++j) b[i][j] = a[i][j];
            for (int i = 0; i < 3; ++i) {
                b[i][p] = c * a[i][p] - sine * a[i][q], b[i][q] = sine * a[i][p] + c * a[i][q];
                const Real x = v[i][p], y = v[i][q];
                v[i][p] = c * x - sine * y, v[i][q] = sine * x + c * y;
            }
            for (int j = 0; j < 3; ++j) {
                a[p][j] = c * b[p][j] - sine * b[q][j], a[q][j] = sine * b[p][j] + c * b[q][j];
                if (j != p && j != q) a[j][p] = a[p][j], a[j][q] = a[q][j];
            }
            a[p][q] = a[q][p] = 0;
        }
    int order[3] = {2, 0, 1};
    for (int i = 1; i < 3; ++i)
        if (a[order[i]][order[i]] > a[order[0]][order[0]]) std::swap(order[0], order[i]);
    if (a[order[1]][order[1]] > a[order[2]][order[2]]) std::swap(order[1], order[2]);
    const auto axis = [&](int i) { return Vec{v[0][order[i]], v[1][order[i]], v[2][order[i]]}; };
    Cone c{axis(0), axis(1), axis(2), a[order[0]][order[0]], -a[order[1]][order[1]], -a[order[2]][order[2]]};
    if (dot(c.e0, s) < 0) c.e0 = Real(-1) * c.e0;
    Real towards = side(c);
    if (abs(towards) < Real(1e-60)) towards = abs(c.e1.x) < abs(c.e1.y) ? c.e1.y : c.e1.x;
    if (towards < 0) c.e1 = Real(-1) * c.e1;
    c.e2 = cross(c.e0, c.e1);
    return c;
}

Cone cone(const Vec& s, const Real& ax, const Real& ay) {
    Real a[3][3] = {{-s.z * ax * ax, 0, s.x}, {0, -s.z * ay * ay, s.y}, {s.x, s.y, s.z}};
    return cone(a, s, [&s](const Cone& c) { return dot(c.e1, s); });
}

// The area of the horizon's curve seen along s, over pi: an ellipse across e0 of semi-axes sqrt(mu / (mu + mu1)) and
// sqrt(mu / (mu + mu2)).
Real sigma_visible(const Vec& wo, const Real& ax, const Real& ay) {
    if (wo.z <= 0) return sigma(Ndf::ggx, wo, ax, ay);
    const Vec v = {ax * wo.x, ay * wo.y, wo.z};
    const Cone c = cone(unit(v), ax, ay);
    return dot(v, c.e0) * c.mu / sqrt((c.mu + c.mu1) * (c.mu + c.mu2));
}
Real pdf_wi_conic(const Vec& wo, const Vec& wi, const Real& ax, const Real& ay) {
    if (wo.z <= 0) return pdf_wi(Ndf::ggx, wo, wi, ax, ay);
    return wi.z > 0 ? Real(d(Ndf::ggx, unit(wo + wi), ax, ay) / (4 * sigma_visible(wo, ax, ay))) : Real(0);
}

// From the disk point (X, Y): the point with m1 = p Y on the chord between the rim points of that slice; along s without
// s1 to the rim; along s to the sphere.
Vec cone_normal(const Cone& c, const Vec& s, const Real& u1, const Real& u2) {
    const Real s0 = dot(s, c.e0), s1 = dot(s, c.e1), s2 = dot(s, c.e2), n = sqrt(s0 * s0 + s2 * s2);
    const Real x = sqrt(u2) * cos(2 * pi * u1), y = sqrt(u2) * sin(2 * pi * u1);
    const Real p2 = c.mu / (c.mu + c.mu1), q2 = c.mu / (c.mu + c.mu2);
    Real m0 = sqrt(1 - p2 * y * y - q2 * (1 - y * y)), m2 = sqrt(q2) * x;
    const Real m1 = sqrt(p2) * y;
    // (mu + mu1) m0^2 + (mu1 - mu2) m2^2 = mu1 on the rim.
    const Real f0 = c.mu + c.mu1, f2 = c.mu1 - c.mu2, c0 = s0 / n, c2 = s2 / n;
    const Real a = f0 * c0 * c0 + f2 * c2 * c2, b = f0 * c0 * m0 + f2 * c2 * m2,
               rest = f0 * m0 * m0 + f2 * m2 * m2 - c.mu1;
    const Real epsilon = (sqrt(b * b - a * rest) - b) / a;
    m0 += c0 * epsilon, m2 += c2 * epsilon;
    const Real along = s0 * m0 + s1 * m1 + s2 * m2;
    const Real tau = sqrt(along * along + 1 - m0 * m0 - m1 * m1 - m2 * m2) - along;
    return (m0 + tau * s0) * c.e0 + (m1 + tau * s1) * c.e1 + (m2 + tau * s2) * c.e2;
}
Sample conic(const Vec& wo, const Real& ax, const Real& ay, const Real& u1, const Real& u2) {
    if (wo.z <= 0) {
        const Sample m = cap(wo, ax, ay, u1, u2);
        const Vec wi = reflect(wo, m.direction);
        return {wi, pdf_wi(Ndf::ggx, wo, wi, ax, ay)};
    }
    const Vec s = unit({ax * wo.x, ay * wo.y, wo.z});
    const Vec wi = reflect(wo, unstretch(cone_normal(cone(s, ax, ay), s, u1, u2), ax, ay));
    return {wi, pdf_wi_conic(wo, wi, ax, ay)};
}

// u of a normal: the same lines backwards; along = s . m, height = m^T Q m.
Reals invert_cone(const Cone& c, const Vec& s, const Vec& m, const Real& along, const Real& height) {
    const Real s0 = dot(s, c.e0), s1 = dot(s, c.e1), s2 = dot(s, c.e2), n = sqrt(s0 * s0 + s2 * s2);
    const Real c0 = s0 / n, c2 = s2 / n, f0 = c.mu + c.mu1, f2 = c.mu1 - c.mu2;
    const Real m0 = dot(m, c.e0), m1 = dot(m, c.e1), m2 = dot(m, c.e2);
    const Real a = f0 * c0 * c0 + f2 * c2 * c2, b = f0 * c0 * m0 + f2 * c2 * m2;
    const Real delta = (b - sqrt(b * b - a * height)) / a, tau = delta / n;
    const Real p2 = c.mu / f0, q2 = c.mu / (c.mu + c.mu2), y = (m1 - s1 * tau) / sqrt(p2);
    const Real left = tau * (2 * along - tau) / p2, rim = sqrt(1 - p2 * y * y - q2 * (1 - y * y));
    const Real epsilon = f2 / f0 * q2 * left / (c0 * (rim + m0 - c0 * delta));
    const Real x = (m2 - c2 * (delta + epsilon)) / sqrt(q2), turn = atan2(y, x) / (2 * pi);
    return {turn < 0 ? Real(turn + 1) : turn, x * x + y * y};
}
// Of vectors as given, not quite unit ones: wo . h is |h|^2 / 2 and m^T Q m is wi.z |A m|^2 / t.
Reals invert_conic(const Vec& wo, const Vec& wi, const Real& ax, const Real& ay) {
    const Vec v = {ax * wo.x, ay * wo.y, wo.z}, h = wo + wi, h_std = {h.x / ax, h.y / ay, h.z};
    return invert_cone(cone(unit(v), ax, ay), unit(v), unit(h_std), dot(h, h) / (2 * norm(h_std) * norm(v)),
                       wi.z * dot(h, h) / (dot(h_std, h_std) * norm(v)));
}

// --- Reflections into a cap: 2 (wo . g)(l . g) > (cos beta + wo . l) |g|^2, g = A m ---

struct Light {
    Vec wo, l;
    Real omc, ax, ay;
};
Light light(const Reals& in, int alpha) {
    const auto at = [&](int i) { return unit(Vec{in[i], in[i + 1], in[i + 2]}); };
    return {at(0), at(3), in[6], in[alpha], in[alpha + 1]};
}
Vec stretched(const Light& c, const Vec& w) {
    return {c.ax * w.x, c.ay * w.y, w.z};
}
// For -wo outside the cap.
Cone cone(const Light& c) {
    const Vec v = stretched(c, c.wo), w = stretched(c, c.l);
    const Real kappa = 1 - c.omc + dot(c.wo, c.l), x[3] = {v.x, v.y, v.z}, y[3] = {w.x, w.y, w.z},
               scale[3] = {c.ax, c.ay, 1};
    Real a[3][3];
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
            a[i][j] = x[i] * y[j] + y[i] * x[j] - (i == j ? Real(kappa * scale[i] * scale[i]) : Real(0));
    return cone(a, v,
                [&](const Cone& k) { return dot(k.e1, v) * dot(k.e0, w) - dot(k.e1, w) * dot(k.e0, v); });
}
Real sigma_cap(const Light& c) {
    const Cone k = cone(c);
    return dot(stretched(c, c.wo), k.e0) * k.mu / sqrt((k.mu + k.mu1) * (k.mu + k.mu2));
}
Real pdf_wi_cap(const Light& c, const Vec& h) {
    return d(Ndf::ggx, unit(h), c.ax, c.ay) / (4 * sigma_cap(c));
}
Sample sample_cap(const Light& c, const Real& u1, const Real& u2) {
    const Vec m = cone_normal(cone(c), unit(stretched(c, c.wo)), u1, u2);
    const Vec wi = reflect(c.wo, unstretch(m, c.ax, c.ay));
    return {wi, pdf_wi_cap(c, c.wo + wi)};
}
Reals invert_cap(const Light& c, const Vec& given) {
    const Vec wi = unit(given), h = c.wo + wi, h_std = {h.x / c.ax, h.y / c.ay, h.z}, v = stretched(c, c.wo);
    return invert_cone(cone(c), unit(v), unit(h_std), dot(h, h) / (2 * norm(h_std) * norm(v)),
                       (dot(wi, c.l) - 1 + c.omc) * dot(h, h) / dot(h_std, h_std));
}

// --- What is seen of regions of normals: v . V / pi, by quadrature along the great circles that bound their reflections ---

// From a to b, not opposite to it, along the chord p: 1/2 v . (g x g') / |g|^2 of the half vector g = wo |p| + p, stretched back,
// whose length makes no difference.
Real arc(const Vec& wo, const Real& ax, const Real& ay, const Vec& a, const Vec& b) {
    const Vec v = {ax * wo.x, ay * wo.y, wo.z}, e = b - a;
    const auto back = [&](const Vec& w) { return Vec{w.x / ax, w.y / ay, w.z}; };
    const auto f = [&](const Real& t) {
        const Vec p = a + t * e;
        const Real r = norm(p);
        const Vec g = back(r * wo + p), d = back(Real(dot(p, e) / r) * wo + e);
        return Real(dot(v, cross(g, d)) / dot(g, g) / 2);
    };
    // In parts, so that a peak is never far from an end.
    Real sum = 0;
    for (int i = 0; i < 4; ++i) sum += integrate(f, Real(i) / 4, Real(i + 1) / 4);
    return sum;
}
Real polygon_mass(const Vec& wo, std::vector<Vec> at, const Real& ax, const Real& ay) {
    std::vector<Vec> above;
    for (std::size_t i = 0; i < at.size(); ++i) {
        const Vec a = at[i], b = at[(i + 1) % at.size()];
        if (a.z > 0) above.push_back(a);
        if ((a.z > 0) != (b.z > 0)) {
            const Vec x = unit(a + Real(a.z / (a.z - b.z)) * (b - a));
            above.push_back({x.x, x.y, 0});
        }
    }
    Real sum = 0;
    for (std::size_t i = 0; i < above.size(); ++i)
        sum += arc(wo, ax, ay, above[i], above[(i + 1) % above.size()]);
    return abs(sum) / pi;
}
// The lune as two triangles, from one corner to the middle of either horizon and the other corner.
Real sigma_tilted(const Vec& wo, const Vec& ng, const Real& ax, const Real& ay) {
    const Vec z = {0, 0, 1}, left = unit(cross(z, ng)), right = -1 * left;
    const Vec far_z = unit(cross(left, z)), far_ng = unit(cross(ng, left));
    return (arc(wo, ax, ay, right, far_z) + arc(wo, ax, ay, far_z, left) + arc(wo, ax, ay, left, far_ng) +
            arc(wo, ax, ay, far_ng, right)) /
           pi;
}

// Reflections above z and ng: of the smaller cone.
Light about(const Vec& wo, const Vec& ng, const Real& ax, const Real& ay) {
    return {wo, ng, 1, ax, ay};
}
bool is_about_ng(const Light& c) {
    return dot(c.wo, c.l) > 0 && sigma_cap(c) < sigma_visible(c.wo, c.ax, c.ay);
}
Real pdf_wi_tilted(const Light& c, const Vec& wi) {
    if (wi.z <= 0 || dot(wi, c.l) <= 0) return 0;
    return is_about_ng(c) ? pdf_wi_cap(c, c.wo + wi) : pdf_wi_conic(c.wo, wi, c.ax, c.ay);
}
Sample sample_tilted(const Light& c, const Real& u1, const Real& u2) {
    const Vec wi =
        is_about_ng(c) ? sample_cap(c, u1, u2).direction : conic(c.wo, c.ax, c.ay, u1, u2).direction;
    const Real pdf = pdf_wi_tilted(c, wi);
    return pdf > 0 ? Sample{wi, pdf} : Sample{{0, 0, 0}, 0};
}

// The bound of the polygon: 1 / (1 - k) is the largest of the three candidates.
Real polygon_k(const Vec& view, const Real& ax, const Real& ay) {
    const Vec wo = unit(view);
    const bool swap = ax < ay;
    const Real low = swap ? ax : ay, high = swap ? ay : ax, y = abs(swap ? wo.x : wo.y);
    const Real sine = sqrt(wo.x * wo.x + wo.y * wo.y), z2 = wo.z * wo.z;
    const auto ratio = [&](const Real& xs, const Real& ys) {
        return Real((xs / (high * high) + ys / (low * low) + z2) / (xs + ys + z2));
    };
    const Real side = (1 + y) * (1 + y), most = (1 + sine) * (1 + sine);
    Real largest = ratio(0, (1 - sine) * (1 - sine));
    for (const Real& r : {ratio(0, side), ratio(most - side, side)})
        if (r > largest) largest = r;
    return 1 - 1 / largest;
}
Sample polygon_cap(const Vec& wo, const Real& ax, const Real& ay, const Real& u1, const Real& u2) {
    const Stretched s = stretch(wo, ax, ay);
    const Real theta_max = wo.z > 0 ? Real(acos(-polygon_k(wo, ax, ay) * s.i.z)) : Real(pi - s.theta);
    const Vec m = unstretch(cap_direction(s, theta_max, 2 * pi * u1, u2) + s.i, ax, ay);
    const Vec wi = reflect(wo, m);
    return {wi, pdf_wi_bounded(wo, wi, ax, ay, polygon_k)};
}

// The GLSL listing; below, the mirrored sample and the axis -z.
Sample world(const Vec& wo, const Vec& n, const Real& alpha, const Real& u1, const Real& u2) {
    const Vec along = dot(wo, n) * n, across = wo - along;
    const Vec i_std = unit(along - alpha * across);
    const Real phi = (2 * u1 - 1) * pi, z = (1 - u2) * (1 + dot(i_std, n)) - dot(i_std, n);
    const Real sine = sqrt((1 - z) * (1 + z));
    const bool below = n.z < 0;
    const Vec c = {sine * cos(phi), sine * sin(phi), below ? Real(-z) : z};
    const Vec w = below ? n - Vec{0, 0, 1} : n + Vec{0, 0, 1};
    const Vec mirrored = (dot(w, c) / abs(w.z)) * w - c;
    const Vec m = mirrored + i_std, m_along = dot(n, m) * n;
    const Vec result = unit(m_along + alpha * (m_along - m));
    // The density in a frame about n.
    const Vec t1 = unit(abs(n.x) < Real(0.5) ? cross(n, {1, 0, 0}) : cross(n, {0, 1, 0})), t2 = cross(n, t1);
    const auto local = [&](const Vec& v) { return Vec{dot(t1, v), dot(t2, v), dot(n, v)}; };
    return {result, pdf_wm(Ndf::ggx, local(wo), local(result), alpha, alpha)};
}

Sample walter(Ndf ndf, const Real& ax, const Real& ay, const Real& u1, const Real& u2) {
    // tan(theta) for alpha = 1, by inverting the share of the shorter slopes: 2 pi r P22 in r = tan(psi).
    const auto density = [&](const Real& psi) {
        const Real r = tan(psi), c = cos(psi);
        return Real(2 * pi * r * p22(ndf, r, 0) / (c * c));
    };
    const Real end = ndf == Ndf::ggx ? Real(pi / 2 - Real(1e-60)) : Real(atan(Real(14)));
    const Real r = tan(invert(density, 0, end, u1)), phi = 2 * pi * u2;
    const Vec m = unit({ax * r * cos(phi), ay * r * sin(phi), 1});
    return {m, d(ndf, m, ax, ay) * m.z};
}

Real erf_inv(const Real& p) {
    Real x = boost::math::erf_inv(static_cast<double>(p));
    for (int i = 0; i < 5; ++i) x -= (boost::math::erf(x) - p) * root_pi / 2 * exp(x * x);
    return x;
}

// The density of slopes at alpha = 1 is (a - x) exp(-x^2 - y^2) / (pi integral of (a - s) P2(s)), with the
// integral scaled behind the surface.
Sample beckmann_sample(const Vec& wo, const Stretched& s, const Real& x, const Real& y, const Real& ax,
                       const Real& ay) {
    const Vec m = from_slopes(s, x, y, ax, ay);
    const Scaled area = scaled_sigma(Ndf::beckmann, wo, ax, ay);
    const Real p = exp(area.scale - x * x - y * y) / (pi * ax * ay * m.z * m.z * m.z * m.z);
    return {m, dot(wo, m) * p / area.value};
}

Sample jakob(const Vec& wo, const Real& ax, const Real& ay, const Real& u1, const Real& u2) {
    const Stretched s = stretch(wo, ax, ay);
    const Marginal m = marginal(Ndf::beckmann, sin(s.theta), cos(s.theta));
    const Real x = slope_of(Ndf::beckmann, m, invert(m.density, m.lo, m.hi, u1));
    const Real y = invert([](const Real& t) { return exp(-t * t); }, -14, 14, u2);
    return beckmann_sample(wo, s, x, y, ax, ay);
}

// Algorithm 2, line by line, with G1 from the projected area.
Sample three_branches(const Vec& wo, const Real& ax, const Real& ay, Real u1, Real u2) {
    const Stretched s = stretch(wo, ax, ay);
    const Real st = sin(s.theta), ct = cos(s.theta), cot = ct / st;
    const Real g1 = ct / sigma(Ndf::beckmann, {st, 0, ct}, 1, 1), erf_a = boost::math::erf(cot),
               exp_a2 = exp(-cot * cot);
    const Real c = 1 - g1 * erf_a;
    Real x;
    if (u1 < c) {
        u1 /= c;
        const Real w1 = st * exp_a2 / (2 * root_pi), w2 = ct * boost::math::erfc(cot) / 2, p = w1 / (w1 + w2);
        if (u1 < p)
            x = -sqrt(-log(u1 / p * exp_a2));
        else
            x = erf_inv((u1 - p) / (1 - p) * boost::math::erfc(cot) - 1);
    } else {
        u1 = (u1 - c) / (1 - c);
        x = erf_inv((2 * u1 - 1) * erf_a);
        const Real p = (ct - x * st) / (2 * ct);
        if (u2 > p) {
            x = -x;
            u2 = (u2 - p) / (1 - p);
        } else {
            u2 /= p;
        }
    }
    return beckmann_sample(wo, s, x, erf_inv(2 * u2 - 1), ax, ay);
}

// --- Names ---

Vec vec(const Reals& in, int at) {
    return {in[at], in[at + 1], in[at + 2]};
}
Reals list(const Sample& s) {
    return {s.direction.x, s.direction.y, s.direction.z, s.pdf};
}
Reals list(const Vec& v) {
    return {v.x, v.y, v.z};
}

// |d half vector / d wi| by differences on the sphere: wi is moved in two directions across it.
Real jacobian(const Vec& wi, const std::function<Vec(Vec)>& half) {
    const Real h(1e-20);
    const Vec t1 = unit(abs(wi.x) < Real(0.5) ? cross(wi, {1, 0, 0}) : cross(wi, {0, 1, 0})),
              t2 = cross(unit(wi), t1);
    const auto change = [&](const Vec& t) {
        return 1 / (2 * h) * (half(unit(wi + h * t)) - half(unit(wi - h * t)));
    };
    return norm(cross(change(t1), change(t2)));
}

using Evaluation = std::function<Reals(const Reals&)>;

std::map<std::string, Evaluation> evaluations() {
    std::map<std::string, Evaluation> all;
    using Map = Sample (*)(const Vec&, const Real&, const Real&, const Real&, const Real&);
    const auto sampler =
        [&](const std::string& name,
            std::function<Sample(const Vec&, const Real&, const Real&, const Real&, const Real&)> map) {
            all["vndf_" + name + "_with_pdf"] = [map](const Reals& in) {
                return list(map(unit(vec(in, 0)), in[3], in[4], in[5], in[6]));
            };
        };
    sampler("ggx_sample_wm_heitz_deon2014", [](auto&&... in) { return slopes_ggx(in..., true); });
    sampler("ggx_sample_wm_heitz_deon2014_exact", [](auto&&... in) { return slopes_ggx(in..., false); });
    sampler("ggx_sample_wm_heitz2017", Map(half_disks));
    sampler("ggx_sample_wm_heitz2018", Map(cross_section));
    sampler("ggx_sample_wm_dupuy2023", Map(cap));
    sampler("ggx_sample_wi_eto2023", Map(bounded_cap));
    sampler("beckmann_sample_wm_heitz_deon2014", three_branches);
    sampler("beckmann_sample_wm_jakob2014", Map(jakob));
    all["vndf_ggx_sample_wm_benyoub2024_with_pdf"] = [](const Reals& in) {
        return list(world(unit(vec(in, 0)), unit(vec(in, 3)), in[6], in[7], in[8]));
    };
    for (const Ndf ndf : {Ndf::ggx, Ndf::beckmann}) {
        const std::string prefix = ndf == Ndf::ggx ? "vndf_ggx_" : "vndf_beckmann_";
        all[prefix + "sample_wm_walter2007_with_pdf"] = [ndf](const Reals& in) {
            return list(walter(ndf, in[0], in[1], in[2], in[3]));
        };
        all[prefix + "ndf"] = [ndf](const Reals& in) { return Reals{d(ndf, vec(in, 0), in[3], in[4])}; };
        all[prefix + "pdf_wm_walter2007"] = [ndf](const Reals& in) {
            return Reals{d(ndf, vec(in, 0), in[3], in[4]) * in[2]};
        };
        all[prefix + "p22"] = [ndf](const Reals& in) {
            return Reals{p22(ndf, in[0] / in[2], in[1] / in[3]) / (in[2] * in[3])};
        };
        all[prefix + "sigma"] = [ndf](const Reals& in) {
            return Reals{sigma(ndf, vec(in, 0), in[3], in[4])};
        };
        all[prefix + "lambda"] = [ndf](const Reals& in) {
            return Reals{lambda(ndf, vec(in, 0), in[3], in[4])};
        };
        all[prefix + "g1"] = [ndf](const Reals& in) {
            return Reals{in[2] > 0 ? Real(in[2] / sigma(ndf, vec(in, 0), in[3], in[4])) : Real(0)};
        };
        const auto both = [](const Reals& in) { return in[2] > 0 && in[5] > 0; };
        all[prefix + "g2"] = [ndf, both](const Reals& in) {
            return Reals{both(in) ? Real(1 / (1 + lambda(ndf, vec(in, 0), in[6], in[7]) +
                                              lambda(ndf, vec(in, 3), in[6], in[7])))
                                  : Real(0)};
        };
        all[prefix + "weight"] = [ndf, both](const Reals& in) {
            const Real mask = both(in) ? Real(1 + lambda(ndf, vec(in, 0), in[6], in[7])) : Real(1);
            return Reals{both(in) ? Real(mask / (mask + lambda(ndf, vec(in, 3), in[6], in[7]))) : Real(0)};
        };
        all[prefix + "g2_separable"] = [ndf, both](const Reals& in) {
            return Reals{both(in) ? Real(in[2] / sigma(ndf, vec(in, 0), in[6], in[7]) * in[5] /
                                         sigma(ndf, vec(in, 3), in[6], in[7]))
                                  : Real(0)};
        };
        all[prefix + "pdf_wm"] = [ndf](const Reals& in) {
            return Reals{pdf_wm(ndf, vec(in, 0), vec(in, 3), in[6], in[7])};
        };
        all[prefix + "pdf_wi"] = [ndf](const Reals& in) {
            return Reals{pdf_wi(ndf, vec(in, 0), vec(in, 3), in[6], in[7])};
        };
        // The half vector's Jacobian dwm / dwi is 1 / (4 wo . wm), whichever of the two wo is.
        all[prefix + "pdf_wi_both"] = [ndf](const Reals& in) {
            const Vec wo = vec(in, 0), wi = vec(in, 3);
            return Reals{pdf_wi(ndf, wo, wi, in[6], in[7]), pdf_wi(ndf, wi, wo, in[6], in[7])};
        };
        // The BRDF by G1 and G2 / G1: the weight times the density over the cosine of wi.
        all[prefix + "eval_pdf"] = [ndf, both](const Reals& in) {
            const Real pdf = pdf_wi(ndf, vec(in, 0), vec(in, 3), in[6], in[7]);
            const Real mask = both(in) ? Real(1 + lambda(ndf, vec(in, 0), in[6], in[7])) : Real(1);
            const Real weight =
                both(in) ? Real(mask / (mask + lambda(ndf, vec(in, 3), in[6], in[7]))) : Real(0);
            return Reals{both(in) ? Real(weight * pdf / in[5]) : Real(0), pdf};
        };
        // The marginal in the plane of incidence at alpha = 1.
        const auto plane = [ndf](const Real& c) { return marginal(ndf, sqrt((1 - c) * (1 + c)), c); };
        const auto place = [ndf](const Marginal& m, const Real& x) {
            if (ndf == Ndf::ggx) return Real(atan(x));
            const Real a = m.l == 0 ? Real(1e60) : m.z / m.l;
            return Real(x - (a < 14 ? a : Real(14)));
        };
        all[prefix + "slope_pdf"] = [ndf, plane, place](const Reals& in) {
            const Marginal m = plane(in[0]);
            const Real at = place(m, in[1]), c = cos(atan(in[1]));
            return Reals{at < m.hi ? Real(m.density(at) / integrate(m.density, m.lo, m.hi) *
                                          (ndf == Ndf::ggx ? Real(c * c) : Real(1)))
                                   : Real(0)};
        };
        all[prefix + "slope_cdf"] = [plane, place](const Reals& in) {
            const Marginal m = plane(in[0]);
            const Real at = place(m, in[1]);
            return Reals{at < m.hi ? Real(integrate(m.density, m.lo, at) / integrate(m.density, m.lo, m.hi))
                                   : Real(1)};
        };
        all[prefix + "slope_cdf_inverse"] = [ndf, plane](const Reals& in) {
            const Marginal m = plane(in[0]);
            return Reals{slope_of(ndf, m, invert(m.density, m.lo, m.hi, in[1]))};
        };
    }
    all["vndf_ggx_pdf_wi_eto2023"] = [](const Reals& in) {
        return Reals{pdf_wi_bounded(vec(in, 0), vec(in, 3), in[6], in[7])};
    };
    sampler("ggx_sample_wi_eto2023_polygon", Map(polygon_cap));
    sampler("ggx_sample_wi_conic2026", Map(conic));
    all["vndf_ggx_sample_wi_conic2026_isotropic_with_pdf"] = [](const Reals& in) {
        return list(conic(unit(vec(in, 0)), in[3], in[3], in[4], in[5]));
    };
    all["vndf_ggx_pdf_wi_eto2023_polygon"] = [](const Reals& in) {
        return Reals{pdf_wi_bounded(vec(in, 0), vec(in, 3), in[6], in[7], polygon_k)};
    };
    all["vndf_ggx_pdf_wi_conic2026"] = [](const Reals& in) {
        return Reals{pdf_wi_conic(vec(in, 0), vec(in, 3), in[6], in[7])};
    };
    all["vndf_ggx_sigma_visible"] = [](const Reals& in) {
        return Reals{sigma_visible(vec(in, 0), in[3], in[4])};
    };
    all["vndf_ggx_reflection_probability"] = [](const Reals& in) {
        const Vec w = vec(in, 0);
        return Reals{sigma_visible(w, in[3], in[4]) / sigma(Ndf::ggx, w, in[3], in[4])};
    };
    all["vndf_ggx_invert_wi_conic2026"] = [](const Reals& in) {
        return invert_conic(vec(in, 0), vec(in, 3), in[6], in[7]);
    };
    all["vndf_ggx_pdf_wm_benyoub2024"] = [](const Reals& in) {
        const Vec wo = vec(in, 0), n = unit(vec(in, 3)), m = vec(in, 6);
        const Real up = dot(wo, n), across = norm(wo - up * n), m_up = dot(m, n),
                   m_across = norm(m - m_up * n);
        const Real cosine = dot(wo, m);
        return Reals{cosine > 0 ? Real(cosine * d(Ndf::ggx, {m_across, 0, m_up}, in[9], in[9]) /
                                       sigma(Ndf::ggx, {across, 0, up}, in[9], in[9]))
                                : Real(0)};
    };
    all["vndf_ggx_sample_wi_cone2026_with_pdf"] = [](const Reals& in) {
        return list(sample_cap(light(in, 7), in[9], in[10]));
    };
    all["vndf_ggx_sigma_cap"] = [](const Reals& in) { return Reals{sigma_cap(light(in, 7))}; };
    all["vndf_ggx_cap_probability"] = [](const Reals& in) {
        const Light c = light(in, 7);
        return Reals{sigma_cap(c) / sigma(Ndf::ggx, c.wo, c.ax, c.ay)};
    };
    all["vndf_ggx_pdf_wi_cone2026"] = [](const Reals& in) {
        return Reals{pdf_wi_cap(light(in, 10), vec(in, 0) + vec(in, 7))};
    };
    all["vndf_ggx_invert_wi_cone2026"] = [](const Reals& in) {
        return invert_cap(light(in, 10), vec(in, 7));
    };
    all["vndf_ggx_sample_wi_tilted2026_with_pdf"] = [](const Reals& in) {
        return list(sample_tilted(about(unit(vec(in, 0)), unit(vec(in, 3)), in[6], in[7]), in[8], in[9]));
    };
    all["vndf_ggx_pdf_wi_tilted2026"] = [](const Reals& in) {
        return Reals{pdf_wi_tilted(about(vec(in, 0), unit(vec(in, 3)), in[9], in[10]), vec(in, 6))};
    };
    all["vndf_ggx_sigma_tilted"] = [](const Reals& in) {
        return Reals{sigma_tilted(unit(vec(in, 0)), unit(vec(in, 3)), in[6], in[7])};
    };
    all["vndf_ggx_triangle_mass"] = [](const Reals& in) {
        return Reals{polygon_mass(unit(vec(in, 0)), {unit(vec(in, 3)), unit(vec(in, 6)), unit(vec(in, 9))},
                                  in[12], in[13])};
    };
    all["vndf_ggx_quad_mass"] = [](const Reals& in) {
        return Reals{polygon_mass(unit(vec(in, 0)),
                                  {unit(vec(in, 3)), unit(vec(in, 6)), unit(vec(in, 9)), unit(vec(in, 12))},
                                  in[15], in[16])};
    };
    // Without the normals below the surface, of which these caps have none.
    all["vndf_ggx_cap_mass"] = all["vndf_ggx_sigma_cap"];
    // About n and by cosines: the local functions of a direction with the same angle to the axis.
    const auto about = [](const Vec& n, const Vec& w) {
        const Vec axis = unit(n);
        const Real up = dot(w, axis);
        return Vec{norm(w - up * axis), 0, up};
    };
    const auto of_cosine = [](const Real& c) { return Vec{sqrt((1 - c) * (1 + c)), 0, c}; };
    const auto local = [](const Vec& w, const Real& alpha) { return Reals{w.x, w.y, w.z, alpha, alpha}; };
    const auto both = [](const Vec& a, const Vec& b, const Real& alpha) {
        return Reals{a.x, a.y, a.z, b.x, b.y, b.z, alpha, alpha};
    };
    for (const Ndf ndf : {Ndf::ggx, Ndf::beckmann}) {
        const std::string prefix = ndf == Ndf::ggx ? "vndf_ggx_" : "vndf_beckmann_";
        for (const char* term : {"ndf", "lambda", "sigma", "g1"}) {
            const Evaluation f = all[prefix + term];
            all[prefix + term + "_world"] = [=](const Reals& in) {
                return f(local(about(vec(in, 3), vec(in, 0)), in[6]));
            };
            all[prefix + term + "_cosines"] = [=](const Reals& in) {
                return f(local(of_cosine(in[0]), in[1]));
            };
        }
        for (const char* term : {"g2", "weight"}) {
            const Evaluation f = all[prefix + term];
            all[prefix + term + "_world"] = [=](const Reals& in) {
                return f(both(about(vec(in, 3), vec(in, 0)), about(vec(in, 3), vec(in, 6)), in[9]));
            };
            all[prefix + term + "_cosines"] = [=](const Reals& in) {
                return f(both(of_cosine(in[0]), of_cosine(in[1]), in[2]));
            };
        }
        const auto visible = [ndf](const Vec& wo, const Vec& m, const Real& alpha) {
            return Real(d(ndf, m, alpha, alpha) / sigma(ndf, wo, alpha, alpha));
        };
        all[prefix + "pdf_wm_world"] = [=](const Reals& in) {
            const Vec wo = vec(in, 0), n = vec(in, 3), m = vec(in, 6);
            const Real cosine = dot(wo, m);
            return Reals{cosine > 0 ? Real(cosine * visible(about(n, wo), about(n, m), in[9])) : Real(0)};
        };
        all[prefix + "pdf_wi_world"] = [=](const Reals& in) {
            const Vec wo = vec(in, 0), n = vec(in, 3), m = unit(wo + vec(in, 6));
            return Reals{visible(about(n, wo), about(n, m), in[9]) / 4};
        };
        all[prefix + "pdf_wm_cosines"] = [=](const Reals& in) {
            return Reals{in[2] * visible(of_cosine(in[0]), of_cosine(in[1]), in[3])};
        };
        all[prefix + "pdf_wi_cosines"] = [=](const Reals& in) {
            return Reals{visible(of_cosine(in[0]), of_cosine(in[1]), in[2]) / 4};
        };
    }
    // Two half turns take z, or -z, to n: about it and about the middle of both.
    all["vndf_tangent"] = [](const Reals& in) {
        const Vec n = unit(vec(in, 0)), h = unit(n + Vec{0, 0, n.z < 0 ? Real(-1) : Real(1)});
        return list(Vec{1, 0, 0} - 2 * h.x * h);
    };
    all["vndf_tangent_along"] = [](const Reals& in) {
        const Vec n = unit(vec(in, 0)), w = vec(in, 3);
        return list(unit(w - dot(w, n) * n));
    };
    all["vndf_to_local"] = [](const Reals& in) {
        const Vec w = vec(in, 0), n = vec(in, 3), t = vec(in, 6);
        return list(Vec{dot(cross(n, t), cross(n, w)), -dot(t, cross(n, w)), dot(w, n)});
    };
    all["vndf_to_world"] = [](const Reals& in) {
        const Vec w = vec(in, 0), n = vec(in, 3), t = vec(in, 6);
        return list(w.x * t + w.y * cross(n, t) + w.z * n);
    };
    all["vndf_reflect"] = [](const Reals& in) { return list(reflect(vec(in, 0), vec(in, 3))); };
    all["vndf_refract"] = [](const Reals& in) {
        // Snell: the part of wo across wm, negated, is divided by eta; the rest is what makes the length 1.
        const Vec wo = unit(vec(in, 0)), m = unit(vec(in, 3));
        const Real c = dot(wo, m);
        if (c <= 0) return list(Vec{0, 0, 0});
        const Vec across = 1 / in[6] * (c * m - wo);
        const Real rest = 1 - dot(across, across);
        return rest < 0 ? list(Vec{0, 0, 0}) : list(across - sqrt(rest) * m);
    };
    all["vndf_jacobian_reflect"] = [](const Reals& in) {
        const Vec wo = unit(vec(in, 0)), m = unit(vec(in, 3));
        return Reals{jacobian(reflect(wo, m), [wo](const Vec& wi) { return unit(wo + wi); })};
    };
    // (a + i b)^2 = (eta + i k)^2 - sin^2, Born & Wolf in real numbers.
    all["vndf_fresnel_conductor"] = [](const Reals& in) {
        const Real c = in[0], s2 = 1 - c * c, t = in[1] * in[1] - in[2] * in[2] - s2;
        const Real size = sqrt(t * t + 4 * in[1] * in[1] * in[2] * in[2]);
        const Real a = sqrt((size + t) / 2), rs = (size + c * c - 2 * a * c) / (size + c * c + 2 * a * c);
        const Real even = c * c * size + s2 * s2, odd = 2 * a * c * s2;
        return Reals{rs * (1 + (even - odd) / (even + odd)) / 2};
    };
    // Fresnel's amplitudes of a dielectric.
    all["vndf_fresnel_dielectric"] = [](const Reals& in) {
        const Real c = in[0], n = in[1], sine2 = (1 - c * c) / (n * n);
        if (sine2 >= 1) return Reals{1};
        const Real t = sqrt(1 - sine2), s = (c - n * t) / (c + n * t), p = (n * c - t) / (n * c + t);
        return Reals{(s * s + p * p) / 2};
    };
    all["vndf_fresnel_cos_theta_t"] = [](const Reals& in) {
        const Real sine2 = (1 - in[0] * in[0]) / (in[1] * in[1]);
        return Reals{sine2 >= 1 ? Real(0) : Real(sqrt(1 - sine2))};
    };
    // Light after a way through a medium, and its index for a colour: Cauchy's formula through Fraunhofer's lines.
    all["vndf_transmittance"] = [](const Reals& in) { return Reals{exp(-in[0] * in[1])}; };
    all["vndf_eta_dispersed"] = [](const Reals& in) {
        const auto place = [](const Real& w) { return Real(1 / (w * w)); };
        const Real c = Real(65627) / 100, d = Real(58756) / 100, f = Real(48613) / 100;
        const Real part = (place(in[2]) - place(d)) / (place(f) - place(c));
        return Reals{in[0] + (in[0] - 1) * in[1] / 20 * part};
    };
    const auto schlick = [](const Real& c, const Real& f0, const Real& f90) {
        return Real(f0 + (f90 - f0) * pow(1 - c, 5));
    };
    all["vndf_fresnel_schlick"] = [schlick](const Reals& in) { return Reals{schlick(in[0], in[1], in[2])}; };
    all["vndf_fresnel_f82"] = [schlick](const Reals& in) {
        const Real edge = Real(1) / 7, b = schlick(edge, in[1], 1) * (1 - in[2]) / (edge * pow(1 - edge, 6));
        const Real f = schlick(in[0], in[1], 1) - b * in[0] * pow(1 - in[0], 6);
        return Reals{f > 0 ? f : Real(0)};
    };
    all["vndf_lambert_pdf_wi"] = [](const Reals& in) {
        return Reals{in[2] > 0 ? Real(in[2] / pi) : Real(0)};
    };
    all["vndf_lambert_sample_wi"] = [](const Reals& in) {
        const Real r = sqrt(in[1]);
        return list(Vec{r * cos(2 * pi * in[0]), r * sin(2 * pi * in[0]), sqrt(1 - in[1])});
    };
    all["vndf_jacobian_refract"] = [](const Reals& in) {
        const Vec wo = unit(vec(in, 0)), wi = unit(vec(in, 3));
        const Real eta = in[6];
        return Reals{jacobian(wi, [wo, eta](const Vec& w) { return unit(wo + eta * w); })};
    };
    return all;
}

// --- Points ---

struct Lobe {
    double cos_theta, phi, ax, ay;
};
// Grazing, back-facing, tiny, huge and anisotropic alpha; hardcases of the listings among them.
const Lobe lobes[] = {
    {0.5, 0.7, 0.5, 0.5}, {0.9, 0, 0.3, 0.3},        {0.1, 0.7, 1e-3, 1e-3}, {0.25, 0.7, 1, 1},
    {1, 0, 0.2, 0.6},     {1 - 1e-7, 0.7, 0.1, 0.1}, {1e-3, 2.5, 1e-4, 0.1}, {1e-7, 0.7, 2, 2},
    {0, 0.7, 0.01, 0.01}, {0.7, 4, 1e-8, 1e-8},      {0.6, 0.7, 1e-6, 1},    {0.5, 5.5, 10, 10},
};
const Lobe back_lobes[] = {
    {-0.5, 0.7, 1e-4, 1e-4}, {-1e-3, 0.7, 1e-8, 1e-8}, {-1 + 1e-7, 0.7, 0.5, 0.5}, {-0.4, 3, 0.5, 0.5},
    {-0.9, 0.7, 1e-3, 1},    {-1e-7, 0, 0.1, 0.1},     {-0.3, 0.7, 1, 2},
};
const double us[][2] = {{0.3, 0.6},     {0.4, 0.17},           {0.25, 0x1p-24}, {0.75, 1 - 0x1p-24},
                        {0x1p-32, 0.3}, {1 - 0x1p-24, 0.75},   {0.02, 0.98},    {0.999, 0.03},
                        {0.61, 0.999},  {0.125, 0.5 + 0x1p-20}};

void direction(const Lobe& l, std::vector<double>& in) {
    const double s = std::sqrt((1 - l.cos_theta) * (1 + l.cos_theta));
    in.insert(in.end(), {s * std::cos(l.phi), s * std::sin(l.phi), l.cos_theta});
}
// Where slopes of `ndf` vary: a normal of stretched slopes x, y.
void normal(const Lobe& l, double x, double y, std::vector<double>& in) {
    const double sx = l.ax * x, sy = l.ay * y, s = std::sqrt(1 + sx * sx + sy * sy);
    in.insert(in.end(), {sx / s, sy / s, 1 / s});
}

class Table {
  public:
    Table() : evaluations_(evaluations()) {
        std::cout << "function,precision,condition,pdf_condition,inputs,outputs\n";
    }

    void row(const std::string& name, const std::vector<double>& in, bool f32 = true) {
        effort = {};
        const Evaluation& f = evaluations_.at(name);
        Reals x(in.begin(), in.end());
        clamp(name, x, f32);
        const Reals out = f(x);
        for (const Real& value : out)
            if (value != 0 && !(abs(value) > Real(1e-300) && abs(value) < Real(1e300)))
                return;  // not in double
        // Too few digits are left of sigma / z - 1.
        if (name.find("_lambda") != std::string::npos && out[0] != 0 && abs(out[0]) < Real(1e-18)) return;
        const bool with_pdf = out.size() == 4, pair = name.ends_with("_both") || name.ends_with("_eval_pdf");
        const std::size_t components = std::min<std::size_t>(3, out.size());
        const Real scale = out.size() == 1 ? Real(abs(out[0])) : Real(1), pdf = with_pdf ? out[3] : Real(0);
        // Of a pair the first number's is `condition`, the second's `pdf_condition`.
        Real condition = 0, pdf_condition = 0;
        const Real step(1e-12);
        effort.quadrature = Real(1e-42), effort.residual = Real(1e-39), effort.again = true;
        for (std::size_t j = 0; j < x.size() && scale > 0; ++j) {
            // At normal incidence the sine has no derivative by the cosine.
            if (x[j] == 0 || (name.find("_slope_") != std::string::npos && j == 0 && x[j] == 1)) continue;
            Reals up = x, down = x;
            // Clear of the ends of u.
            const Real h =
                (is_u(name, j, x.size()) && 1 - x[j] < x[j] ? Real(1 - x[j]) : Real(abs(x[j]))) * step;
            up[j] += h, down[j] -= h;
            const Real per = abs(x[j]) / (2 * h);
            effort.next = 0;
            const Reals a = f(up);
            effort.next = 0;
            const Reals b = f(down);
            if (pair) {
                if (out[0] > 0) condition += abs(a[0] - b[0]) * per / out[0];
                if (out[1] > 0) pdf_condition += abs(a[1] - b[1]) * per / out[1];
                continue;
            }
            Real square = 0;
            for (std::size_t k = 0; k < components; ++k) square += (a[k] - b[k]) * (a[k] - b[k]);
            condition += sqrt(square) * per / scale;
            if (pdf > 0) pdf_condition += abs(a[3] - b[3]) * per / pdf;
        }
        std::printf("%s,%s,%.6g,%.6g,", name.c_str(), f32 ? "f32" : "f64", static_cast<double>(condition),
                    static_cast<double>(pdf_condition));
        for (std::size_t j = 0; j < in.size(); ++j) std::printf("%s%a", j ? " " : "", in[j]);
        std::printf(",");
        for (std::size_t k = 0; k < out.size(); ++k)
            std::printf("%s%s", k ? " " : "", out[k].str(50, std::ios::scientific).c_str());
        std::printf("\n");
        std::fflush(stdout);
    }

  private:
    static bool is_u(const std::string& name, std::size_t j, std::size_t n) {
        return name.find("_sample_") != std::string::npos
                   ? j + 2 >= n
                   : name.find("cdf_inverse") != std::string::npos && j == 1;
    }

    static void clamp(const std::string& name, Reals& x, bool f32) {
        const bool inverse = name.find("cdf_inverse") != std::string::npos;
        const bool sampler = name.find("_sample_") != std::string::npos;
        const std::size_t n = x.size();
        const Real low(f32 ? 0x1p-33 : 0x1p-65), high(f32 ? 1 - 0x1p-24 : 1 - 0x1p-53),
            alpha(f32 ? double(1e-8f) : 1e-8);
        const auto into = [](Real& v, const Real& lo, const Real& hi) {
            if (v < lo) v = lo;
            if (v > hi) v = hi;
        };
        if (inverse) into(x[1], low, high);
        if (!sampler) return;
        into(x[n - 1], low, high);
        into(x[n - 2], low, high);
        if (n == 2) return;  // of no lobe
        into(x[n - 3], alpha, 1e300);
        if (name.find("benyoub") == std::string::npos && name.find("isotropic") == std::string::npos)
            into(x[n - 4], alpha, 1e300);
    }

    std::map<std::string, Evaluation> evaluations_;
};

void samplers(Table& table) {
    const std::string all[] = {
        "vndf_ggx_sample_wm_heitz_deon2014",      "vndf_ggx_sample_wm_heitz_deon2014_exact",
        "vndf_ggx_sample_wm_heitz2017",           "vndf_ggx_sample_wm_heitz2018",
        "vndf_ggx_sample_wm_dupuy2023",           "vndf_ggx_sample_wi_eto2023",
        "vndf_beckmann_sample_wm_heitz_deon2014", "vndf_beckmann_sample_wm_jakob2014"};
    for (const std::string& name : all) {
        const bool upper = name == all[0] || name == all[2] || name == all[6];
        std::size_t k = 0;
        const auto add = [&](const Lobe& l) {
            std::vector<double> in;
            direction(l, in);
            in.insert(in.end(), {l.ax, l.ay, us[k % std::size(us)][0], us[k % std::size(us)][1]});
            ++k;
            // Listings that divide by the sine have no value at normal incidence.
            if (!(name == all[6] && l.cos_theta == 1)) table.row(name + "_with_pdf", in);
        };
        for (const Lobe& l : lobes) add(l);
        if (!upper)
            for (const Lobe& l : back_lobes) add(l);
    }
    const double normals[][3] = {{0, 0, 1},        {0, 0, -1}, {0.6, 0, -0.8}, {1e-3, 2e-3, -1},
                                 {0.3, -0.9, 0.1}, {0, 1, 0},  {1e-6, 0, -1}};
    std::size_t k = 0;
    for (const Lobe& l : {lobes[0], lobes[2], lobes[3], back_lobes[0], back_lobes[3], lobes[9], lobes[1],
                          lobes[6], back_lobes[4], lobes[5]}) {
        std::vector<double> in;
        direction(l, in);
        const auto& n = normals[k % std::size(normals)];
        const double length = std::sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
        for (const double c : n) in.push_back(c / length);
        in.insert(in.end(), {l.ax, us[k % std::size(us)][0], us[k % std::size(us)][1]});
        ++k;
        table.row("vndf_ggx_sample_wm_benyoub2024_with_pdf", in);
    }
    for (const char* name :
         {"vndf_ggx_sample_wm_walter2007_with_pdf", "vndf_beckmann_sample_wm_walter2007_with_pdf"})
        for (std::size_t i = 0; i < 6; ++i) table.row(name, {lobes[i].ax, lobes[i].ay, us[i][0], us[i][1]});
    // Clamps: u = 0 and 1 of either precision, alpha = 0.
    for (const bool f32 : {true, false}) {
        table.row("vndf_ggx_sample_wm_dupuy2023_with_pdf", {0.6, 0, 0.8, 0.5, 0, 0.3, 0}, f32);
        table.row("vndf_ggx_sample_wm_heitz2018_with_pdf", {0.6, 0, 0.8, 0.5, 0.5, 0.3, 1}, f32);
        table.row("vndf_beckmann_sample_wm_walter2007_with_pdf", {0.5, 0.25, 1, 0}, f32);
    }
}

void terms(Table& table) {
    for (const std::string prefix : {"vndf_ggx_", "vndf_beckmann_"}) {
        const auto each = [&](auto&& f) {
            for (const Lobe& l : lobes) f(l);
            for (const Lobe& l : back_lobes) f(l);
        };
        std::size_t k = 0;
        const double slopes[][2] = {{0.3, -0.7}, {2, 1}, {-0.01, 0.02}, {-1.5, -0.4}, {5, 0.1}};
        each([&](const Lobe& l) {
            const auto& s = slopes[k % std::size(slopes)];
            std::vector<double> w, m, wm;
            direction(l, w);
            normal(l, s[0], s[1], m);
            // A visible normal: a slope towards wo, beyond the horizon of wo where wo is behind the surface.
            const double across = std::hypot(l.ax * w[0], l.ay * w[1]),
                         ex = across > 0 ? l.ax * w[0] / across : 1,
                         ey = across > 0 ? l.ay * w[1] / across : 0;
            const double towards = l.cos_theta < 0 ? -l.cos_theta / across * 1.0001 + 0.2 : 0.5 + 0.3 * s[0];
            normal(l, towards * ex - s[1] * ey, towards * ey + s[1] * ex, wm);
            const double c = w[0] * wm[0] + w[1] * wm[1] + w[2] * wm[2];
            std::vector<double> wi;
            for (int i = 0; i < 3; ++i) wi.push_back(2 * c * wm[i] - w[i]);
            const auto join = [](std::initializer_list<std::vector<double>> parts) {
                std::vector<double> all;
                for (const auto& part : parts) all.insert(all.end(), part.begin(), part.end());
                return all;
            };
            const std::vector<double> alpha = {l.ax, l.ay};
            if (k % 4 == 0) {
                table.row(prefix + "ndf", join({m, alpha}));
                table.row(prefix + "pdf_wm_walter2007", join({m, alpha}));
                table.row(prefix + "p22", {s[0] * l.ax, s[1] * l.ay, l.ax, l.ay});
            }
            if (l.cos_theta != 0 && k % 2 == 0) table.row(prefix + "lambda", join({w, alpha}));
            if (k % 2 == 0) table.row(prefix + "sigma", join({w, alpha}));
            if (k % 5 == 0) table.row(prefix + "g1", join({w, alpha}));
            if (k % 5 == 0 && wi[2] != 0) {
                table.row(prefix + "g2", join({w, wi, alpha}));
                table.row(prefix + "g2_separable", join({w, wi, alpha}));
                table.row(prefix + "weight", join({w, wi, alpha}));
            }
            // Behind the surface a Beckmann density of small alpha is steeper than double arguments resolve.
            if (k % 3 == 0 || k % 7 == 3) {
                table.row(prefix + "pdf_wm", join({w, wm, alpha}));
                table.row(prefix + "pdf_wi", join({w, wi, alpha}));
                table.row(prefix + "eval_pdf", join({w, wi, alpha}));
                table.row(prefix + "pdf_wi_both", join({w, wi, alpha}));
                if (prefix == "vndf_ggx_") table.row(prefix + "pdf_wi_eto2023", join({w, wi, alpha}));
            }
            if (prefix == "vndf_ggx_" && k % 5 == 1) {
                const std::vector<double> n = {0, 0, 1};
                table.row("vndf_ggx_pdf_wm_benyoub2024", join({w, n, wm, {l.ax}}));
            }
            ++k;
        });
        for (const double c : {1., 0.9, 0.2, 0., -0.1, -0.8, -0.999999})
            for (const double u : {0x1p-30, 0.2, 0.9, 1 - 0x1p-20}) {
                if (u != 0.2 && c != 0.9 && c != -0.8) continue;
                table.row(prefix + "slope_cdf_inverse", {c, u});
                const double s = std::sqrt((1 - c) * (1 + c)), top = s > 0 ? c / s : 4;
                const double x = std::min(top, 4.) -
                                 (c < 0 ? 0.3 * std::max(0.1, 1 / std::max(1., -top)) : 1.3) * (2.1 - u);
                table.row(prefix + "slope_pdf", {c, x});
                table.row(prefix + "slope_cdf", {c, x});
            }
    }
    const double wo[][3] = {{0.6, 0, 0.8}, {0.8, 0, 0.6}, {0.28, 0.96, 0}, {0.36, 0.48, 0.8}};
    const double wm[][3] = {{0, 0, 1}, {0.6, 0.8, 0}, {0.48, 0.64, 0.6}};
    for (const auto& o : wo)
        for (const auto& m : wm) {
            const std::vector<double> both = {o[0], o[1], o[2], m[0], m[1], m[2]};
            const double c = o[0] * m[0] + o[1] * m[1] + o[2] * m[2];
            table.row("vndf_reflect", both);
            if (c != 0) table.row("vndf_jacobian_reflect", both);
            for (const double eta : {1.5, 0.7, 1.01}) {
                std::vector<double> in = both;
                in.push_back(eta);
                table.row("vndf_refract", in);
            }
            const double wi[][3] = {{-0.48, 0.6, -0.64}, {0, 0.6, -0.8}};
            table.row("vndf_jacobian_refract",
                      {o[0], o[1], o[2], wi[&m == wm][0], wi[&m == wm][1], wi[&m == wm][2], 1.5});
        }
}

void conic(Table& table) {
    std::size_t k = 0;
    const auto add = [&](const Lobe& l) {
        std::vector<double> w;
        direction(l, w);
        const double u1 = us[k % std::size(us)][0], u2 = us[k % std::size(us)][1];
        ++k;
        const auto join = [](std::vector<double> a, std::initializer_list<double> b) {
            a.insert(a.end(), b);
            return a;
        };
        const bool round = l.ax == l.ay && l.cos_theta == 1;  // any axes will do
        // For one alpha the bound has a kink there, and no derivative by either.
        if (l.ax != l.ay)
            table.row("vndf_ggx_sample_wi_eto2023_polygon_with_pdf", join(w, {l.ax, l.ay, u1, u2}));
        if (!round) table.row("vndf_ggx_sample_wi_conic2026_with_pdf", join(w, {l.ax, l.ay, u1, u2}));
        table.row("vndf_ggx_sample_wi_conic2026_isotropic_with_pdf", join(w, {l.ax, u1, u2}));
        table.row("vndf_ggx_sigma_visible", join(w, {l.ax, l.ay}));
        table.row("vndf_ggx_reflection_probability", join(w, {l.ax, l.ay}));
        // A reflection of this lobe.
        if (l.cos_theta <= 0 || round) return;
        const Vec wo = unit({w[0], w[1], w[2]});
        const Vec wi = conic(wo, l.ax, l.ay, Real(0.31), Real(0.38)).direction;
        const std::vector<double> row = join(
            w, {static_cast<double>(wi.x), static_cast<double>(wi.y), static_cast<double>(wi.z), l.ax, l.ay});
        table.row("vndf_ggx_pdf_wi_conic2026", row);
        table.row("vndf_ggx_pdf_wi_eto2023_polygon", row);
        if (l.cos_theta > 1e-3 && l.ax > 1e-3 && l.ay > 1e-3) table.row("vndf_ggx_invert_wi_conic2026", row);
    };
    for (const Lobe& l : lobes) add(l);
    for (const Lobe& l : back_lobes) add(l);
}

// Small and large caps about the mirror image of wo, beside it and about z.
void cones(Table& table) {
    std::size_t k = 0;
    const auto add = [&](const Lobe& l, double tilt, double omc) {
        std::vector<double> w;
        direction(l, w);
        const double up = std::abs(w[2]) + tilt, length = std::sqrt(w[0] * w[0] + w[1] * w[1] + up * up);
        w.insert(w.end(), {-w[0] / length, -w[1] / length, up / length, omc});
        const auto join = [&w](std::initializer_list<double> b) {
            std::vector<double> a = w;
            a.insert(a.end(), b);
            return a;
        };
        if (1 - omc + w[0] * w[3] + w[1] * w[4] + w[2] * w[5] < 0.02) return;  // -wo is in the cap
        const double u1 = us[k % std::size(us)][0], u2 = us[k % std::size(us)][1];
        ++k;
        table.row("vndf_ggx_sample_wi_cone2026_with_pdf", join({l.ax, l.ay, u1, u2}));
        table.row("vndf_ggx_sigma_cap", join({l.ax, l.ay}));
        if (std::min(l.ax, l.ay) > 1e-3 && omc > 1e-2 && std::abs(w[2]) + w[5] > 0.5)
            table.row("vndf_ggx_cap_mass", join({l.ax, l.ay}));
        table.row("vndf_ggx_cap_probability", join({l.ax, l.ay}));
        const Light cap = light({w[0], w[1], w[2], w[3], w[4], w[5], omc, l.ax, l.ay}, 7);
        const Vec wi = sample_cap(cap, Real(0.31), Real(0.38)).direction;
        const std::vector<double> row = join(
            {static_cast<double>(wi.x), static_cast<double>(wi.y), static_cast<double>(wi.z), l.ax, l.ay});
        table.row("vndf_ggx_pdf_wi_cone2026", row);
        if (l.cos_theta > 1e-3 && l.ax > 1e-3 && l.ay > 1e-3) table.row("vndf_ggx_invert_wi_cone2026", row);
    };
    for (const Lobe& l : lobes) {
        if (l.ax < 1e-4 || l.ay < 1e-4 || l.cos_theta > 0.99) continue;
        if (l.cos_theta > 1e-3) add(l, 0, 0.125 * l.cos_theta * l.cos_theta);
        add(l, 0.5, 0x1p-12);
        add(l, 0.25, 0x1p-5);
    }
}

// Normals tilted by 20 and 60 degrees, and polygons about the mirror image of wo, some of them through the horizon.
void tilts(Table& table) {
    std::size_t k = 0;
    for (const Lobe& l : lobes) {
        if (l.ax < 1e-2 || l.ax >= 1 || l.ay < 1e-2 || l.cos_theta > 0.99 || l.cos_theta < 0.1) continue;
        std::vector<double> w;
        direction(l, w);
        const auto join = [](std::vector<double> a, std::initializer_list<double> b) {
            a.insert(a.end(), b);
            return a;
        };
        for (const double tilt : {0.35, 1.05})
            for (const double turn : {0.4, 2.6}) {
                const double ng[] = {std::sin(tilt) * std::cos(turn), std::sin(tilt) * std::sin(turn),
                                     std::cos(tilt)};
                const std::vector<double> in = join(w, {ng[0], ng[1], ng[2]});
                const double u1 = us[k % std::size(us)][0], u2 = us[k % std::size(us)][1];
                ++k;
                table.row("vndf_ggx_sigma_tilted", join(in, {l.ax, l.ay}));
                const std::vector<double> sample = join(in, {l.ax, l.ay, u1, u2});
                table.row("vndf_ggx_sample_wi_tilted2026_with_pdf", sample);
                const Sample s = sample_tilted(about({w[0], w[1], w[2]}, {ng[0], ng[1], ng[2]}, l.ax, l.ay),
                                               Real(0.31), Real(0.38));
                if (s.pdf > 0)
                    table.row(
                        "vndf_ggx_pdf_wi_tilted2026",
                        join(in, {static_cast<double>(s.direction.x), static_cast<double>(s.direction.y),
                                  static_cast<double>(s.direction.z), l.ax, l.ay}));
                // Three and four corners around it, in turn.
                const double size = 0.3 * tilt;
                const double corners[][2] = {{1, 0.2}, {-0.3, 0.9}, {-1.1, -0.1}, {0.2, -1}};
                std::vector<double> polygon = w;
                for (const auto& c : corners) {
                    if (&c == corners + 3) table.row("vndf_ggx_triangle_mass", join(polygon, {l.ax, l.ay}));
                    polygon.insert(polygon.end(), {-w[0] + size * c[0], -w[1] + size * c[1],
                                                   w[2] + size * (c[0] * w[0] + c[1] * w[1]) / w[2]});
                }
                table.row("vndf_ggx_quad_mass", join(polygon, {l.ax, l.ay}));
            }
    }
}

void materials(Table& table) {
    for (const Lobe& l : lobes) {
        std::vector<double> in, wi;
        direction(l, in);
        direction({0.3 + l.cos_theta / 2, l.phi + 2, l.ax, l.ay}, wi);
        in.insert(in.end(), wi.begin(), wi.end());
        in.insert(in.end(), {l.ax, l.ay});
        if (l.cos_theta > 1e-3) table.row("vndf_beckmann_weight", in);
    }
    for (const double c : {1., 0.9, 0.5, 0.15, 1e-3}) {
        for (const double eta : {0.05, 0.6, 1.01, 1.5, 2.7})
            for (const double k : {0.2, 3.4}) table.row("vndf_fresnel_conductor", {c, eta, k});
        for (const double eta : {0.4, 0.75, 0.999, 1.0001, 1.5, 2.7})
            for (const char* name : {"vndf_fresnel_dielectric", "vndf_fresnel_cos_theta_t"})
                table.row(name, {c, eta});
        for (const double f0 : {0.04, 0.9})
            for (const double other : {0.1, 1.}) {
                table.row("vndf_fresnel_schlick", {c, f0, other});
                table.row("vndf_fresnel_f82", {c, f0, other});
            }
    }
    for (const double distance : {0., 1e-6, 0.3, 2., 17.})
        for (const double sigma : {0., 1e-3, 0.7, 4.}) table.row("vndf_transmittance", {distance, sigma});
    for (const double eta : {0.6, 1.01, 1.5, 2.42})
        for (const double dispersion : {0., 0.36, 2.})
            for (const double wavelength : {400., 486.13, 587.56, 656.27, 750.})
                table.row("vndf_eta_dispersed", {eta, dispersion, wavelength});
    table.row("vndf_lambert_pdf_wi", {0.6, 0, 0.8});
    table.row("vndf_lambert_pdf_wi", {0.6, 0, -0.8});
    for (const auto& u : us)
        for (const bool f32 : {true, false}) table.row("vndf_lambert_sample_wi", {u[0], u[1]}, f32);
}

// Directions about normals everywhere, their cosines, and frames.
void frames(Table& table) {
    struct Double3 {
        double x, y, z;
    };
    const auto dot_of = [](const Double3& a, const Double3& b) { return a.x * b.x + a.y * b.y + a.z * b.z; };
    const auto append = [](std::vector<double> to, std::initializer_list<Double3> vectors, double alpha) {
        for (const Double3& v : vectors) to.insert(to.end(), {v.x, v.y, v.z});
        if (alpha > 0) to.push_back(alpha);
        return to;
    };
    const double normals[][3] = {{0, 0, 1},        {0, 0, -1}, {0.6, 0, -0.8}, {0.36, -0.48, 0.8},
                                 {0.3, -0.9, 0.1}, {0, 1, 0},  {1e-6, 0, -1},  {-0.5, 0.5, -1e-9}};
    const double slopes[][2] = {{0.3, -0.7}, {2, 1}, {-0.01, 0.02}, {-1.5, -0.4}, {0.6, 0.1}};
    std::size_t k = 0;
    for (const Lobe& l :
         {lobes[0], lobes[3], lobes[2], back_lobes[3], lobes[1], lobes[11], back_lobes[2], lobes[4]}) {
        const auto& given = normals[k % std::size(normals)];
        const auto& s = slopes[k % std::size(slopes)];
        const double size = std::sqrt(given[0] * given[0] + given[1] * given[1] + given[2] * given[2]);
        const Double3 n{given[0] / size, given[1] / size, given[2] / size};
        // The half turn about n + z or n - z.
        const double sign = n.z < 0 ? -1 : 1;
        const auto turned = [&](const std::vector<double>& w) {
            const double share = (n.x * w[0] + n.y * w[1] + (n.z + sign) * w[2]) / (1 + sign * n.z);
            return Double3{share * n.x - w[0], share * n.y - w[1], share * (n.z + sign) - w[2]};
        };
        std::vector<double> o, m;
        direction(l, o);
        const double across = std::hypot(o[0], o[1]), ex = across > 0 ? o[0] / across : 1,
                     ey = across > 0 ? o[1] / across : 0;
        const double towards =
            l.cos_theta < 0 ? -l.cos_theta / (l.ax * across) * 1.0001 + 0.2 : 0.5 + 0.3 * s[0];
        normal({l.cos_theta, l.phi, l.ax, l.ax}, towards * ex - s[1] * ey, towards * ey + s[1] * ex, m);
        const Double3 wo = turned(o), wm = turned(m), t = turned({1, 0, 0});
        const double c = dot_of(wo, wm);
        const Double3 wi{2 * c * wm.x - wo.x, 2 * c * wm.y - wo.y, 2 * c * wm.z - wo.z};
        const double cos_o = dot_of(wo, n), cos_m = dot_of(wm, n), cos_i = dot_of(wi, n);
        for (const std::string prefix : {"vndf_ggx_", "vndf_beckmann_"}) {
            for (const char* kind : {"_world", "_cosines"}) {
                const bool world = kind[1] == 'w';
                const auto one = [&](const Double3& w, double cosine) {
                    return world ? append({}, {w, n}, l.ax) : std::vector<double>{cosine, l.ax};
                };
                const auto row = [&](const char* term, const std::vector<double>& in) {
                    table.row(prefix + term + kind, in);
                };
                // Of a cosine next to 1 nothing is left of the angle.
                if (world || std::abs(cos_m) < 1 - 1e-9) row("ndf", one(wm, cos_m));
                if (!world && std::abs(cos_o) > 1 - 1e-9) continue;
                for (const char* term : {"lambda", "sigma", "g1"}) row(term, one(wo, cos_o));
                const std::vector<double> two =
                    world ? append({}, {wo, n, wi}, l.ax) : std::vector<double>{cos_o, cos_i, l.ax};
                for (const char* term : {"g2", "weight"}) row(term, two);
                if (!world && std::abs(cos_m) > 1 - 1e-9) continue;
                row("pdf_wm",
                    world ? append({}, {wo, n, wm}, l.ax) : std::vector<double>{cos_o, cos_m, c, l.ax});
                row("pdf_wi", world ? two : std::vector<double>{cos_o, cos_m, l.ax});
            }
        }
        if (k < 3) {
            std::vector<double> in = o;
            in.insert(in.end(), {m[0], m[1], m[2], 0.4, 0.6});
            table.row("vndf_beckmann_weight", in);
        }
        table.row("vndf_tangent", append({}, {n}, 0));
        if (across > 1e-3) table.row("vndf_tangent_along", append({}, {n, wo}, 0));
        table.row("vndf_to_local", append({}, {wo, n, t}, 0));
        table.row("vndf_to_world", append({}, {{o[0], o[1], o[2]}, n, t}, 0));
        ++k;
    }
}

}  // namespace

int main(int argc, char** argv) {
    const std::string part = argc > 1 ? argv[1] : "";
    Table table;
    if (part.empty() || part == "samplers") samplers(table);
    if (part.empty() || part == "terms") terms(table);
    if (part.empty() || part == "conic") conic(table);
    if (part.empty() || part == "materials") materials(table);
    if (part.empty() || part == "frames") frames(table);
    if (part.empty() || part == "cones") cones(table);
    if (part.empty() || part == "tilts") tilts(table);
}
