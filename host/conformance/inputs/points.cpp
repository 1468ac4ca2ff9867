#include "conformance/inputs/points.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <stdexcept>
#include <string>

#include "splitmix64.h"

namespace vndf::conformance {
namespace {

double dot(const Direction& a, const Direction& b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

Direction normalised(Direction a) {
    const double length = std::sqrt(dot(a, a));
    return {a[0] / length, a[1] / length, a[2] / length};
}

// `local` in a right-handed frame whose z axis is the unit vector n. The half turn about n + z maps z to n;
// for n.z < 0 the one about n - z, after a turn about x, keeps the frame well conditioned.
Direction to_frame(const Direction& n, Direction local) {
    const double sign = n[2] < 0 ? -1 : 1;
    if (sign < 0) local = {local[0], -local[1], -local[2]};
    const Direction axis = normalised({n[0], n[1], n[2] + sign});
    const double twice = 2 * dot(axis, local);
    return {twice * axis[0] - local[0], twice * axis[1] - local[1], twice * axis[2] - local[2]};
}

// cos and sin of a moderate angle by + - * / alone: mathematical libraries disagree about last bits, and points must be
// the same everywhere (digest.h). Taylor series about the nearest quarter turn, up to x^17; the rest is below 2^-54.
std::array<double, 2> circle_point(double phi) {
    constexpr double quarter = 1.57079632679489661923, quarter_rest = 6.123233995736766036e-17;
    const double turns = std::nearbyint(phi / quarter);
    const double x = (phi - turns * quarter) - turns * quarter_rest;
    double c = 1, s = 1;
    for (int k = 16; k > 0; k -= 2) {
        c = 1 - x * x / ((k - 1) * k) * c;
        s = 1 - x * x / (k * (k + 1)) * s;
    }
    s *= x;
    switch (static_cast<int>(turns) & 3) {
        case 0:
            return {c, s};
        case 1:
            return {-s, c};
        case 2:
            return {-c, -s};
        default:
            return {s, -c};
    }
}

}  // namespace

Direction direction(double cos_theta, double phi) {
    if (std::abs(cos_theta) == 1) return {0, 0, cos_theta};  // +0, whatever the azimuth
    const double sin_theta = std::sqrt((1 - cos_theta) * (1 + cos_theta));
    const auto [x, y] = circle_point(phi);
    return {sin_theta * x, sin_theta * y, cos_theta};
}

Direction cross(const Direction& a, const Direction& b) {
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

namespace {

// Directions of a point's own, the same from every compiler.
class Draws {
  public:
    Draws(const Point& point, std::uint64_t seed) : random_(of(point, seed)) {}

    double uniform() { return random_.uniform(); }
    std::uint64_t bits() { return random_.bits(); }
    Direction anywhere() {
        const double azimuth = 6.28318530717958648 * uniform();  // compilers take arguments in any order
        return direction(2 * uniform() - 1, azimuth);
    }
    Direction about(const Direction& centre, double by) {
        const Direction off = anywhere();
        return normalised({centre[0] + by * off[0], centre[1] + by * off[1], centre[2] + by * off[2]});
    }

  private:
    static std::uint64_t of(const Point& point, std::uint64_t seed) {
        for (const double x : {point.wo[0], point.wo[2], point.wi[0], point.wi[2], point.alpha[0],
                               point.alpha[1], point.u[0], point.u[1]})
            seed = SplitMix64(seed ^ std::bit_cast<std::uint64_t>(x)).bits();
        return seed;
    }
    SplitMix64 random_;
};

}  // namespace

void place_cap(Point& point, bool contained) {
    Draws random(point, contained);
    const Direction& o = point.wo;
    const int half = static_cast<int>(random.bits() % 8), exponent = static_cast<int>(random.bits() % 24);
    double size = half == 0 ? 1 : std::ldexp(1 + random.uniform(), contained ? -exponent / 2 : -exponent);
    const double chord = std::sqrt(2 * size);
    switch (random.bits() % 8) {
        case 0:
            point.l = {-o[0], -o[1], o[2]};
            break;
        case 1:
            point.l = random.anywhere();
            break;
        case 2:
            point.l = {0, 0, 1};
            break;
        case 3:
            point.l = random.about({-o[0], -o[1], -o[2]}, chord);
            break;
        default:
            point.l = random.about(point.wi, chord * random.uniform());
    }
    if (contained) {
        // theta_o + theta_l + beta < pi, where that leaves room for a cap; else about z.
        const auto room = [&o](const Direction& l) {
            const double across = std::sqrt((o[0] * o[0] + o[1] * o[1]) * (l[0] * l[0] + l[1] * l[1]));
            return o[2] + l[2] > 0 ? 1 + o[2] * l[2] - across : 0;
        };
        if (room(point.l) < 0.05) point.l = {0, 0, 1};
        size = std::min(size, 0.9 * room(point.l));
    }
    point.one_minus_cos = size;
}

void place_tilt(Point& point, bool contained) {
    Draws random(point, contained ? 3 : 2);
    const Direction& o = point.wo;
    const auto kind = random.bits() % 16;
    const int down = static_cast<int>(random.bits() % (contained ? 4 : 20));
    const double by = std::ldexp(1 + random.uniform(), -down);
    const Direction off = random.anywhere();
    switch (kind) {
        case 0:
            point.ng = {0, 0, 1};
            break;
        case 1:
            point.ng = {0, 0, -1};
            break;
        case 2:
            point.ng = normalised({off[0], off[1], 0});
            break;
        case 3:
            point.ng = normalised(cross(o, off));
            break;
        case 4:
            point.ng = random.about({-o[0], -o[1], -o[2]}, by);
            break;
        case 5:
        case 6:
        case 7:
            point.ng = off;
            break;
        default:
            point.ng = random.about({0, 0, 1}, by);
    }
    if (!contained) return;
    // wo above it, and room above both.
    const double length = std::sqrt(dot(o, o)), along = dot(o, point.ng) / length;
    if (!(along > 0.02) || !(point.ng[2] > -0.9)) point.ng = o[2] > 0 ? Direction{0, 0, 1} : o;
}

void place_polygon(Point& point) {
    Draws random(point, 4);
    const Direction& o = point.wo;
    const int down = static_cast<int>(random.bits() % 16);
    const double size = std::ldexp(1 + random.uniform(), -down);
    Direction centre = random.about(point.wi, size);
    switch (random.bits() % 8) {
        case 0:
            centre = random.anywhere();
            break;
        case 1:
            centre = normalised({centre[0], centre[1], 0});
            break;
        case 2:
            centre = {-o[0], -o[1], o[2]};
            break;
        case 3:
            centre = o;
            break;
    }
    // Two vectors across it.
    const Direction off = random.anywhere();
    const Direction u = normalised(cross(centre, off)), v = cross(centre, u);
    const double flat = random.bits() % 16 == 0 ? 0 : 1, turned = random.bits() % 2 ? 1 : -1;
    // Points of a circle are in convex position.
    for (std::size_t k = 0; k < 4; ++k) {
        const auto [c, s] =
            circle_point(1.57079632679489662 * (static_cast<double>(k) + 0.9 * random.uniform()));
        for (int j = 0; j < 3; ++j)
            point.polygon[k][j] = centre[j] + 2 * size * (c * u[j] + flat * turned * s * v[j]);
        point.polygon[k] = normalised(point.polygon[k]);
    }
}

Point make_point(const Direction& wo, std::array<double, 2> alpha, Stretched normal, const Direction& n,
                 std::array<double, 2> u, double eta) {
    Point point;
    point.alpha = alpha;
    point.u = u;
    point.eta = eta;
    point.cos_theta = wo[2];
    const Direction h = direction(normal.cos_theta, normal.phi);
    const Direction wm = normalised({alpha[0] * h[0], alpha[1] * h[1], h[2]});
    const double twice = 2 * dot(wo, wm);
    const Direction wi{twice * wm[0] - wo[0], twice * wm[1] - wo[1], twice * wm[2] - wo[2]};
    point.slope = {-wm[0] / wm[2], -wm[1] / wm[2]};
    point.x = -h[0] / h[2];
    point.cos_theta_m = wm[2], point.cos_theta_i = wi[2], point.wo_dot_wm = twice / 2;
    const bool local = n == Direction{0, 0, 1};
    point.n = n;
    if (!local) point.t = to_frame(n, {1, 0, 0});
    point.wo = local ? wo : to_frame(n, wo);
    point.wm = local ? wm : to_frame(n, wm);
    point.wi = local ? wi : to_frame(n, wi);
    place_cap(point, false);
    place_tilt(point, false);
    place_polygon(point);
    return point;
}

int column(const Function& function, std::string_view name) {
    const auto found = std::find(function.inputs.begin(), function.inputs.end(), name);
    return found == function.inputs.end() ? -1 : static_cast<int>(found - function.inputs.begin());
}

double Point::scalar(std::string_view name) const {
    const auto component = [&](std::string_view prefix, const auto& values) -> const double* {
        if (name.size() != prefix.size() + 2 || name.substr(0, prefix.size()) != prefix) return nullptr;
        const std::size_t i = static_cast<std::size_t>(name.back() - 'x');
        return name[prefix.size()] == '_' && i < values.size() ? &values[i] : nullptr;
    };
    for (const auto& [prefix, values] : {std::pair<std::string_view, const Direction*>{"wo", &wo},
                                         {"n", &n},
                                         {"wm", &wm},
                                         {"wi", &wi},
                                         {"t", &t},
                                         {"l", &l},
                                         {"ng", &ng},
                                         {"a", &polygon[0]},
                                         {"b", &polygon[1]},
                                         {"c", &polygon[2]},
                                         {"d", &polygon[3]},
                                         {"w", &wo}})
        if (const double* value = component(prefix, *values)) return *value;
    if (const double* value = component("alpha", alpha)) return *value;
    if (const double* value = component("slope", slope)) return *value;
    for (const auto& [known, value] : {std::pair<std::string_view, double>{"alpha", alpha[0]},
                                       {"u1", u[0]},
                                       {"u2", u[1]},
                                       {"eta", eta},
                                       {"one_minus_cos", one_minus_cos},
                                       {"k", std::abs(x)},
                                       {"f0", u[0]},
                                       {"f90", u[1]},
                                       {"tint", u[1]},
                                       {"distance", std::abs(x)},
                                       {"sigma", alpha[0]},
                                       {"dispersion", 2 * u[0]},
                                       {"wavelength", 380 + 350 * u[1]},
                                       {"cos_theta", cos_theta},
                                       {"cos_theta_o", cos_theta},
                                       {"cos_theta_i", cos_theta_i},
                                       {"cos_theta_m", cos_theta_m},
                                       {"wo_dot_wm", wo_dot_wm},
                                       {"x", x}})
        if (name == known) return value;
    throw std::invalid_argument("no grid for the argument " + std::string(name));
}

std::vector<double> Table::row(std::size_t i) const {
    std::vector<double> result;
    for (const std::vector<double>& values : columns) result.push_back(values[i]);
    return result;
}

Table tabulate(const Function& function, const std::vector<Point>& points, runtime::Real real) {
    Table table;
    for (const std::string& name : function.inputs) {
        std::vector<double>& values = table.columns.emplace_back();
        values.reserve(points.size());
        for (const Point& point : points) {
            values.push_back(rounded(point.scalar(name), real));
        }
    }
    return table;
}

}  // namespace vndf::conformance
