// What vndf.h promises of every function, on the host build; `clvndf check` asserts the same of a device.
#include <cmath>
#include <limits>
#include <random>

#include "conformance/judge/digest.h"
#include "conformance/judge/errors.h"
#include "conformance/judge/extremes.h"
#include "support/catch.h"

using namespace vndf;
using namespace vndf::conformance;

namespace {

constexpr Real reals[] = {Real::f32, Real::f64};

double rounded(Real real, double x) {
    return real == Real::f32 ? static_cast<float>(x) : x;
}

// A table of the named function's inputs, empty.
Table empty_table(const std::string& name) {
    Table table;
    table.columns.resize(find_function(name)->inputs.size());
    return table;
}
void add_row(Table& table, const std::vector<double>& row) {
    for (std::size_t i = 0; i < row.size(); ++i) table.columns[i].push_back(row[i]);
}
std::vector<std::vector<double>> evaluate_on_host(Real real, const std::string& name, const Table& table) {
    runtime::HostEvaluator host(Math::strict, real);
    return evaluate(host, *find_function(name), table);
}

// wo and wi, or their cosines, in each other's place.
Table exchanged(const Function& function, Table rows) {
    for (const auto& [o, i] :
         {std::pair{"wo_x", "wi_x"}, {"wo_y", "wi_y"}, {"wo_z", "wi_z"}, {"cos_theta_o", "cos_theta_i"}})
        if (column(function, o) >= 0)
            std::swap(rows.columns[column(function, o)], rows.columns[column(function, i)]);
    return rows;
}

class Random {
  public:
    double uniform(double low, double high) {
        return low + (high - low) * (static_cast<double>(engine_() >> 11) * 0x1p-53);
    }
    Direction direction() { return conformance::direction(uniform(-1, 1), uniform(-3.14159, 3.14159)); }

  private:
    std::mt19937_64 engine_{1};
};

}  // namespace

TEST_CASE("finite arguments of any size give finite results, and wo of any length a unit vector") {
    for (const Real real : reals)
        for (const Math math : {Math::strict, Math::builtin}) {
            runtime::HostEvaluator host(math, real);
            PointwiseOptions options;
            options.random_points = std::size_t{1} << 13;
            options.math = math;
            for (const Function& function : functions())
                for (const Finding& finding : check_extremes(host, function, options)) {
                    INFO(function.name << ", " << to_string(real) << ": " << finding.check << ", at "
                                       << finding.worst);
                    CHECK(finding.count > 0);
                    CHECK(finding.passed());
                }
        }
}

TEST_CASE("nothing that vndf_refract returns has the Jacobian 0, whatever the index") {
    Random random;
    for (const Real real : reals) {
        Table rays = empty_table("vndf_refract");
        for (int i = 0; i < 40000; ++i) {
            const Direction o = random.direction(), m = random.direction();
            const double sign = o[0] * m[0] + o[1] * m[1] + o[2] * m[2] < 0 ? -1 : 1;
            const double least = real == Real::f32 ? -24 : -53,
                         c = std::abs(o[0] * m[0] + o[1] * m[1] + o[2] * m[2]);
            // Next to 1, anything, and the critical angle, where nothing of the transmitted cosine is left.
            const double eta = i % 3 == 0   ? 1 + (i % 2 ? 1 : -1) * std::exp2(random.uniform(least, -1))
                               : i % 3 == 1 ? random.uniform(0.3, 3)
                                            : std::sqrt((1 - c) * (1 + c)) * (1 + (i % 8) * std::exp2(least));
            std::vector<double> row;
            for (const double x : o) row.push_back(rounded(real, x));
            for (const double x : m) row.push_back(rounded(real, sign * x));
            row.push_back(rounded(real, i % 30 == 0 ? 1 : eta));
            add_row(rays, row);
        }
        const auto refracted = evaluate_on_host(real, "vndf_refract", rays);
        Table pairs = empty_table("vndf_jacobian_refract");
        for (std::size_t i = 0; i < rays.rows(); ++i) {
            const std::vector<double> row = rays.row(i);
            const double x = refracted[0][i], y = refracted[1][i], z = refracted[2][i];
            if (x != 0 || y != 0 || z != 0) add_row(pairs, {row[0], row[1], row[2], x, y, z, row[6]});
        }
        CHECK(pairs.rows() > 20000);
        const auto jacobians = evaluate_on_host(real, "vndf_jacobian_refract", pairs)[0];
        for (std::size_t i = 0; i < pairs.rows(); ++i)
            if (!(jacobians[i] > 0))
                FAIL_CHECK(hex_row(*find_function("vndf_jacobian_refract"), pairs.row(i)));
    }
    // A pair whose cosine is 0 to the last bit: wi is across wo + eta wi.
    for (const Real real : reals) {
        Table pair = empty_table("vndf_jacobian_refract");
        add_row(pair, {-0.5, 0, std::sqrt(0.75), 1, 0, 0, 0.5});
        CHECK(evaluate_on_host(real, "vndf_jacobian_refract", pair)[0][0] > 0);
    }
}

TEST_CASE("with index 1 refraction goes straight on") {
    Random random;
    for (const Real real : reals) {
        Table rays = empty_table("vndf_refract");
        for (int i = 0; i < 10000; ++i) {
            std::vector<double> row;
            const Direction o = random.direction(), m = random.direction();
            const double sign = o[0] * m[0] + o[1] * m[1] + o[2] * m[2] < 0 ? -1 : 1;
            for (const double x : o) row.push_back(rounded(real, x));
            for (const double x : m) row.push_back(rounded(real, sign * x));
            row.push_back(1);
            add_row(rays, row);
        }
        const auto out = evaluate_on_host(real, "vndf_refract", rays);
        for (std::size_t i = 0; i < rays.rows(); ++i)
            for (int k = 0; k < 3; ++k)
                if (!(std::abs(out[k][i] + rays.columns[k][i]) <= 4 * epsilon(real)))
                    FAIL_CHECK(hex_row(*find_function("vndf_refract"), rays.row(i)));
    }
}

TEST_CASE("NaN in a direction is not hidden by a term") {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    for (const Real real : reals)
        for (const char* name :
             {"vndf_ggx_sigma", "vndf_ggx_sigma_lobe", "vndf_ggx_g1", "vndf_ggx_g1_lobe",
              "vndf_ggx_sigma_visible", "vndf_ggx_reflection_probability", "vndf_beckmann_sigma",
              "vndf_beckmann_sigma_lobe", "vndf_beckmann_g1", "vndf_beckmann_g1_lobe"}) {
            INFO(name);
            Table table = empty_table(name);
            add_row(table, {nan, 0, 0.8, 0.5, 0.5}), add_row(table, {0, nan, 0.8, 0.5, 0.5});
            const auto results = evaluate_on_host(real, name, table);
            for (const double result : results[0]) CHECK(std::isnan(result));
        }
    for (const Real real : reals)
        for (const char* name : {"vndf_ggx_sigma_world", "vndf_ggx_g1_world", "vndf_beckmann_sigma_world",
                                 "vndf_beckmann_g1_world"}) {
            INFO(name);
            Table table = empty_table(name);
            add_row(table, {nan, 0, 0.8, 0, 0, 1, 0.5}), add_row(table, {0, 0.6, 0.8, 0, nan, 1, 0.5});
            const auto results = evaluate_on_host(real, name, table);
            for (const double result : results[0]) CHECK(std::isnan(result));
        }
}

TEST_CASE("masking and shadowing has the same bits for wo and wi exchanged") {
    for (const Real real : reals)
        for (const char* name :
             {"vndf_ggx_g2", "vndf_ggx_g2_lobe", "vndf_ggx_g2_separable", "vndf_beckmann_g2",
              "vndf_beckmann_g2_lobe", "vndf_beckmann_g2_separable", "vndf_ggx_g2_world",
              "vndf_beckmann_g2_world", "vndf_ggx_g2_cosines", "vndf_beckmann_g2_cosines"}) {
            const Function& g2 = *find_function(name);
            const Table rows = digest_inputs(g2, std::size_t{1} << 14, real);
            const auto one = evaluate_on_host(real, name, rows),
                       other = evaluate_on_host(real, name, exchanged(g2, rows));
            std::size_t different = 0, positive = 0;
            for (std::size_t i = 0; i < rows.rows(); ++i) {
                different += one[0][i] != other[0][i];
                positive += one[0][i] > 0;
            }
            INFO(name);
            CHECK(different == 0);
            CHECK(positive > rows.rows() / 4);
        }
}

TEST_CASE("an alpha beyond its range counts as the end of the range") {
    for (const Real real : reals)
        for (const Function& function : functions())
            for (std::size_t j = 0; j < function.inputs.size(); ++j) {
                if (function.inputs[j].rfind("alpha", 0) != 0) continue;
                INFO(function.name << ", " << function.inputs[j]);
                for (const auto& [beyond, end] :
                     {std::pair{1e30, 1e3}, std::pair{0.0, real == Real::f32 ? double(1e-8f) : 1e-8}}) {
                    Table at_end = digest_inputs(function, 256, real), outside = at_end;
                    for (double& a : at_end.columns[j]) a = end;
                    for (double& a : outside.columns[j]) a = beyond;
                    CHECK(evaluate_on_host(real, function.name, outside) ==
                          evaluate_on_host(real, function.name, at_end));
                }
            }
}

TEST_CASE("a reflection has the same value, and its densities change places, with wo and wi exchanged") {
    for (const Real real : reals)
        for (const char* name :
             {"vndf_ggx_eval_pdf", "vndf_ggx_eval_pdf_lobe", "vndf_ggx_pdf_wi_both",
              "vndf_ggx_pdf_wi_both_lobe", "vndf_beckmann_pdf_wi_both", "vndf_beckmann_pdf_wi_both_lobe"}) {
            const Function& pair = *find_function(name);
            const Table rows = digest_inputs(pair, std::size_t{1} << 14, real);
            const auto one = evaluate_on_host(real, name, rows),
                       other = evaluate_on_host(real, name, exchanged(pair, rows));
            const bool both = pair.result == "PDF_BOTH";
            std::size_t different = 0, positive = 0;
            for (std::size_t i = 0; i < rows.rows(); ++i) {
                different += one[0][i] != other[both ? 1 : 0][i];
                positive += one[0][i] > 0;
            }
            INFO(name);
            CHECK(different == 0);
            CHECK(positive > rows.rows() / 4);
        }
}

TEST_CASE("the value of a reflection times its cosine is its weight times its density") {
    for (const Real real : reals)
        for (const std::string ndf : {"ggx", "beckmann"}) {
            const Function& pair = *find_function("vndf_" + ndf + "_eval_pdf");
            const Function& weight = *find_function("vndf_" + ndf + "_weight");
            const Table rows = digest_inputs(pair, std::size_t{1} << 14, real);
            const auto evaluated = evaluate_on_host(real, pair.name, rows);
            const auto weights = evaluate_on_host(real, weight.name, rows)[0];
            const auto& cosines = rows.columns[5];
            // The errors of D are those of both numbers; that of the weight comes on top.
            const double allowed =
                (bounds_of(pair, real).error + bounds_of(weight, real).error) * epsilon(real);
            std::size_t compared = 0, off = 0;
            for (std::size_t i = 0; i < rows.rows(); ++i) {
                const double value = evaluated[0][i], pdf = evaluated[1][i];
                // Where neither has left the range of numbers.
                if (!(std::min(value, pdf) > 1e-30 && std::max(value, pdf) < 1e30)) continue;
                off += !(std::abs(value * cosines[i] / (weights[i] * pdf) - 1) <= allowed);
                ++compared;
            }
            INFO(ndf);
            CHECK(off == 0);
            CHECK(compared > rows.rows() / 8);
        }
}

TEST_CASE("a function of a lobe has the bits of the one that sets it up itself") {
    std::size_t compared = 0;
    for (const Real real : reals)
        for (const Function& function : functions()) {
            const std::size_t at = function.name.find("_lobe");
            if (at == std::string::npos) continue;
            std::string plain = function.name;
            plain.erase(at, 5);
            INFO(function.name);
            REQUIRE(find_function(plain));
            const Table rows = digest_inputs(function, std::size_t{1} << 12, real);
            CHECK(evaluate_on_host(real, function.name, rows) == evaluate_on_host(real, plain, rows));
            ++compared;
        }
    CHECK(compared >= 2 * 36);
}
