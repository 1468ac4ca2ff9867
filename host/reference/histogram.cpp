// The histogram of directions: bins and the density integrated over them.
#include <limits>

#include "reference/integrals.h"

namespace vndf::reference {

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
    std::vector<double> thetas, phis;
    // About opposite to e, where behind the surface nothing is visible, but not in a plane of symmetry; azimuths
    // as angles() counts them.
    double start = std::atan2(-ey_, -ex_) + 1e-3;
    if (start < 0) start += 2 * pi_d;
    constexpr int count = 8192;
    for (int i = 0; i < count; ++i) {  // the plastic number's low-discrepancy sequence
        double theta, phi;
        const std::array<double, 3> d =
            draw(std::fmod(0.5 + 0.7548776662466927 * i, 1), std::fmod(0.5 + 0.5698402909980532 * i, 1));
        if (is_lost(d)) continue;
        angles(1, &d[0], &d[1], &d[2], &theta, &phi);
        thetas.push_back(theta);
        phis.push_back(phi < start ? phi + 2 * pi_d : phi);
    }
    return {quantile_edges(thetas, n_theta, 0, pi_d), quantile_edges(phis, n_phi, start, start + 2 * pi_d)};
}

// What the density is divided by. (Beckmann behind the surface: without e^(-a^2).)
double Distribution::normaliser() const {
    switch (kind_) {
        case Kind::bounded:
        case Kind::conic:
        case Kind::cone:
        case Kind::lune:
            return cap_;
        case Kind::ggx:
            return sigma_;
        case Kind::beckmann:
            return a_ > 1e6 ? 1 : sin_ * weight_ / 2;
    }
    return std::numeric_limits<double>::quiet_NaN();
}

Distribution::Range Distribution::range(double phi) const {
    const double infinity = std::numeric_limits<double>::infinity();
    const double c = std::cos(phi), s = std::sin(phi);
    const double cos_turn = c * ex_ + s * ey_, turn = (s * ex_ - c * ey_) / cos_turn, slope = sin_ * cos_turn;
    if (kind_ == Kind::cone) return cone_range(c, s, slope, turn);
    if (kind_ == Kind::lune) return lune_range(c, s, slope, turn);
    if (kind_ == Kind::bounded || kind_ == Kind::conic) {
        // 2 (slope r + cos) > (1 - k) cos (1 + r^2), or cos (1 + |alpha r|^2): r below the positive root
        const double gap =
            kind_ == Kind::bounded ? gap_ : alpha_x_ * c * (alpha_x_ * c) + alpha_y_ * s * (alpha_y_ * s);
        const double root = std::sqrt(slope * slope + gap * (1 + k_) * cos_ * cos_);
        const double hi = slope > 0 ? (slope + root) / (gap * cos_) : (1 + k_) * cos_ / (root - slope);
        return {0, hi, slope, turn};
    }
    if (cos_ >= 0) return {0, slope < 0 ? cos_ / -slope : infinity, slope, turn};
    return {slope > 0 ? -cos_ / slope : infinity, infinity, slope, turn};
}

// The integral of the GGX density over r from 0, but for its normaliser, at a stretched azimuth.
static double ggx_polar_mass(double cosine, double slope, double r) {
    const double part = r < 1e100 ? r / (1 + r * r) : 0;
    return (cosine * (r < 1e100 ? part * r : 1) +
            slope * (r < 1e-3 ? r * r * r * (2. / 3 - 0.8 * r * r) : std::atan(r) - part)) /
           2;
}

// The same from r to infinity, where nothing cancels for large r.
static double ggx_polar_rest(double cosine, double slope, double r) {
    return (cosine / (1 + r * r) + slope * (std::atan(1 / r) + r / (1 + r * r))) / 2;
}
double Distribution::polar_mass(double slope, double from, double to) const {
    if (from > 1) return ggx_polar_rest(cos_, slope, from) - ggx_polar_rest(cos_, slope, to);
    return ggx_polar_mass(cos_, slope, to) - ggx_polar_mass(cos_, slope, from);
}

// Between the roots of the cone's form a r^2 + 2 b r + c > 0, a < 0.
Distribution::Range Distribution::cone_range(double c, double s, double slope, double turn) const {
    const double a = c * c * q_[0][0] + 2 * c * s * q_[0][1] + s * s * q_[1][1],
                 b = c * q_[0][2] + s * q_[1][2];
    const double square = b * b - a * q_[2][2];
    if (!(square > 0)) return {0, 0, slope, turn};
    const double sum = b + std::copysign(std::sqrt(square), b), first = -sum / a, second = -q_[2][2] / sum;
    return {std::max(0., std::min(first, second)), std::max(0., std::max(first, second)), slope, turn};
}

// The form of ng between its roots or beyond one of them, whichever faces wo, and what is above the horizon and faces wo: a
// convex cone of normals, an interval at each azimuth.
Distribution::Range Distribution::lune_range(double c, double s, double slope, double turn) const {
    const double infinity = std::numeric_limits<double>::infinity();
    const double a = c * c * q_[0][0] + 2 * c * s * q_[0][1] + s * s * q_[1][1],
                 b = c * q_[0][2] + s * q_[1][2], at_pole = q_[2][2];
    double lo = 0, hi = infinity;
    const double square = b * b - a * at_pole;
    if (square > 0) {
        const double sum = b + std::copysign(std::sqrt(square), b), x = -sum / a, y = -at_pole / sum;
        if (a < 0)
            lo = std::min(x, y), hi = std::max(x, y);
        else if (slope > 0)
            lo = std::max(x, y);
        else
            hi = std::min(x, y);
    } else if (a < 0) {
        return {0, 0, slope, turn};
    }
    // Facing wo, and, from the front, above the horizon: 2 (slope r + cos) > cos (1 + |alpha r|^2).
    if (slope < 0) hi = std::min(hi, -cos_ / slope);
    if (cos_ < 0) lo = slope > 0 ? std::max(lo, -cos_ / slope) : infinity;
    if (cos_ > 0) {
        const double stretch = alpha_x_ * c * (alpha_x_ * c) + alpha_y_ * s * (alpha_y_ * s);
        const double root = std::sqrt(slope * slope + stretch * cos_ * cos_);
        hi = std::min(hi, slope > 0 ? (slope + root) / (stretch * cos_) : cos_ / (root - slope));
    }
    lo = std::max(lo, 0.), hi = std::min(hi, 1e150);  // whose square is finite
    return lo < hi ? Range{lo, hi, slope, turn} : Range{0, 0, slope, turn};
}

// Conic, cone, lune: the part of the mass at this stretched azimuth with stretched slopes shorter than `tangent`.
double Distribution::share_below(double phi, double tangent) const {
    const Range in = range(phi);
    const double whole = polar_mass(in.slope, in.lo, in.hi);
    return whole > 0 ? polar_mass(in.slope, in.lo, std::clamp(tangent, in.lo, in.hi)) / whole : 0;
}

// Per unit of phi, the mass at polar angles below each of the given ones (ascending).
void Distribution::cumulative(double phi, const std::vector<double>& tan_theta, double* mass) const {
    const Range in = range(phi);
    const double ax = alpha_x_ * std::cos(phi), ay = alpha_y_ * std::sin(phi);
    const double unstretch = 1 / std::sqrt(ax * ax + ay * ay), scale = 1 / (pi_d * normaliser());
    const bool behind = cos_ < 0 && !by_form();
    // The integral from 0 to r, or behind the surface from r to infinity, where nothing cancels.
    const auto ggx = [&](double r) {
        if (by_form()) return polar_mass(in.slope, in.lo, r);
        return behind ? ggx_polar_rest(cos_, in.slope, r) : ggx_polar_mass(cos_, in.slope, r);
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
    const auto integral = [&](double r) {
        switch (ndf_of(kind_)) {
            case Ndf::ggx:
                return ggx(r);
            case Ndf::beckmann:
                return beckmann(r);
        }
        return std::numeric_limits<double>::quiet_NaN();
    };
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
        if (by_form()) around(middle_ + i * pi_d / 2, 14);
    }
    for (const double turn : {-2 * pi_d, 0., 2 * pi_d}) {
        if (kind_ == Kind::lune)
            for (const double corner : corners_) around(corner + turn, 8);
        if (half_ > 0)
            for (int j = -8; j <= 8; ++j) breaks.push_back(middle_ + turn + half_ * std::sin(j * pi_d / 16));
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
        // Behind the surface a Beckmann lobe is a ridge, as thin as 1 / a^2, along which both angles go together: it
        // may leave a bin through a corner so close to its end that only panels graded towards it notice.
        if (kind_ == Kind::beckmann && cos_ < 0)
            for (double d = (b - a) / 8; d > 1e-7 * (b - a); d /= 8)
                edges.insert(edges.end(), {a + d, b - d});
        edges.push_back(b);
        std::sort(edges.begin(), edges.end());
        for (std::size_t i = 0; i + 1 < edges.size(); ++i)
            if (edges[i] < edges[i + 1]) integrate(f, edges[i], edges[i + 1], 1e-10, sums);
        for (std::size_t i = 0; i < n_theta; ++i) result[i * n_phi + j] = std::max(0., sums[i + 1] - sums[i]);
    }
    return result;
}

}  // namespace vndf::reference
