#include "conformance/judge/known_bias.h"

#include <algorithm>
#include <cmath>

namespace vndf::conformance {
namespace {

// Heitz & d'Eon 2014, supplement 1, Section 4.3: a rational fit z(U) of the inverse of
//     G(z) = 2 / pi (atan z + z / (1 + z^2)),
// the distribution of |slope across the plane of incidence| / sqrt(1 + slope along^2), U = |2 u2 - 1|. With
// the constants as published it has these errors; CDF errors are of the two-sided distribution, half those of
// G.
constexpr double cdf_error = 3.8e-4;                        // for U < 0.995
constexpr double cdf_error_at_end = 5.4e-4;                 // G never reaches 1
constexpr double cut = 7.256;                               // the largest z
constexpr double rms_angle = 1.0e-3;                        // of atan z, for U < 0.999
constexpr double density_low = 0.06, density_high = 0.023;  // relative, for U < 0.99 (u2 < 0.995)

constexpr double pi = 3.14159265358979323846;

bool is_fit(const Function& sampler) {
    return sampler.model.starts_with("vndf_ggx_sample_wm_heitz_deon2014") &&
           sampler.method == Method::approximate;
}

double cumulative(double z) {
    return 2 / pi * (std::atan(z) + z / (1 + z * z));
}

// atan z of the exact distribution: bisection, to the last bit that matters.
double exact_angle(double U) {
    double low = 0, high = pi / 2;
    for (int i = 0; i < 60; ++i) {
        const double middle = 0.5 * (low + high);
        (cumulative(std::tan(middle)) < U ? low : high) = middle;
    }
    return low;
}

// z(U) as the evaluator's sampler has it, at n midpoints and at the end of the range, for alpha = 1 and one wo in the plane
// y = 0: not at normal incidence, which the listing treats apart.
struct Curve {
    std::vector<double> u, z;
    double end = 0;
};

Curve measure_curve(runtime::Evaluator& evaluator, const Function& sampler, std::size_t n) {
    Curve curve;
    Table table;
    for (const std::string& name : sampler.inputs) {
        std::vector<double>& values = table.columns.emplace_back();
        for (std::size_t i = 0; i <= n; ++i) {
            const double u = i == n ? 1 : (static_cast<double>(i) + 0.5) / static_cast<double>(n);
            values.push_back(name == "wo_x"   ? 0.6
                             : name == "wo_y" ? 0
                             : name == "wo_z" ? 0.8
                             : name == "u1"   ? 0.5
                             : name == "u2"   ? 0.5 + 0.5 * u
                                              : 1);
            if (name == "u2" && i < n) curve.u.push_back(u);
        }
    }
    const auto m = evaluate(evaluator, sampler, table);
    for (std::size_t i = 0; i <= n; ++i) curve.z.push_back(std::abs(m[1][i]) / std::hypot(m[0][i], m[2][i]));
    curve.end = curve.z.back();
    curve.z.pop_back();
    return curve;
}

}  // namespace

KnownBias known_bias(const Function& sampler) {
    if (!is_fit(sampler)) return {};
    // chi_square: sum (p - q)^2 / q is at most 0.06 * 0.023 in the bulk and, beyond the cut, the lost mass
    // itself.
    return {1.1 * cdf_error_at_end, 1.1 * (2 * cdf_error_at_end + density_low * density_high / 3),
            2 * rms_angle};
}

std::vector<Finding> measure_bias(runtime::Evaluator& evaluator, const Function& sampler) {
    if (!is_fit(sampler)) return {};
    constexpr std::size_t n = std::size_t{1} << 14, step = 16;
    const Curve curve = measure_curve(evaluator, sampler, n);
    double cdf = 0, squares = 0, low = 0, high = 0;
    std::size_t counted = 0;
    for (std::size_t i = 0; i < n; ++i) {
        const double U = curve.u[i];
        if (U < 0.995) cdf = std::max(cdf, 0.5 * std::abs(cumulative(curve.z[i]) - U));
        if (U < 0.999) {
            const double angle = std::atan(curve.z[i]) - exact_angle(U);
            squares += angle * angle, ++counted;
        }
        if (i + step < n && curve.u[i + step] < 0.99) {
            const double mass = cumulative(curve.z[i + step]) - cumulative(curve.z[i]);
            const double ratio = (curve.u[i + step] - U) / mass - 1;
            low = std::max(low, -ratio), high = std::max(high, ratio);
        }
    }
    std::vector<Finding> findings;
    const auto add = [&](const char* check, double figure, double documented, const char* unit) {
        Finding finding;
        finding.check = check, finding.figure = figure, finding.limit = documented, finding.unit = unit;
        finding.biased = true, finding.count = n;
        finding.detail = "the published rational fit against the exact conditional distribution";
        finding.worst = "wo=(0.6,0,0.8) alpha=(1,1) u1=0x1p-1";
        findings.push_back(finding);
    };
    add("fit: CDF error, U < 0.995", cdf, cdf_error, "");
    add("fit: CDF error at the end", 0.5 * (1 - cumulative(curve.end)), cdf_error_at_end, "");
    add("fit: largest slope", curve.end, cut, "");
    add("fit: rms angle, U < 0.999", std::sqrt(squares / static_cast<double>(counted)), rms_angle, "rad");
    add("fit: density too low by, U < 0.99", low, density_low, "");
    add("fit: density too high by, U < 0.99", high, density_high, "");
    return findings;
}

}  // namespace vndf::conformance
