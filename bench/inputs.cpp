#include "inputs.h"

#include <cmath>
#include <numbers>
#include <random>

#include <fmt/format.h>

namespace vndf::bench {

using conformance::Direction, conformance::Point, conformance::Stretched;

std::vector<Point> points(std::size_t count, bool world_space, Side side, AlphaRange alpha) {
    std::mt19937_64 engine(1);
    const auto uniform = [&] { return static_cast<double>(engine() >> 40) * 0x1p-24; };
    const auto log_uniform = [&](double low, double high) { return low * std::pow(high / low, uniform()); };
    const auto azimuth = [&] { return 2 * std::numbers::pi * uniform(); };
    std::vector<Point> all;
    all.reserve(count);
    while (all.size() < count) {
        const bool back = side == Side::back || (side == Side::both && all.size() % 2 == 1);
        const double cosine = 1 - uniform();
        const Direction wo = conformance::direction(back ? -cosine : cosine, azimuth());
        const Direction n =
            world_space ? conformance::direction(1 - 2 * uniform(), azimuth()) : Direction{0, 0, 1};
        const double alpha_x = log_uniform(alpha.low, alpha.high),
                     alpha_y = world_space ? alpha_x : log_uniform(alpha.low, alpha.high);
        const Stretched normal{1 - uniform(), azimuth()};
        const double u1 = uniform(), u2 = uniform(), eta = 1.05 + 1.45 * uniform();
        const Point point = conformance::make_point(wo, {alpha_x, alpha_y}, normal, n, {u1, u2}, eta);
        const auto dot = point.wo[0] * point.wm[0] + point.wo[1] * point.wm[1] + point.wo[2] * point.wm[2];
        if (back || dot > 0) all.push_back(point);
    }
    return all;
}

std::string describe_inputs(AlphaRange alpha) {
    return fmt::format(
        "wo uniform on the hemisphere, each alpha log-uniform in [{:g}, {:g}] (world space: one), u uniform; "
        "compute: "
        "cos(theta) = 0.7, alpha = (0.3, 0.2)",
        alpha.low, alpha.high);
}

Point lobe(bool world_space) {
    const Direction n = world_space ? Direction{0.48, -0.6, 0.64} : Direction{0, 0, 1};
    return conformance::make_point(conformance::direction(0.7, 0.6), {0.3, world_space ? 0.3 : 0.2},
                                   {0.8, 2.0}, n, {0.25, 0.75}, 1.5);
}

}  // namespace vndf::bench
