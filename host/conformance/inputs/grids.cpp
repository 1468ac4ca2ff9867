#include "conformance/inputs/grids.h"

#include <algorithm>
#include <cmath>
#include <random>
#include <set>
#include <string>

namespace vndf::conformance {
namespace {

constexpr double pi = 3.14159265358979323846;

bool uses(const Function& function, std::initializer_list<std::string_view> names) {
    return std::any_of(names.begin(), names.end(),
                       [&](std::string_view name) { return column(function, name) >= 0; });
}

bool uses_wo(const Function& function) {
    return uses(function, {"wo_x", "w_x", "cos_theta", "cos_theta_o"});
}
bool uses_normal(const Function& function) {
    return uses(function, {"wm_x", "wi_x", "slope_x", "x", "k", "distance", "cos_theta_i", "cos_theta_m"});
}

// For functions of (wo, wi, eta): every other wi becomes the refracted direction where there is one.
void refract_some(const Function& function, std::vector<Point>& points) {
    if (!uses(function, {"eta"}) || !uses(function, {"wi_x"})) return;
    for (std::size_t i = 0; i < points.size(); i += 2) {
        const Direction &o = points[i].wo, &m = points[i].wm;
        const double eta = points[i].eta, c = o[0] * m[0] + o[1] * m[1] + o[2] * m[2];
        const double square = eta * eta - (1 - c) * (1 + c);  // (eta cos_t)^2
        if (!(c > 0) || !(square > 0)) continue;
        const double along = (c - std::sqrt(square)) / eta;
        for (int k = 0; k < 3; ++k) points[i].wi[k] = along * m[k] - o[k] / eta;
    }
}

// Points without repetitions in the function's own arguments (Walter's samplers have no wo, for instance).
std::vector<Point> distinct(const Function& function, const std::vector<Point>& points) {
    std::vector<Point> result;
    std::set<std::vector<double>> seen;
    for (const Point& point : points) {
        std::vector<double> row;
        for (const std::string& name : function.inputs) row.push_back(point.scalar(name));
        if (seen.insert(row).second) result.push_back(point);
    }
    return result;
}

const std::vector<std::array<double, 2>>& lobe_alphas() {
    static const std::vector<std::array<double, 2>> alphas{
        {0.5, 0.5}, {1, 0.001}, {0.0001, 0.0001}, {0.1, 0.1}, {0.6, 0.2},     {0.01, 0.01},
        {2, 2},     {1, 1},     {0.001, 1},       {0.3, 0.3}, {0.001, 0.001}, {0.0001, 0.1},
    };
    return alphas;
}

const std::vector<Direction>& lobe_axes() {
    static const std::vector<Direction> axes{
        {0, 0, 1},  direction(-0.9, 0.3),    direction(0, 1.1),
        {0, 0, -1}, direction(-1 + 1e-4, 2), direction(0.4, -2),
    };
    return axes;
}

}  // namespace

std::vector<Point> lobes(const Function& function, bool quick) {
    const std::vector<double> azimuths{0.7, 0, -2.2, 1.9};
    const bool world = uses(function, {"n_x"});
    std::vector<Point> points;
    for (std::size_t row = 0; row < lobe_alphas().size(); ++row) {
        std::vector<double> cosines{1, 0.9, 0.5, 0.1, 0.001};
        if (function.domain == Domain::sphere) cosines.push_back(row % 2 ? -0.001 : -0.5);
        for (std::size_t i = 0; i < cosines.size(); ++i) {
            const Direction wo = direction(cosines[i], azimuths[(row + i) % azimuths.size()]);
            const Direction n = world ? lobe_axes()[(row + i) % lobe_axes().size()] : Direction{0, 0, 1};
            points.push_back(make_point(wo, lobe_alphas()[row], {1, 0}, n, {0.5, 0.5}, 1.5));
        }
    }
    for (Point& point : points) place_cap(point, true), place_tilt(point, true);
    points = distinct(function, points);
    if (!quick) return points;
    const std::size_t stride = points.size() / 12;  // one for each alpha, through the angles in turn
    std::vector<Point> some;
    for (std::size_t i = 0; i < 12; ++i) some.push_back(points[i * stride + i % stride]);
    return some;
}

std::vector<Point> hard_points(const Function& function) {
    const std::vector<std::array<double, 2>> alphas{{1e-8, 1e-8}, {1e-6, 1e-6}, {1e-4, 1e-4}, {1e-3, 1e-3},
                                                    {.01, .01},   {.1, .1},     {.5, .5},     {1, 1},
                                                    {2, 2},       {10, 10},     {1e3, 1e3},   {1e-6, 1},
                                                    {1, 1e-6},    {1e-3, 1e3},  {1e-4, .1},   {.2, .6}};
    const std::vector<double> cosines{1,    1 - 1e-7, .9,    .5,    .1,  1e-3, 1e-5,
                                      1e-7, 0,        -1e-7, -1e-3, -.5, -.99, -1 + 1e-7};
    const std::vector<double> u{0x1p-32, 0x1p-24, .25, .5, .75, 1 - 0x1p-24};
    const std::vector<Stretched> normals{{1, 0},     {1 - 1e-7, 1}, {.999, 4}, {.9, 2},   {.7, .7},
                                         {.5, -1},   {.5, 2.5},     {.1, 3},   {.1, -.3}, {1e-3, 5},
                                         {1e-3, .7}, {1e-5, 1.5},   {1e-7, -2}};
    std::vector<Direction> axes{{0, 0, 1}};
    if (uses(function, {"n_x"}))
        axes = {{0, 0, 1},
                direction(0, 1.3),
                direction(-.9, .4),
                direction(-1 + 1e-4, -1),
                direction(-1 + 1e-6, 2.2),
                {0, 0, -1}};
    const std::vector<double> etas{1.5, 1 / 1.5, 1.01, 1.0001, 2.4, 0.4};

    std::vector<std::array<double, 2>> pairs;
    for (const double u1 : u)
        for (const double u2 : u) pairs.push_back({u1, u2});
    if (!uses(function, {"u1", "u2", "f0"})) pairs = {{.5, .5}};
    std::vector<Direction> directions;
    for (const double phi : {0.7, 0.0}) {
        if (phi == 0 && axes.size() > 1) continue;  // six axes make up for it
        for (const double cos_theta : cosines) directions.push_back(direction(cos_theta, phi));
    }

    std::vector<Point> points;
    for (const auto& alpha : alphas)
        for (const Direction& wo : uses_wo(function) ? directions : std::vector<Direction>{{0, 0, 1}})
            for (const Direction& n : axes)
                for (const Stretched& normal :
                     uses_normal(function) ? normals : std::vector<Stretched>{{1, 0}})
                    for (const auto& pair : pairs)
                        points.push_back(
                            make_point(wo, alpha, normal, n, pair, etas[points.size() % etas.size()]));
    refract_some(function, points);
    return distinct(function, points);
}

namespace {

// Alpha below 1e-8, u at 0 and 1; normals on the horizon; and view directions so near the axis that squares of their
// stretched components leave the range of float.
std::vector<Point> clamped_points(const Function& function) {
    const std::vector<std::array<double, 2>> alphas{{0, 0},        {0, .5},      {.5, 0},
                                                    {1e-9, 1e-30}, {1e-8, 1e-8}, {.5, .5}};
    std::vector<Stretched> normals{{.9, 2}, {.1, 3}};
    if (!uses(function, {"slope_x", "x"})) normals.push_back({0, 1});
    std::vector<Direction> directions{{1e-21, -3e-22, 1}, {2e-18, 1e-18, -1}};
    for (const double cos_theta : {.9, .1, 1e-3, -.5}) directions.push_back(direction(cos_theta, .7));
    const std::vector<double> u{0, .4, 1};

    std::vector<Point> points;
    for (const auto& alpha : alphas)
        for (const Direction& wo : directions)
            for (const Stretched& normal : normals) {
                if (normal.cos_theta == 0 && alpha[0] + alpha[1] == 0) continue;  // no direction
                for (const double u1 : u)
                    for (const double u2 : u)
                        points.push_back(make_point(wo, alpha, normal, {0, 0, 1}, {u1, u2}, 1.5));
            }
    return points;
}

// Samples next to the silhouette: the last values of one u, where the azimuth by the other is opposite to wo's (either
// way round: world-space maps turn it by half), to the nearest numbers.
std::vector<Point> silhouette_points(const Direction& n) {
    constexpr double azimuth = .7, turn = azimuth / 6.28318530717958648;
    std::vector<Point> points;
    for (const double alpha : {1e-4, 1e-2, .5, 1., 2.})
        for (const double cos_theta : {.9, .5, .1, 1e-3, -.5})
            for (const double last : {0x1p-24, 0x1p-23, 0x1p-20, 0x1p-16})
                for (const double u : {turn, turn + .5})
                    for (int ulps = -2; ulps <= 2; ++ulps) {
                        const Direction wo = direction(cos_theta, azimuth);
                        const double near = u + ulps * 0x1p-24;
                        points.push_back(make_point(wo, {alpha, alpha}, {1, 0}, n, {near, 1 - last}, 1.5));
                        points.push_back(make_point(wo, {alpha, alpha}, {1, 0}, n, {1 - last, near}, 1.5));
                    }
    // Along an axis, stretched a thousand times: the half vector keeps the sign of its cosine with wo only if both terms
    // of the cosine are right to their last bits.
    for (const double cos_theta : {.95, .9, .8, .6, .5, .3, .1})
        for (int last = 1; last <= 16; ++last)
            for (const double u : {0., .5})
                points.push_back(make_point(direction(cos_theta, 0), {1e3, 1e-8}, {1, 0}, n,
                                            {u, 1 - last * 0x1p-24}, 1.5));
    return points;
}

// Samples next to the rim of their cap, all round it: the last values of u2 (of conic2026: of the distance to the rim). What
// rounding does to them, their separate density must forgive, in every quadrant.
std::vector<Point> rim_points() {
    std::vector<Point> points;
    for (const auto& alpha : {std::array{.1, .1}, {.02, .02}, {.05, .6}, {.4, .03}})
        for (const double cos_theta : {.9, .4, .15, .05})
            for (const double azimuth : {.4, 2., -2.7, -1.})
                for (int part = 0; part < 24; ++part)
                    for (int last = 0; last < 3; ++last)
                        points.push_back(make_point(direction(cos_theta, azimuth), alpha, {1, 0}, {0, 0, 1},
                                                    {(part + .37) / 24, 1 - last * 0x1p-24}, 1.5));
    return points;
}

// Reflections back to where wo came from, whose half vectors face away from wo, by less than rounding shows.
std::vector<Point> returning_points() {
    std::vector<Point> points;
    for (const double alpha : {1e-6, 2e-6, 1e-5})
        for (const auto& pair : {std::array{alpha, alpha}, {alpha, 2 * alpha}, {3 * alpha, alpha}})
            for (const double a : {.7, 1., 1.5, 2., 3., 4.})
                for (const double height : {1e-5, 3e-5, 1e-4})
                    for (const double azimuth : {0., .7, 1.7, -1.2, 3.}) {
                        Point point = make_point(direction(-a * alpha, azimuth), pair, {1, 0}, {0, 0, 1},
                                                 {.5, .5}, 1.5);
                        point.wi = {-point.wo[0], -point.wo[1], height};
                        points.push_back(point);
                    }
    return points;
}

// Grazing view directions whose stretched cosine is lost in 1 +- a unit, of float and of double, with the last values of u:
// quotients of such a cosine and such a rest are any number (2017: the turn of the tangent half disk).
std::vector<Point> grazing_points() {
    std::vector<Point> points;
    for (const double unit : {0x1p-24, 0x1p-53})
        for (const double alpha : {1e-3, .5})
            for (const double cosine : {.5, 1., 1.1, 1.5})
                for (int last = 1; last <= 4; ++last)
                    for (const double u : {.2, .8, 1.})
                        points.push_back(make_point(direction(cosine * unit * alpha, .7), {alpha, alpha},
                                                    {1, 0}, {0, 0, 1}, {u, 1 - last * unit}, 1.5));
    return points;
}

// A view direction from just behind the horizon, with the last values of u2 all round: heights of normals are all but 0.
std::vector<Point> horizon_points() {
    std::vector<Point> points;
    for (int part = 0; part < 24; ++part)
        for (const double last : {0x1p-24, 0x1p-22})
            points.push_back(make_point(direction(-1e-20, .7), {1e-4, .1}, {1, 0}, {0, 0, 1},
                                        {(part + .37) / 24, 1 - last}, 1.5));
    return points;
}

// Indices of refraction next to 1, where refraction goes straight on and the half vector wo + eta wi is all but nothing:
// refracted rays (refract_some) and, beside each, the way back of wo but for a few last bits, of float and of double.
std::vector<Point> straight_points() {
    std::vector<Point> points;
    for (const double step : {0., 0x1p-53, 0x1p-52, 0x1p-40, 0x1p-24, 0x1p-23, 0x1p-20, 0x1p-12, 1e-4})
        for (const double eta : {1 + step, 1 - step})
            for (const double cos_theta : {1., .9, .5, 1e-3})
                for (const Stretched& normal : {Stretched{1, 0}, {.9, 2}, {.5, -1}, {.01, 3}})
                    for (const double bit : {0x1p-23, 0x1p-52}) {
                        Point point =
                            make_point(direction(cos_theta, .7), {.5, .5}, normal, {0, 0, 1}, {.5, .5}, eta);
                        points.push_back(point);
                        for (int k = 0; k < 3; ++k)
                            point.wi[k] =
                                -point.wo[k] * (1 + bit * static_cast<double>((points.size() >> k) % 5 - 2));
                        points.push_back(point);
                    }
    return points;
}

// Next to total reflection, on either side: eta is the sine of the angle between wo and wm, but for a small part.
std::vector<Point> critical_points() {
    std::vector<Point> points;
    for (const double cos_theta : {.9, .5, .1})
        for (const Stretched& normal : {Stretched{.95, 2}, {.7, .7}, {.5, -1}})
            for (const double part : {1e-2, 1e-4, 1e-5, 1e-6, 2e-7, -2e-7, -1e-6, -1e-4}) {
                Point point =
                    make_point(direction(cos_theta, .7), {.5, .8}, normal, {0, 0, 1}, {.5, .5}, 1.5);
                const double c =
                    point.wo[0] * point.wm[0] + point.wo[1] * point.wm[1] + point.wo[2] * point.wm[2];
                point.cos_theta = c;
                point.eta = std::sqrt((1 - c) * (1 + c)) * (1 + part);
                points.push_back(point);
            }
    return points;
}

// Slopes next to 0, where formulas for either sign meet.
std::vector<Point> level_points() {
    std::vector<Point> points;
    for (const double cos_theta : {1., .9, .5, .1, 1e-3, 0., -1e-3, -.5})
        for (const double x : {1e-4, 1e-6, 1e-7, 1e-9, -1e-9, -1e-7, -1e-6, -1e-4}) {
            Point point = make_point(direction(cos_theta, .7), {.5, .8}, {1, 0}, {0, 0, 1}, {.5, .5}, 1.5);
            point.x = x, point.slope = {x, -x};
            points.push_back(point);
        }
    return points;
}

// Of Beckmann's slopes in the plane of incidence some that are next to the edge a, with a u2 as far as the rounding of a from
// where the map of 2014 turns them around.
std::vector<Point> folded_points() {
    std::vector<Point> points;
    for (int k = 0; k < 12; ++k)
        for (const double rounding : {-1.2e-7, -7e-8, 7e-8, 1.2e-7}) {
            const double alpha = .5, last = 0x1p-20, a = .52 + .02 * k, cot = a * alpha;
            const double area = (a * (1 + std::erf(a)) + std::exp(-a * a) / std::sqrt(pi)) / 2;
            const double gap = std::sqrt(pi) * last * area / a * std::exp(a * a);
            points.push_back(make_point(direction(cot / std::sqrt(1 + cot * cot), .7), {alpha, alpha}, {1, 0},
                                        {0, 0, 1}, {1 - last, (gap + rounding) / (2 * a)}, 1.5));
        }
    return points;
}

}  // namespace

std::vector<Point> guard_points(const Function& function) {
    std::vector<Point> points = clamped_points(function);
    if (uses(function, {"eta"}) && uses(function, {"wm_x", "cos_theta"}) && !uses(function, {"k"}))
        for (const Point& point : critical_points()) points.push_back(point);
    if (uses(function, {"x", "slope_x"}))
        for (const Point& point : level_points()) points.push_back(point);
    if (uses(function, {"wi_x"}))
        for (const Point& point : returning_points()) points.push_back(point);
    std::vector<Direction> axes{{0, 0, 1}};
    if (uses(function, {"n_x"})) axes = {{0, 0, 1}, direction(.4, -2), direction(-.9, .4)};
    if (uses(function, {"u1"}))
        for (const Direction& n : axes)
            for (const auto& some : {silhouette_points(n), grazing_points(), horizon_points()})
                points.insert(points.end(), some.begin(), some.end());
    if (function.kind == Kind::sampler && function.ndf == Ndf::beckmann)
        for (const Point& point : folded_points()) points.push_back(point);
    if (function.kind == Kind::sampler && function.result == "WI")
        for (const Point& point : rim_points()) points.push_back(point);
    if (uses(function, {"eta"})) {
        std::vector<Point> straight = straight_points();
        refract_some(function, straight);
        points.insert(points.end(), straight.begin(), straight.end());
    }
    return distinct(function, points);
}

namespace {

// Random numbers whose sequence is the same with every standard library.
class Random {
  public:
    explicit Random(std::uint64_t seed) : engine_(seed) {}
    double uniform() { return static_cast<double>(engine_() >> 11) * 0x1p-53; }
    double uniform(double low, double high) { return low + (high - low) * uniform(); }
    double log_uniform(double low, double high) { return std::exp(uniform(std::log(low), std::log(high))); }
    bool chance(double probability) { return uniform() < probability; }

    // Some within any distance of 1, down to the last bit of double.
    double eta() {
        if (!chance(0.2)) return uniform(0.4, 2.5);
        const double side = uniform(-1, 1);
        return 1 + std::copysign(std::exp2(-1 - 52 * std::abs(side)), side);
    }
    double cosine() {
        const double sign = chance(0.3) ? -1 : 1;
        if (chance(0.1)) return sign * (1 - log_uniform(1e-7, 1));  // towards the pole
        return sign * (chance(0.2) ? log_uniform(1e-7, 1) : uniform());
    }
    double alpha() { return chance(0.05) ? log_uniform(1e-8, 1e3) : log_uniform(1e-4, 2); }
    // Most u uniform, some in the tails (down to the clamps of float).
    double u() {
        if (chance(0.9)) return uniform();
        return chance(0.5) ? log_uniform(0x1p-33, 1) : 1 - log_uniform(0x1p-24, 1);
    }
    Stretched normal() {
        const double phi = uniform(-pi, pi);
        if (chance(0.1)) return {log_uniform(1e-6, 1), phi};
        return {std::sqrt(1 - uniform()), phi};  // cosine-weighted, the distribution of GGX itself
    }

  private:
    std::mt19937_64 engine_;
};

}  // namespace

std::vector<Point> random_points(const Function& function, std::size_t count, std::uint64_t seed) {
    Random random(seed);
    const bool world = uses(function, {"n_x"});
    std::vector<Point> points;
    points.reserve(count);
    while (points.size() < count) {
        const Direction wo = direction(random.cosine(), random.uniform(-pi, pi));
        const double alpha = random.alpha();
        const double other = random.chance(0.4) ? alpha : random.alpha();
        const Direction n = world ? direction(random.cosine(), random.uniform(-pi, pi)) : Direction{0, 0, 1};
        const Stretched normal = random.normal();
        const std::array<double, 2> u{random.u(), random.u()};
        const double eta = random.eta();
        points.push_back(make_point(wo, {alpha, world ? alpha : other}, normal, n, u, eta));
        // The bounds of samplers hold for |wo| within 2^-10 of 1.
        if (function.kind == Kind::sampler && points.size() % 16 == 0)
            for (double& x : points.back().wo) x *= points.size() % 32 == 0 ? 1 - 0x1p-10 : 1 + 0x1p-10;
    }
    refract_some(function, points);
    return points;
}

std::vector<Point> renderer_points(const Function& function, std::size_t count, std::uint64_t seed) {
    Random random(seed);
    const bool world = uses(function, {"n_x"});
    std::vector<Point> points;
    points.reserve(count);
    while (points.size() < count) {
        const double height = random.chance(0.3) ? random.log_uniform(1e-2, 1) : random.uniform(1e-2, 1);
        const double side = random.chance(0.3) && function.domain == Domain::sphere ? -1 : 1;
        const Direction wo = direction(side * height, random.uniform(-pi, pi));
        const double alpha = random.log_uniform(1e-3, 10);
        const double other = world || random.chance(0.4) ? alpha : random.log_uniform(1e-3, 10);
        const Direction n = world ? direction(random.cosine(), random.uniform(-pi, pi)) : Direction{0, 0, 1};
        const Stretched normal = random.normal();
        const std::array<double, 2> u{random.u(), random.u()};
        points.push_back(make_point(wo, {alpha, other}, normal, n, u, random.eta()));
    }
    refract_some(function, points);
    return points;
}

namespace {

// From the range that lobes have to that of the scope.
double moved(double alpha, const AlphaRange& range) {
    constexpr double low = 1e-4, high = 2;
    const double part = std::clamp(std::log(alpha / low) / std::log(high / low), 0.0, 1.0);
    return range.low * std::pow(range.high / range.low, part);
}

std::vector<Point> corners(const Scope& scope, bool world) {
    const AlphaRange& range = scope.alpha;
    std::vector<std::array<double, 2>> alphas{{range.low, range.low}, {range.high, range.high}};
    if (!world && !scope.isotropic)
        alphas.insert(alphas.end(), {{range.low, range.high}, {range.high, range.low}});
    std::vector<Direction> directions{{0, 0, 1},      {1e-7, 0, 1},         {0.6, 0, 0.8},     {0, 0.6, 0.8},
                                      {-0.6, 0, 0.8}, direction(1e-3, 0.7), direction(1e-3, 0)};
    if (scope.domain == Domain::sphere)
        directions.insert(directions.end(), {{0.6, 0, -0.8}, direction(-1e-3, 0.7), direction(0, 0.7)});
    std::vector<Direction> axes{{0, 0, 1}};
    if (world) axes = {{0, 0, 1}, {0, 0, -1}, {1, 0, 0}, direction(-1 + 1e-6, 2.2)};
    std::vector<Point> points;
    for (const auto& alpha : alphas)
        for (const Direction& wo : directions)
            for (const Direction& n : axes)
                for (const double u1 : {0.0, 0x1p-24, 0.25, 0.5, 0.75, 1 - 0x1p-24})
                    for (const double u2 : {0.0, 0x1p-24, 0.25, 0.5, 1 - 0x1p-24})
                        points.push_back(
                            make_point(wo, alpha, {std::sqrt(1 - u1), 6 * u2}, n, {u1, u2}, 1.5));
    return points;
}

}  // namespace

std::vector<Point> lobes(const Function& function, const Scope& scope, bool quick) {
    std::vector<Point> points = lobes(function, quick);
    for (Point& point : points) {
        std::array<double, 2> alpha{moved(point.alpha[0], scope.alpha), moved(point.alpha[1], scope.alpha)};
        if (scope.isotropic) alpha[1] = alpha[0];
        Point moved_point = make_point({0, 0, 1}, alpha, {1, 0}, {0, 0, 1}, point.u, point.eta);
        moved_point.wo = point.wo, moved_point.n = point.n, moved_point.t = point.t;
        moved_point.cos_theta = point.cos_theta;
        point = moved_point;
    }
    return distinct(function, points);
}

std::vector<Point> scoped_points(const Function& function, const Scope& scope, std::size_t count,
                                 std::uint64_t seed) {
    Random random(seed);
    const bool world = uses(function, {"n_x"});
    std::vector<Point> points;
    while (points.size() < count) {
        const double height = random.chance(0.3) ? random.log_uniform(1e-3, 1) : random.uniform(1e-3, 1);
        const double side = scope.domain == Domain::sphere && random.chance(0.3) ? -1 : 1;
        const Direction wo = direction(side * height, random.uniform(-pi, pi));
        const auto alpha = [&] { return random.log_uniform(scope.alpha.low, scope.alpha.high); };
        const double x = alpha(), y = alpha();
        const bool round = world || scope.isotropic || random.chance(0.4);
        const Stretched normal{std::sqrt(1 - random.uniform()), random.uniform(-pi, pi)};
        const std::array<double, 2> u{random.u(), random.u()};
        const Direction n = world ? direction(random.cosine(), random.uniform(-pi, pi)) : Direction{0, 0, 1};
        points.push_back(make_point(wo, {x, round ? x : y}, normal, n, u, random.eta()));
    }
    refract_some(function, points);
    for (const Point& point : corners(scope, world)) points.push_back(point);
    return distinct(function, points);
}

}  // namespace vndf::conformance
