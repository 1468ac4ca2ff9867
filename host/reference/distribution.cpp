// Pivots, moments, bins and rules: integrals of the density in stretched space (stretched.h has its formulas).
#include "reference/distribution.h"

#include <algorithm>
#include <boost/math/quadrature/gauss.hpp>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "reference/terms.h"

namespace vndf::reference {
namespace {

constexpr double pi_d = boost::math::constants::pi<double>();
constexpr double root_pi = boost::math::constants::root_pi<double>();

struct Known {
    std::string_view sampler;
    bool beckmann, walter, world, reflected;
};
constexpr Known known[] = {
    {"vndf_ggx_sample_wm_heitz_deon2014", false, false, false, false},
    {"vndf_ggx_sample_wm_heitz_deon2014_exact", false, false, false, false},
    {"vndf_ggx_sample_wm_heitz2017", false, false, false, false},
    {"vndf_ggx_sample_wm_heitz2018", false, false, false, false},
    {"vndf_ggx_sample_wm_dupuy2023", false, false, false, false},
    {"vndf_ggx_sample_wm_benyoub2024", false, false, true, false},
    {"vndf_ggx_sample_wi_eto2023", false, false, false, true},
    {"vndf_ggx_sample_wm_walter2007", false, true, false, false},
    {"vndf_beckmann_sample_wm_heitz_deon2014", true, false, false, false},
    {"vndf_beckmann_sample_wm_jakob2014", true, false, false, false},
    {"vndf_beckmann_sample_wm_walter2007", true, true, false, false},
};

Vec3d plain(const Vec3<double>& v) {
    return {v.x, v.y, v.z};
}

Vec3d rotated(const std::array<Vec3d, 3>& rows, double x, double y, double z) {
    const auto row = [&](const Vec3d& r) { return r.x * x + r.y * y + r.z * z; };
    return {row(rows[0]), row(rows[1]), row(rows[2])};
}

double clip(double p) {
    return p > 0 ? p < 1 ? p : 1 : 0;  // NaN: 0
}

// The Gaussian's tail (roots.h) to about 1e-9, for pivots.
GaussianTail<double> quick_tail(double y) {
    if (y < 2) {
        const double mass = std::exp(y * y) * std::erfc(y);
        return {mass, 1 / root_pi - y * mass};
    }
    int n = static_cast<int>(4 + 90 / (y * y));
    double k = (std::sqrt(y * y + 2 * n) - y) / 2;
    for (; n > 1; --n) k = 0.5 * n / (y + k);
    k = 0.5 / (y + k);
    const double mass = 1 / (root_pi * (y + k));
    return {mass, k * mass};
}

// n-point Gauss-Legendre on [a, b].
template <unsigned n, class F>
void gauss(double a, double b, F f) {
    using Rule = boost::math::quadrature::gauss<double, n>;
    const double middle = (a + b) / 2, half = (b - a) / 2;
    for (std::size_t i = 0; i < Rule::abscissa().size(); ++i) {
        const double x = Rule::abscissa()[i], w = Rule::weights()[i] * half;
        f(middle + half * x, w);
        if (x != 0) f(middle - half * x, w);
    }
}

// The same on equal panels no wider than `width`.
template <unsigned n, class F>
void panels(double a, double b, double width, F f) {
    const int count = std::max(1, static_cast<int>(std::ceil((b - a) / width)));
    for (int i = 0; i < count; ++i) gauss<n>(a + (b - a) * i / count, a + (b - a) * (i + 1) / count, f);
}

// Nodes x = a + (b - a) / (1 + e^-s) on equal steps of s. A layer of any width at an end is a singularity at
// the imaginary distance pi / 2 in s: the error falls as e^(-pi^2 / step), whatever the width.
template <class F>
void logistic(double a, double b, double step, double reach, F f) {
    const int count = static_cast<int>(reach / step);
    for (int i = -count; i <= count; ++i) {
        const double e = std::exp(-std::abs(i * step)), near = (b - a) * e / (1 + e);
        f(i < 0 ? a + near : b - near, step * near / (1 + e));
    }
}

}  // namespace

Distribution::Distribution(std::string_view sampler, const double* in, Precision precision)
    : precision_(precision) {
    constexpr std::string_view suffix = "_with_pdf";
    if (sampler.size() > suffix.size() && sampler.substr(sampler.size() - suffix.size()) == suffix)
        sampler.remove_suffix(suffix.size());
    const auto at = std::find_if(std::begin(known), std::end(known),
                                 [&](const Known& k) { return k.sampler == sampler; });
    if (at == std::end(known)) throw std::invalid_argument("no distribution for " + std::string(sampler));
    sampler_ = at->sampler;
    in_.assign(in, in + (at->walter ? 4 : at->world ? 9 : 7));
    reflected_ = at->reflected;
    world_ = at->world;

    const double* alpha = in + (at->walter ? 0 : at->world ? 6 : 3);
    const auto raised = [&](double a) {
        return std::max(a, precision == Precision::f32 ? double(1e-8f) : 1e-8);
    };
    alpha_x_ = raised(alpha[0]);
    alpha_y_ = raised(alpha[at->world ? 0 : 1]);

    // The plain NDF times the cosine is what a view along the normal sees.
    Vec3<double> wo = at->walter ? Vec3<double>{0, 0, 1} : normalised<double>({in[0], in[1], in[2]});
    Frame<double> f{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    if (world_) {
        f = frame(normalised<double>({in[3], in[4], in[5]}));
        wo = to_local(f, wo);
    }
    frame_ = {plain(f.t1), plain(f.t2), plain(f.n)};
    wo_ = plain(wo);

    const View<double> v = view(wo, alpha_x_, alpha_y_);
    ex_ = v.ex, ey_ = v.ey, length_ = v.length, sin_ = v.sin_theta, cos_ = v.cos_theta;
    sigma_ = std::pow(std::sin(v.nu / 2), 2);
    tan_half_ = std::sin(v.theta / 2) / std::sin(v.nu / 2);
    kind_ = at->beckmann ? Kind::beckmann : reflected_ && wo.z > 0 ? Kind::bounded : Kind::ggx;
    const Slopes<double> s = beckmann_slopes(v.sin_theta, v.cos_theta);
    a_ = s.a, weight_ = s.weight;
    const Bound<double> b = bound(alpha_x_, alpha_y_, hypotenuse(wo.x, wo.y), wo.z);
    k_ = b.k, gap_ = b.gap, cap_ = (1 + k_ * cos_) / 2;
}

// The direction, or the half vector of a reflected one, in the local frame, of any length.
inline Vec3d Distribution::half(double x, double y, double z) const {
    if (world_) return rotated(frame_, x, y, z);
    if (!reflected_) return {x, y, z};
    const double rcp = 1 / std::sqrt(x * x + y * y + z * z);  // of a rounded unit vector
    return {wo_.x + x * rcp, wo_.y + y * rcp, wo_.z + z * rcp};
}

// --- Pivots ----------------------------------------------------------------------------------------------------

// GGX: F(beta) and the semicircle's distribution function of t. Beckmann: the distribution functions of the two
// slopes. Bounded: azimuth and height of the stretched reflection, uniform on its cap.
template <class T, Distribution::Kind kind>
void Distribution::pivots_of(std::size_t n, const T* x, const T* y, const T* z, double* p1,
                             double* p2) const {
    const double rcp_x = 1 / alpha_x_, rcp_y = 1 / alpha_y_;
    for (std::size_t i = 0; i < n; ++i) {
        const Vec3d m = half(x[i], y[i], z[i]);
        const double gx = m.x * rcp_x, gy = m.y * rcp_y, gz = m.z;
        if constexpr (kind == Kind::bounded) {
            // o = 2 (m . v) m - v with v the stretched wo, wo . h = |h|^2 / 2
            const double s = (m.x * m.x + m.y * m.y + m.z * m.z) / ((gx * gx + gy * gy + gz * gz) * length_);
            const double ox = s * gx - sin_ * ex_, oy = s * gy - sin_ * ey_;
            const double turn = std::atan2(oy, ox) / (2 * pi_d);
            p1[i] = clip(turn < 0 ? turn + 1 : turn);
            p2[i] = clip((1 + cos_ - s * gz) / (2 * cap_));
        } else {
            const double ge = gx * ex_ + gy * ey_, gp = gy * ex_ - gx * ey_;
            if constexpr (kind == Kind::ggx) {
                const double slice = std::sqrt(ge * ge + gz * gz), square = slice * slice + gp * gp;
                const double cosine = slice > 0 ? ge / slice : 1, sine = slice > 0 ? gz / slice : 0;
                // Half of beta; F = 1 - (cos(beta / 2) - tan(theta / 2) sin(beta / 2))^2.
                const double large = std::sqrt(0.5 * (1 + std::abs(cosine))), small = 0.5 * sine / large;
                const double c = cosine > 0 ? large : std::abs(small),
                             s = cosine > 0 ? small : std::copysign(large, sine);
                const double rest = c - tan_half_ * s;
                p1[i] = clip(rest > 0 ? 1 - rest * rest : 1);
                p2[i] = clip(0.5 + (std::atan2(gp, slice) + gp * slice / square) / pi_d);
            } else {
                const bool up = gz > 0;
                const double sx = up ? -ge / gz : std::copysign(1e300, -ge),
                             sy = up ? -gp / gz : std::copysign(1e300, -gp);
                p2[i] = clip(0.5 * std::erfc(-sy));
                if (sx >= a_) {
                    p1[i] = 1;
                } else if (a_ < 0) {
                    const auto tail = quick_tail(-sx);
                    const double d = a_ - sx;
                    p1[i] = clip(std::exp(-d * (d - 2 * a_)) * (d * tail.mass + tail.first) / weight_);
                } else {
                    p1[i] = clip((a_ * std::erfc(-sx) + std::exp(-sx * sx) / root_pi) / weight_);
                }
            }
        }
    }
}

template <class T>
void Distribution::pivots(std::size_t n, const T* x, const T* y, const T* z, double* p1, double* p2) const {
    switch (kind_) {
        case Kind::ggx:
            return pivots_of<T, Kind::ggx>(n, x, y, z, p1, p2);
        case Kind::bounded:
            return pivots_of<T, Kind::bounded>(n, x, y, z, p1, p2);
        case Kind::beckmann:
            return pivots_of<T, Kind::beckmann>(n, x, y, z, p1, p2);
    }
}
template void Distribution::pivots(std::size_t, const float*, const float*, const float*, double*,
                                   double*) const;
template void Distribution::pivots(std::size_t, const double*, const double*, const double*, double*,
                                   double*) const;

double Distribution::pivot_rounding() const {
    const auto evaluate = find_evaluation<double>(sampler_);
    double worst = 0;
    for (const double u1 : {0.2, 0.5, 0.8})
        for (const double u2 : {0.2, 0.5, 0.8}) {
            std::vector<double> in = in_;
            in[in.size() - 2] = u1, in[in.size() - 1] = u2;
            double d[3], p[2], q[2];
            evaluate(in.data(), d, precision_);
            pivots(1, &d[0], &d[1], &d[2], &p[0], &p[1]);
            for (int i = 0; i < 3; ++i) {
                const double exact = d[i];
                d[i] += exact * 0x1p-24;
                pivots(1, &d[0], &d[1], &d[2], &q[0], &q[1]);
                d[i] = exact;
                for (int j = 0; j < 2; ++j) {
                    const double change = std::abs(p[j] - q[j]);
                    worst = std::max(
                        worst, kind_ == Kind::bounded && j == 0 ? std::min(change, 1 - change) : change);
                }
            }
        }
    return worst;
}

// --- Histogram of directions -----------------------------------------------------------------------------------

template <class T>
void Distribution::angles(std::size_t n, const T* x, const T* y, const T* z, double* theta,
                          double* phi) const {
    for (std::size_t i = 0; i < n; ++i) {
        const Vec3d m = half(x[i], y[i], z[i]);
        theta[i] = std::atan2(std::sqrt(m.x * m.x + m.y * m.y), m.z);
        const double azimuth = std::atan2(m.y, m.x);
        phi[i] = azimuth < 0 ? azimuth + 2 * pi_d : azimuth;
    }
}
template void Distribution::angles(std::size_t, const float*, const float*, const float*, double*,
                                   double*) const;
template void Distribution::angles(std::size_t, const double*, const double*, const double*, double*,
                                   double*) const;

namespace {

// n + 1 ascending edges from `first` to `last` with about equal numbers of the values in between.
std::vector<double> quantile_edges(std::vector<double> values, std::size_t n, double first, double last) {
    std::sort(values.begin(), values.end());
    std::vector<double> edges{first};
    for (std::size_t i = 1; i < n; ++i) {
        // Between two values, so that an edge is no value that many directions share.
        const std::size_t at = values.size() * i / n;
        const double edge = (values[at - 1] + values[at]) / 2;
        const double least = (last - first) * 1e-12;
        edges.push_back(std::max(edge, edges.back() + least));
    }
    edges.push_back(last);
    return edges;
}

}  // namespace

Bins Distribution::bins(std::size_t n_theta, std::size_t n_phi) const {
    const auto evaluate = find_evaluation<double>(sampler_);
    std::vector<double> in = in_, thetas, phis;
    // About opposite to e, where behind the surface nothing is visible, but not in a plane of symmetry; azimuths
    // as angles() counts them.
    double start = std::atan2(-ey_, -ex_) + 1e-3;
    if (start < 0) start += 2 * pi_d;
    constexpr int count = 8192;
    for (int i = 0; i < count; ++i) {  // the plastic number's low-discrepancy sequence
        in[in.size() - 2] = std::fmod(0.5 + 0.7548776662466927 * i, 1);
        in[in.size() - 1] = std::fmod(0.5 + 0.5698402909980532 * i, 1);
        double d[3], theta, phi;
        evaluate(in.data(), d, precision_);
        angles(1, &d[0], &d[1], &d[2], &theta, &phi);
        thetas.push_back(theta);
        phis.push_back(phi < start ? phi + 2 * pi_d : phi);
    }
    return {quantile_edges(thetas, n_theta, 0, pi_d), quantile_edges(phis, n_phi, start, start + 2 * pi_d)};
}

// In stretched polar slopes: m ~ (r cos(phi), r sin(phi), 1), the density of (r, phi) is
// (sin r cos(phi - phi_e) + cos) r P22(r) / sigma where the bracket is positive.
struct Distribution::Range {
    double lo, hi;
    double slope;  // sin cos(phi - phi_e)
    double turn;   // tan(phi - phi_e)
};

// What the density is divided by. (Beckmann behind the surface: without e^(-a^2).)
double Distribution::normaliser() const {
    if (kind_ == Kind::bounded) return cap_;
    if (kind_ == Kind::ggx) return sigma_;
    return a_ > 1e6 ? 1 : sin_ * weight_ / 2;
}

Distribution::Range Distribution::range(double phi) const {
    const double infinity = std::numeric_limits<double>::infinity();
    const double c = std::cos(phi), s = std::sin(phi);
    const double cos_turn = c * ex_ + s * ey_, turn = (s * ex_ - c * ey_) / cos_turn, slope = sin_ * cos_turn;
    if (kind_ == Kind::bounded) {
        // 2 (slope r + cos) / (1 + r^2) > (1 - k) cos: r below the positive root
        const double root = std::sqrt(slope * slope + gap_ * (1 + k_) * cos_ * cos_);
        const double hi = slope > 0 ? (slope + root) / (gap_ * cos_) : (1 + k_) * cos_ / (root - slope);
        return {0, hi, slope, turn};
    }
    if (cos_ >= 0) return {0, slope < 0 ? cos_ / -slope : infinity, slope, turn};
    return {slope > 0 ? -cos_ / slope : infinity, infinity, slope, turn};
}

// Per unit of phi, the mass at polar angles below each of the given ones (ascending).
void Distribution::cumulative(double phi, const std::vector<double>& tan_theta, double* mass) const {
    const Range in = range(phi);
    const double ax = alpha_x_ * std::cos(phi), ay = alpha_y_ * std::sin(phi);
    const double unstretch = 1 / std::sqrt(ax * ax + ay * ay), scale = 1 / (pi_d * normaliser());
    const bool behind = cos_ < 0;
    // The integral from 0 to r, or behind the surface from r to infinity, where nothing cancels.
    const auto ggx = [&](double r) {
        if (behind) return (cos_ / (1 + r * r) + in.slope * (std::atan(1 / r) + r / (1 + r * r))) / 2;
        const double part = r < 1e100 ? r / (1 + r * r) : 0;
        return (cos_ * (r < 1e100 ? part * r : 1) +
                in.slope * (r < 1e-3 ? r * r * r * (2. / 3 - 0.8 * r * r) : std::atan(r) - part)) /
               2;
    };
    const auto beckmann = [&](double r) {
        if (behind) {
            // lo = |a| / cos(turn): e^(a^2 - r^2) (cos + slope (sqrt(pi) / 2 mass(r) + r)) / 2, cos = -slope lo
            return std::exp((in.lo - r) * (in.lo + r) - in.turn * a_ * (in.turn * a_)) * in.slope *
                   ((r - in.lo) + root_pi / 2 * quick_tail(r).mass) / 2;
        }
        const double e = std::exp(-r * r);
        return (cos_ * -std::expm1(-r * r) + in.slope * (root_pi / 2 * std::erf(r) - (e > 0 ? r * e : 0))) /
               2;
    };
    const auto integral = [&](double r) { return kind_ == Kind::beckmann ? beckmann(r) : ggx(r); };
    if (!(in.lo < in.hi)) {
        std::fill(mass, mass + tan_theta.size(), 0);
        return;
    }
    const double start = behind ? integral(in.lo) : 0;
    for (std::size_t i = 0; i < tan_theta.size(); ++i) {
        const double r = std::min(tan_theta[i] * unstretch, in.hi);
        if (!(r > in.lo))
            mass[i] = 0;
        else if (behind)
            mass[i] = scale * (start - (std::isinf(r) ? 0 : integral(r)));
        else
            mass[i] = scale * integral(std::min(r, 1e150));
    }
}

namespace {

// Adds the integrals of the vector function f over [a, b] to `sums`; panels are halved until they agree.
template <class F>
void integrate(const F& f, double a, double b, double tolerance, std::vector<double>& sums, int depth = 0) {
    const std::size_t n = sums.size();
    std::vector<double> whole(n), parts(n), value(n);
    const auto add_to = [&](std::vector<double>& total) {
        return [&](double x, double w) {
            f(x, value.data());
            for (std::size_t i = 0; i < n; ++i) total[i] += w * value[i];
        };
    };
    gauss<10>(a, b, add_to(whole));
    gauss<10>(a, (a + b) / 2, add_to(parts));
    gauss<10>((a + b) / 2, b, add_to(parts));
    double off = 0;
    for (std::size_t i = 0; i < n; ++i) off = std::max(off, std::abs(whole[i] - parts[i]));
    if (off < tolerance || depth > 40) {
        for (std::size_t i = 0; i < n; ++i) sums[i] += parts[i];
    } else {
        integrate(f, a, (a + b) / 2, tolerance, sums, depth + 1);
        integrate(f, (a + b) / 2, b, tolerance, sums, depth + 1);
    }
}

}  // namespace

// Stretched azimuths in [-pi, 3 pi] near which the density or its unstretching may change fast or switch: the
// axes, e, and the directions across it, approached in steps by factors of 4.
std::vector<double> Distribution::azimuth_breaks() const {
    std::vector<double> breaks;
    const double e = std::atan2(ey_, ex_);
    const auto around = [&](double centre, int steps) {
        breaks.push_back(centre);
        double d = pi_d / 4;
        for (int j = 0; j < steps; ++j, d /= 4) breaks.insert(breaks.end(), {centre - d, centre + d});
    };
    for (int i = -2; i <= 6; ++i) {
        around(i * pi_d / 2, 8);
        around(e + i * pi_d / 2, i % 2 == 0 ? 14 : 8);
    }
    std::sort(breaks.begin(), breaks.end());
    return breaks;
}

std::vector<double> Distribution::bin_probabilities(const Bins& bins) const {
    const std::size_t n_theta = bins.theta.size() - 1, n_phi = bins.phi.size() - 1;
    std::vector<double> tangents;
    for (const double theta : bins.theta)
        tangents.push_back(theta < pi_d / 2 ? std::tan(theta) : std::numeric_limits<double>::infinity());
    // A monotone map of the azimuth, quadrant by quadrant.
    const auto stretched = [&](double phi) {
        const double azimuth = std::atan2(std::sin(phi) / alpha_y_, std::cos(phi) / alpha_x_);
        return azimuth + 2 * pi_d * std::round((phi - azimuth) / (2 * pi_d));
    };
    const std::vector<double> breaks = azimuth_breaks();
    std::vector<double> result(n_theta * n_phi);
    const auto f = [&](double phi, double* mass) { cumulative(phi, tangents, mass); };
    for (std::size_t j = 0; j < n_phi; ++j) {
        const double a = stretched(bins.phi[j]), b = stretched(bins.phi[j + 1]);
        std::vector<double> sums(tangents.size()), edges{a};
        for (const double x : breaks)
            if (x > a && x < b) edges.push_back(x);
        edges.push_back(b);
        for (std::size_t i = 0; i + 1 < edges.size(); ++i)
            if (edges[i] < edges[i + 1]) integrate(f, edges[i], edges[i + 1], 1e-10, sums);
        for (std::size_t i = 0; i < n_theta; ++i) result[i * n_phi + j] = std::max(0., sums[i + 1] - sums[i]);
    }
    return result;
}

// --- Quadrature ------------------------------------------------------------------------------------------------

// A normal of slopes, its share of the stretched solid angle and of the probability.
struct Distribution::Node {
    double x, y;  // stretched slopes of the normal (x, y, 1)
    double area;  // dx dy
    double probability;
};

// dm = dx dy m_z^3 in stretched space; unstretching and reflecting bring their Jacobians.
void Distribution::add(const Node& node, QuadratureRule& rule) const {
    double x = alpha_x_ * node.x, y = alpha_y_ * node.y;
    const double length = std::sqrt(1 + x * x + y * y);
    x /= length, y /= length;
    double z = 1 / length, weight = node.area * alpha_x_ * alpha_y_ * z * z * z;
    if (reflected_) {
        const double cosine = wo_.x * x + wo_.y * y + wo_.z * z;
        weight *= 4 * std::abs(cosine);
        x = 2 * cosine * x - wo_.x, y = 2 * cosine * y - wo_.y, z = 2 * cosine * z - wo_.z;
    }
    const std::array<Vec3d, 3>& f = frame_;
    rule.x.push_back(world_ ? f[0].x * x + f[1].x * y + f[2].x * z : x);
    rule.y.push_back(world_ ? f[0].y * x + f[1].y * y + f[2].y * z : y);
    rule.z.push_back(world_ ? f[0].z * x + f[1].z * y + f[2].z * z : z);
    rule.weight.push_back(weight);
    rule.probability.push_back(node.probability);
}

// GGX: polar slopes, the length by its logarithm, in which both the density and unstretching vary over a distance
// of order 1; the azimuth between its breaks.
void Distribution::add_polar_nodes(QuadratureRule& rule, bool fine) const {
    const double tail = fine ? 26 : 20, head = fine ? 13 : 10, width = fine ? 2 : 3;
    const double scale = 1 / (pi_d * normaliser());
    std::vector<double> breaks;
    const double e = std::atan2(ey_, ex_);
    for (int i = -4; i <= 8; ++i)
        for (const double x : {i * pi_d / 2, e + i * pi_d / 2})
            if (x >= -1e-12 && x <= 2 * pi_d + 1e-12) breaks.push_back(x);
    std::sort(breaks.begin(), breaks.end());
    for (std::size_t i = 0; i + 1 < breaks.size(); ++i) {
        if (!(breaks[i + 1] - breaks[i] > 1e-13)) continue;
        logistic(breaks[i], breaks[i + 1], fine ? 0.42 : 0.55, fine ? 23 : 18,
                 [&](double phi, double weight) {
                     const Range in = range(phi);
                     if (!(weight > 0) || !(in.lo < in.hi) || !(in.lo < 1e100)) return;
                     const double c = std::cos(phi), s = std::sin(phi);
                     const double lo = in.lo > 0 ? std::log(in.lo) : std::min(0., std::log(in.hi)) - head;
                     const double hi = std::min(std::log(in.hi), std::max(0., lo) + tail);
                     const auto add_node = [&](double log_r, double w) {
                         const double r = std::exp(log_r), q = 1 + r * r;
                         const double area = weight * w * r * r;
                         const double cosine = in.lo > 0 ? in.slope * (r - in.lo) : in.slope * r + cos_;
                         add({r * c, r * s, area, area * scale * std::max(0., cosine) / (q * q)}, rule);
                     };
                     panels<10>(lo, hi, width, add_node);
                 });
    }
}

// Beckmann: the slopes along and across e, a product.
void Distribution::add_slope_nodes(QuadratureRule& rule, bool fine) const {
    const double reach = fine ? 6.2 : 5, square = reach * reach, alpha = std::max({alpha_x_, alpha_y_, 1.});
    const double width = std::max((fine ? 1.2 : 1.6) / alpha, 2 * reach / 80);
    const double from = a_ < 0 ? square / (std::sqrt(a_ * a_ + square) - a_) : std::min(a_, reach) + reach;
    const Slopes<double> s{a_, weight_};
    panels<10>(0, from, a_ < 0 ? from / 6 : width, [&](double down, double weight_x) {
        const double top = std::min(a_, reach);
        const Slope<double> at =
            a_ < reach ? Slope<double>{a_ - down, down} : Slope<double>{top - down, a_ - top + down};
        const double p_x = beckmann_slope_pdf(s, at) * weight_x;
        panels<10>(-reach, reach, width, [&](double y, double weight_y) {
            const double p = p_x * weight_y * std::exp(-y * y) / root_pi;
            add({-(at.x * ex_ - y * ey_), -(at.x * ey_ + y * ex_), weight_x * weight_y, p}, rule);
        });
    });
}

QuadratureRule Distribution::rule(bool fine) const {
    QuadratureRule rule;
    if (kind_ == Kind::beckmann)
        add_slope_nodes(rule, fine);
    else
        add_polar_nodes(rule, fine);
    return rule;
}

Moments Distribution::moments() const {
    const QuadratureRule nodes = rule(true);
    const Vec3d seen = sampler_.find("walter2007") != std::string::npos ? Vec3d{0, 0, 1}
                       : world_                                         ? Vec3d{in_[0], in_[1], in_[2]}
                                                                        : wo_;
    const auto quantities = [&](std::size_t i) {
        const double x = nodes.x[i], y = nodes.y[i], z = nodes.z[i];
        return std::array<double, Moments::count>{
            x, y, z, x * x, y * y, z * z, x * y, x * z, y * z, x * seen.x + y * seen.y + z * seen.z};
    };
    Moments m;
    for (std::size_t i = 0; i < nodes.size(); ++i) {
        const auto q = quantities(i);
        for (int k = 0; k < Moments::count; ++k) m.mean[k] += nodes.probability[i] * q[k];
    }
    for (std::size_t i = 0; i < nodes.size(); ++i) {
        const auto q = quantities(i);
        for (int k = 0; k < Moments::count; ++k)
            m.variance[k] += nodes.probability[i] * (q[k] - m.mean[k]) * (q[k] - m.mean[k]);
    }
    return m;
}

}  // namespace vndf::reference
