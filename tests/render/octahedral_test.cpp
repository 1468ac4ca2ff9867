// The square of the sphere: where places are, by other formulas in double, and back.
#include <array>
#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include "kernels/render/octahedral.h"
#include "support/catch.h"

namespace {

constexpr double eps = 0x1p-24;
using Direction = std::array<double, 3>;

// Clarberg's map in one piece: r is how far from the centre, in diamonds; phi runs along them.
Direction exact(double x, double y) {
    const double u = 2 * x - 1, v = 2 * y - 1, signed_gap = 1 - std::abs(u) - std::abs(v);
    const double r = 1 - std::abs(signed_gap);
    const double phi = r == 0 ? 0 : std::numbers::pi / 4 * ((std::abs(v) - std::abs(u)) / r + 1);
    const double sine = r * std::sqrt(2 - r * r);
    return {std::copysign(sine * std::cos(phi), u), std::copysign(1 - r * r, signed_gap),
            std::copysign(sine * std::sin(phi), v)};
}

Direction direction(double x, double y) {
    const vndf_render_vector d =
        vndf_render_octahedral_direction(static_cast<float>(x), static_cast<float>(y));
    return {d.x, d.y, d.z};
}
std::array<double, 2> place(const Direction& d) {
    const vndf_render_place p = vndf_render_octahedral_place(
        {static_cast<float>(d[0]), static_cast<float>(d[1]), static_cast<float>(d[2])});
    return {p.x, p.y};
}
double apart(const Direction& a, const Direction& b) {
    return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
}

// Places that random numbers give, at and next to the edges, the axes and the diamond of the horizon, and between.
template <class Body>
void at_places(Body body) {
    std::mt19937 random(3);
    std::uniform_int_distribution<int> bits(0, (1 << 24) - 1);
    std::vector<float> special;
    for (const double x : {0.0, 0.25, 0.5, 0.75, 1.0})
        for (const int step : {-2, -1, 0, 1, 2})
            if (const double near = x + step * eps; near >= 0 && near <= 1)
                special.push_back(static_cast<float>(near));
    for (int i = 0; i < 400'000; ++i) {
        const float x = i % 4 == 1 ? special[i / 4 % special.size()] : static_cast<float>(bits(random) * eps);
        const float y = i % 4 == 2 ? special[i / 4 % special.size()] : static_cast<float>(bits(random) * eps);
        body(x, i % 4 == 3 ? 1 - x : y);  // every fourth on a diagonal
    }
    for (const float x : special)
        for (const float y : special) body(x, y);
}

}  // namespace

TEST_CASE("places of the square are the directions that they should be, of length 1") {
    double worst = 0, length = 0;
    at_places([&](float x, float y) {
        const Direction d = direction(x, y);
        worst = std::max(worst, apart(d, exact(x, y)));
        length = std::max(length, std::abs(std::hypot(d[0], d[1], d[2]) - 1));
    });
    CAPTURE(worst / eps, length / eps);
    CHECK(worst <= 4 * eps);
    CHECK(length <= 4 * eps);
}

TEST_CASE("directions are back at their places") {
    double worst = 0, beside = 0;
    at_places([&](float x, float y) {
        // Of an exact direction, which rounding moves by at most 0.9 eps; at the horizon on either side of the fold.
        const auto p = place(exact(x, y)), q = place(direction(x, y));
        for (const auto& [found, to] : {std::pair{p, &worst}, {q, &beside}}) {
            double off = std::max(std::abs(found[0] - x), std::abs(found[1] - y));
            // On an edge a place and its mirror are one.
            if (x == 0 || x == 1)
                off = std::min(off, std::max(std::abs(found[0] - x), std::abs(found[1] - (1 - y))));
            if (y == 0 || y == 1)
                off = std::min(off, std::max(std::abs(found[1] - y), std::abs(found[0] - (1 - x))));
            if ((x == 0 || x == 1) && (y == 0 || y == 1))  // all four corners are one
                off = std::max(std::abs(std::abs(found[0] - 0.5) - 0.5),
                               std::abs(std::abs(found[1] - 0.5) - 0.5));
            *to = std::max(*to, off);
        }
    });
    CAPTURE(worst / eps, beside / eps);
    CHECK(worst <= 2 * eps);
    CHECK(beside <= 2 * eps);
}

TEST_CASE("the centre is up, the corners are down, the middles of the edges are the axes") {
    CHECK(direction(0.5, 0.5) == Direction{0, 1, 0});
    for (const double x : {0.0, 1.0})
        for (const double y : {0.0, 1.0}) CHECK(direction(x, y) == Direction{0, -1, 0});
    CHECK(apart(direction(1, 0.5), {1, 0, 0}) <= eps);
    CHECK(apart(direction(0, 0.5), {-1, 0, 0}) <= eps);
    CHECK(apart(direction(0.5, 1), {0, 0, 1}) <= eps);
    CHECK(apart(direction(0.5, 0), {0, 0, -1}) <= eps);
    using Place = std::array<double, 2>;
    CHECK(place({0, 1, 0}) == Place{0.5, 0.5});
    CHECK(place({1, 0, 0}) == Place{1, 0.5});
    CHECK(place({-1, 0, 0}) == Place{0, 0.5});
    CHECK(place({0, 0, 1}) == Place{0.5, 1});
    CHECK(place({0, 0, -1}) == Place{0.5, 0});
    const Place down = place({0, -1, 0});
    CHECK((std::abs(down[0] - 0.5) == 0.5 && std::abs(down[1] - 0.5) == 0.5));
}

TEST_CASE("equal areas of the square are equal solid angles") {
    // The area of what two small steps span, over theirs; where no fold is between.
    constexpr double step = 0x1p-10;
    double worst = 0;
    for (int i = 0; i < 64; ++i)
        for (int j = 0; j < 64; ++j) {
            const double x = (i + 0.3) / 64, y = (j + 0.55) / 64;
            if (std::abs(x - 0.5) < 2 * step || std::abs(y - 0.5) < 2 * step ||
                std::abs(std::abs(x - 0.5) + std::abs(y - 0.5) - 0.5) < 3 * step)
                continue;
            const Direction a = direction(x + step / 2, y), b = direction(x - step / 2, y),
                            c = direction(x, y + step / 2), d = direction(x, y - step / 2);
            const Direction s{a[0] - b[0], a[1] - b[1], a[2] - b[2]},
                t{c[0] - d[0], c[1] - d[1], c[2] - d[2]};
            const double area =
                std::hypot(s[1] * t[2] - s[2] * t[1], s[2] * t[0] - s[0] * t[2], s[0] * t[1] - s[1] * t[0]);
            worst = std::max(worst, std::abs(area / (step * step) / (4 * std::numbers::pi) - 1));
        }
    CHECK(worst < 2e-3);
}

TEST_CASE("the square goes on across an edge at the mirrored place") {
    std::mt19937 random(4);
    std::uniform_real_distribution<float> uniform;
    for (int i = 0; i < 1000; ++i) {
        const double y = uniform(random);
        for (const double edge : {0.0, 1.0}) {
            CHECK(apart(direction(edge, y), direction(edge, 1 - y)) <= 6 * eps);
            CHECK(apart(direction(y, edge), direction(1 - y, edge)) <= 6 * eps);
        }
    }
}

TEST_CASE("every vector has a place in the square") {
    std::mt19937 random(5);
    std::normal_distribution<float> normal;
    const auto inside = [](double x) { return x >= 0 && x <= 1; };
    for (int i = 0; i < 100'000; ++i) {
        float v[3];
        for (float& x : v)
            x = i % 3 == 0 ? std::ldexp(normal(random), static_cast<int>(random() % 200) - 150)
                           : normal(random);
        const double length = i % 2 == 0 ? std::hypot(v[0], v[1], v[2]) : 1;
        const auto p = place({v[0] / length, v[1] / length, v[2] / length});
        if (!inside(p[0]) || !inside(p[1])) FAIL("(" << v[0] << ", " << v[1] << ", " << v[2] << ") has none");
    }
    const auto p = place({0, 0, 0});
    CHECK((inside(p[0]) && inside(p[1])));
}
