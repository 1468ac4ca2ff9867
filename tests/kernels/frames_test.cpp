// Frames as renderers have them: bases, the recipes of kernels/README.md (embedding/frames.h), and what a rounded cosine costs.
#include <algorithm>
#include <cmath>
#include <fstream>
#include <random>

#include <fmt/format.h>

#include "conformance/inputs/rows.h"
#include "conformance/judge/errors.h"
#include "embedding/frames.h"
#include "support/catch.h"

using namespace vndf;
using namespace vndf::conformance;

namespace {

constexpr Real reals[] = {Real::f32, Real::f64};

class Random {
  public:
    double uniform(double low, double high) {
        return low + (high - low) * (static_cast<double>(engine_() >> 11) * 0x1p-53);
    }
    Direction direction() { return conformance::direction(uniform(-1, 1), uniform(-3.14159, 3.14159)); }
    vndf_float2 u() { return {float(uniform(0, 1)), float(uniform(0, 1))}; }

  private:
    std::mt19937_64 engine_{1};
};

vndf_float3 rounded(const Direction& d) {
    return {float(d[0]), float(d[1]), float(d[2])};
}

std::vector<std::vector<double>> evaluate_on_host(Real real, const char* name, const Table& table) {
    runtime::HostEvaluator host(Math::strict, real);
    return evaluate(host, *find_function(name), table);
}

// The vectors side by side as a table, rounded to the type.
Table table_of(Real real, const std::vector<std::vector<Direction>>& vectors) {
    Table table;
    for (const auto& column : vectors)
        for (int k = 0; k < 3; ++k) {
            table.columns.emplace_back();
            for (const Direction& d : column)
                table.columns.back().push_back(conformance::rounded(d[k], real));
        }
    return table;
}
Direction vector_at(const std::vector<std::vector<double>>& columns, std::size_t i, std::size_t first = 0) {
    return {columns[first][i], columns[first + 1][i], columns[first + 2][i]};
}

long double dot_of(const Direction& a, const Direction& b) {
    return static_cast<long double>(a[0]) * b[0] + static_cast<long double>(a[1]) * b[1] +
           static_cast<long double>(a[2]) * b[2];
}
// |a x b|
long double sine_of(const Direction& a, const Direction& b) {
    long double square = 0;
    for (int k = 0; k < 3; ++k) {
        const int i = (k + 1) % 3, j = (k + 2) % 3;
        const long double x = a[i], y = a[j], product = y * b[i];
        // With what the products round off.
        const long double c = std::fma(x, static_cast<long double>(b[j]), -product) +
                              std::fma(-y, static_cast<long double>(b[i]), product);
        square += c * c;
    }
    return std::sqrt(square);
}

// Normals everywhere, at the poles and next to them, and on both sides of the seam.
std::vector<Direction> normals() {
    std::vector<Direction> all{{0, 0, 1}, {0, 0, -1}, {1, 0, 0}, {0, -1, 0}, {-1, 0, -0.0}};
    Random random;
    for (int i = 0; i < 20000; ++i) {
        const double near = std::exp2(random.uniform(-60, 0)), phi = random.uniform(-3, 3);
        all.push_back(random.direction());
        all.push_back(direction(1 - near, phi)), all.push_back(direction(near - 1, phi));
        all.push_back(direction(near, phi)), all.push_back(direction(-near, phi));
    }
    return all;
}

// In units of the last place: how far the tangents are from unit length and from being across n.
double off(Real real, const Table& table, const std::vector<std::vector<double>>& tangents) {
    double worst = 0;
    for (std::size_t i = 0; i < table.rows(); ++i) {
        const Direction n = vector_at(table.columns, i), t = vector_at(tangents, i);
        worst = std::max({worst, static_cast<double>(std::abs(std::sqrt(dot_of(t, t)) - 1)),
                          static_cast<double>(std::abs(dot_of(t, n)))});
    }
    return worst / epsilon(real);
}

}  // namespace

TEST_CASE("every normal has a tangent of unit length across it") {
    const std::vector<Direction> n = normals();
    Random random;
    std::vector<Direction> towards;
    for (const Direction& d : n) {
        // Next to n and everywhere.
        const double near = std::exp2(random.uniform(-40, 0));
        Direction w = random.direction();
        if (towards.size() % 2)
            for (int k = 0; k < 3; ++k) w[k] = d[k] + near * w[k];
        if (towards.size() % 16 == 0) w = d;
        towards.push_back(w);
    }
    for (const Real real : reals) {
        const Table alone = table_of(real, {n}), along = table_of(real, {n, towards});
        CHECK(off(real, alone, evaluate_on_host(real, "vndf_tangent", alone)) <= tangent_bound());
        CHECK(off(real, along, evaluate_on_host(real, "vndf_tangent_along", along)) <= tangent_bound());
        // It can fail: the part of w across n by w - (n . w) n, normalised, leans towards n where w is next to n.
        auto projected = evaluate_on_host(real, "vndf_tangent_along", along);
        for (std::size_t i = 0; i < along.rows(); ++i) {
            const Direction m = vector_at(along.columns, i), w = vector_at(along.columns, i, 3);
            const double c = conformance::rounded(dot(m, w), real);
            Direction p;
            for (int k = 0; k < 3; ++k) p[k] = conformance::rounded(w[k] - c * m[k], real);
            if (length(p) > 0)
                for (int k = 0; k < 3; ++k) projected[k][i] = p[k] / length(p);
        }
        CHECK(off(real, along, projected) > 100 * tangent_bound());
    }
}

TEST_CASE("local directions keep small angles to the normal, and there and back leads home") {
    Random random;
    std::vector<Direction> n, w;
    for (int i = 0; i < 40000; ++i) {
        n.push_back(random.direction());
        Direction d = random.direction();
        if (i % 2) {
            const double near = std::exp2(random.uniform(-22, 0));
            for (int k = 0; k < 3; ++k) d[k] = n.back()[k] + near * d[k];
            const double size = length(d);
            for (double& x : d) x /= size;
        }
        w.push_back(d);
    }
    for (const Real real : reals) {
        const Table normal = table_of(real, {n});
        const auto t = evaluate_on_host(real, "vndf_tangent", normal);
        Table frame = table_of(real, {w, n});
        frame.columns.insert(frame.columns.end(), t.begin(), t.end());
        const auto local = evaluate_on_host(real, "vndf_to_local", frame);
        Table back = frame;
        std::copy(local.begin(), local.end(), back.columns.begin());
        const auto home = evaluate_on_host(real, "vndf_to_world", back);
        double sine = 0, away = 0, plain = 0;
        for (std::size_t i = 0; i < frame.rows(); ++i) {
            const Direction d = vector_at(frame.columns, i), m = vector_at(frame.columns, i, 3),
                            l = vector_at(local, i), h = vector_at(home, i), x = vector_at(t, i);
            const long double exact = sine_of(m, d);
            if (!(exact > 0)) continue;
            const auto relative = [&](double got) { return static_cast<double>(std::abs(got / exact - 1)); };
            sine = std::max(sine, relative(std::hypot(l[0], l[1])));
            for (int k = 0; k < 3; ++k) away = std::max(away, std::abs(h[k] - d[k]));
            // It can fail: dot products with t and n x t.
            const Direction b{m[1] * x[2] - m[2] * x[1], m[2] * x[0] - m[0] * x[2],
                              m[0] * x[1] - m[1] * x[0]};
            plain = std::max(plain, relative(std::hypot(conformance::rounded(dot(x, d), real),
                                                        conformance::rounded(dot(b, d), real))));
        }
        CHECK(sine / epsilon(real) <= frame_bound());
        CHECK(away / epsilon(real) <= frame_bound());
        CHECK(plain / epsilon(real) > 100 * frame_bound());
    }
}

TEST_CASE("frame.h states the bounds of the registry") {
    std::ifstream file(CLVNDF_SOURCE_DIR "/kernels/vndf/frame.h");
    const std::string text{std::istreambuf_iterator<char>(file), {}};
    const auto states = [&](const std::string& bound) { return text.find(bound) != std::string::npos; };
    CHECK(states(fmt::format("both to {} eps", tangent_bound())));
    CHECK(states(fmt::format("to {} eps of itself", frame_bound())));
    CHECK(states(fmt::format("is itself to {} eps", frame_bound())));
}

TEST_CASE("y up: the recipe draws from the lobe whose alphas lie along x and z") {
    // At normal incidence half of the normals lean further along an axis than its alpha / sqrt(3).
    const auto medians = [](vndf_float2 alpha) {
        Random random;
        std::vector<float> x, z;
        for (int i = 0; i < 20000; ++i) {
            const vndf_float3 wi = reflection_y_up({0, 1, 0}, alpha, random.u());
            const float up = wi.y + 1;  // the half vector is wi + y
            x.push_back(std::abs(wi.x / up)), z.push_back(std::abs(wi.z / up));
        }
        for (auto* slopes : {&x, &z})
            std::nth_element(slopes->begin(), slopes->begin() + 10000, slopes->end());
        return vndf_float2{x[10000], z[10000]};
    };
    const auto off = [&](vndf_float2 alpha, float alpha_x, float alpha_z) {
        const vndf_float2 m = medians(alpha);
        return std::max(std::abs(m.x / alpha_x * std::sqrt(3.f) - 1),
                        std::abs(m.y / alpha_z * std::sqrt(3.f) - 1));
    };
    CHECK(off({0.5f, 0.1f}, 0.5f, 0.1f) < 0.05);
    CHECK(off({0.1f, 0.5f}, 0.5f, 0.1f) > 0.5);  // it can fail: turned by 90 degrees

    // The density is that of the rotation of y to z, which is no mirror.
    Random random;
    for (int i = 0; i < 1000; ++i) {
        const vndf_float3 wo = rounded(random.direction()),
                          wi = reflection_y_up(wo, {0.5f, 0.1f}, random.u());
        const auto turned = [](vndf_float3 w) { return vndf_float3{w.x, -w.z, w.y}; };
        const float pdf = pdf_y_up(wo, wi, {0.5f, 0.1f});
        CHECK(pdf > 0);
        CHECK(pdf == vndf_ggx_pdf_wi(turned(wo), turned(wi), {0.5f, 0.1f}));
    }
}

TEST_CASE("normal and tangent: the recipe is the local sampler in another frame") {
    Random random;
    double same = 0, turned = 0;
    for (int i = 0; i < 2000; ++i) {
        const vndf_float3 n = rounded(random.direction());
        vndf_float3 t = vndf_tangent(n);
        const vndf_float3 local = rounded(direction(random.uniform(0.1, 1), random.uniform(-3, 3)));
        const vndf_float2 alpha = {0.5f, 0.2f}, u = random.u();
        const vndf_float3 wo = vndf_to_world(local, n, t);
        const vndf_float3 expected =
            vndf_to_world(vndf_reflect(local, vndf_ggx_sample_wm_dupuy2023(local, alpha, u)), n, t);
        const vndf_float3 b = vndf_to_world({0, 1, 0}, n, t);
        // An interpolated tangent: longer, and not across n.
        const vndf_float3 leaning = {1.5f * t.x + 0.3f * n.x, 1.5f * t.y + 0.3f * n.y,
                                     1.5f * t.z + 0.3f * n.z};
        const auto distance = [&](vndf_float3 wi) {
            return std::hypot(wi.x - expected.x, wi.y - expected.y, wi.z - expected.z);
        };
        same = std::max<double>(same, distance(reflection_n_t(wo, n, leaning, alpha, u)));
        turned = std::max<double>(turned, distance(reflection_n_t(wo, n, b, alpha, u)));
        const vndf_float3 wi = reflection_n_t(wo, n, leaning, alpha, u);
        CHECK(pdf_n_t(wo, wi, n, leaning, alpha) > 0);
    }
    CHECK(same < 1e-4);
    CHECK(turned > 0.1);  // it can fail: the bitangent for the tangent
}

TEST_CASE("two sides: the recipe sees the same surface from below") {
    Random random;
    int below = 0, differs = 0;
    for (int i = 0; i < 2000; ++i) {
        const vndf_float3 wo = rounded(random.direction()), image = {wo.x, wo.y, -wo.z};
        const vndf_float2 alpha = {0.3f, 0.3f}, u = random.u();
        const vndf_float3 wi = reflection_two_sided(wo, alpha, u),
                          wi_image = reflection_two_sided(image, alpha, u);
        CHECK((wi.x == wi_image.x && wi.y == wi_image.y && wi.z == -wi_image.z));
        const float pdf = pdf_two_sided(wo, wi, alpha);
        CHECK(pdf > 0);
        CHECK(pdf == pdf_two_sided(image, wi_image, alpha));
        // About n the same, whichever way n points.
        for (const float side : {1.f, -1.f})
            CHECK(vndf_ggx_pdf_wi_world(wo, towards({0, 0, side}, wo), wi, alpha.x) ==
                  Catch::Approx(pdf).epsilon(1e-5));
        below += wi.z * wo.z < 0;
        // It can fail: without the recipe wo from below has another density.
        differs += wo.z < 0 && std::abs(vndf_ggx_pdf_wi(wo, wi, alpha) / pdf - 1) > 0.01;
    }
    CHECK(below < 200);
    CHECK(differs > 900);
}

TEST_CASE("a rounded cosine costs D and the densities 4 / alpha^2 half units, masking and shadowing none") {
    const auto value = [](const char* name, std::vector<double> in) {
        double out[4];
        reference::find_evaluation<double>(name)(in.data(), out, reference::Precision::f64);
        return out[0];
    };
    constexpr double half_unit = 0x1p-25;
    Random random;
    // GGX's D is steepest at the peak; Beckmann's moves by half as much, anywhere in the lobe.
    for (const auto& [name, times] :
         {std::pair{"vndf_ggx_ndf_cosines", 4.}, {"vndf_beckmann_ndf_cosines", 2.}})
        for (const double alpha : {1e-3, 1e-2, 0.1}) {
            double worst = 0;
            for (int i = 0; i < 20000; ++i) {
                const double tangent = alpha * random.uniform(0, 2), c = 1 / std::sqrt(1 + tangent * tangent);
                const double moved = value(name, {static_cast<float>(c), alpha}) / value(name, {c, alpha});
                worst = std::max(worst, std::abs(moved - 1));
            }
            const double stated = half_unit * times / (alpha * alpha);
            INFO(name << " " << alpha << ": " << worst << ", stated " << stated);
            CHECK(worst <= 1.2 * stated);
            CHECK(worst >= 0.5 * stated);
        }
    double worst = 0;
    for (int i = 0; i < 20000; ++i) {
        const double o = random.uniform(1e-3, 1), c = random.uniform(1e-3, 1),
                     alpha = random.uniform(1e-3, 1);
        for (const std::string ndf : {"ggx", "beckmann"})
            for (const char* term : {"g2", "weight"}) {
                const std::string name = "vndf_" + ndf + "_" + term + "_cosines";
                const double at = value(name.c_str(), {o, c, alpha});
                worst =
                    std::max(worst, std::abs(value(name.c_str(), {o * (1 - half_unit), c, alpha}) / at - 1));
                worst =
                    std::max(worst, std::abs(value(name.c_str(), {o, c * (1 - half_unit), alpha}) / at - 1));
            }
    }
    CHECK(worst <= 1.01 * half_unit);
    CHECK(worst >= 0.5 * half_unit);
    // The step from 1 to the next cosine.
    CHECK(std::sqrt(1 - std::pow(1 - 0x1p-24, 2)) == Catch::Approx(3.4e-4).epsilon(0.02));
    CHECK(std::sqrt(0x1p-53 * (2 - 0x1p-53)) == Catch::Approx(1.4e-8).epsilon(0.07));
}

TEST_CASE(
    "seen from behind along -n, beyond the cotangents that slopes are limited to, a density by cosines is "
    "right") {
    const Function& pdf = *find_function("vndf_beckmann_pdf_wi_cosines");
    Table rows{{{}, {}, {}}};
    for (const double cosine : {-1 + 0x1p-24, -1 + 0x1p-23})
        for (double alpha = 1e-6; alpha < 3e-6; alpha *= 1.001) {
            rows.columns[0].push_back(cosine), rows.columns[1].push_back(1);
            rows.columns[2].push_back(conformance::rounded(alpha, Real::f32));
        }
    const auto densities = evaluate_on_host(Real::f32, pdf.name.c_str(), rows)[0];
    int steep = 0;
    for (std::size_t i = 0; i < rows.rows(); ++i) {
        const std::vector<double> row = rows.row(i);
        double exact[4];
        reference::find_evaluation<double>(pdf.name)(row.data(), exact, reference::Precision::f32);
        if (exact[0] > 3.4e38) continue;
        const double cot = std::abs(row[0]) / (row[2] * std::sqrt((1 - row[0]) * (1 + row[0])));
        steep += cot > 0x1p30;
        INFO(hex_row(pdf, row));
        CHECK(std::abs(densities[i] / exact[0] - 1) <= bounds_of(pdf, Real::f32).error * epsilon(Real::f32));
    }
    CHECK(steep > 30);
}
