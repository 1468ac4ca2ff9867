// What densities and terms are by mistake.
#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>

#include <fmt/format.h>

#include "conformance/judge/errors.h"
#include "conformance/judge/mistakes.h"
#include "conformance/judge/vectors.h"

namespace vndf::conformance {

using namespace vectors;

namespace {

// A function of the reference by name.
template <class... Vectors>
double value(const std::string& name, const Vectors&... vectors) {
    std::vector<double> in;
    (in.insert(in.end(), vectors.begin(), vectors.end()), ...);
    double out[4] = {};
    reference::find_evaluation<double>(name)(in.data(), out, reference::Precision::f32);
    return out[0];
}

// The value with a mistake in it, at a row of the function's inputs.
using Value = std::function<double(const Direction& wo, const Direction& w, const Alpha& alpha)>;
struct Guess {
    std::string what;
    Value value;
};

void add_alphas(std::vector<Guess>& all, const Value& right) {
    for (const AlphaMistake& mistake : alpha_mistakes)
        all.push_back({mistake.what, [=](const Direction& o, const Direction& w, const Alpha& a) {
                           return right(o, w, mistake.of(a));
                       }});
}

// Densities of normals, of a view or of the whole surface, for one distribution.
std::vector<Guess> densities(const Function& density) {
    const bool ggx = density.ndf == Ndf::ggx, plain = density.support == Support::upper,
               mirrored = density.result == "VALUE" && column(density, "wi_x") >= 0;
    const std::string own = ggx ? "vndf_ggx_" : "vndf_beckmann_",
                      others = ggx ? "vndf_beckmann_" : "vndf_ggx_";
    // About the normal: that of the row, or the half vector of a reflection.
    const auto about = [=](const Value& normals, bool jacobian) -> Value {
        if (!mirrored) return normals;
        return [=](const Direction& o, const Direction& i, const Alpha& a) {
            const Direction h = normalised(o + i);
            return normals(o, h, a) / (jacobian ? 4 * dot(o, h) : 1);
        };
    };
    const auto visible = [](const std::string& ndf) -> Value {
        return [=](const Direction& o, const Direction& m, const Alpha& a) {
            return value(ndf + "pdf_wm", o, m, a);
        };
    };
    const auto all_normals = [](const std::string& ndf) -> Value {
        return [=](const Direction&, const Direction& m, const Alpha& a) {
            return value(ndf + "pdf_wm_walter2007", m, a);
        };
    };
    const Value normals = plain ? all_normals(own) : visible(own);
    const auto evaluation = reference::find_evaluation<double>(density.model);
    const Value right = [=](const Direction& o, const Direction& w, const Alpha& a) {
        const double in[8] = {o[0], o[1], o[2], w[0], w[1], w[2], a[0], a[1]};
        double out[4];
        evaluation(in + (plain ? 3 : 0), out, reference::Precision::f32);
        return out[0];
    };
    std::vector<Guess> all{{"", right}};
    const auto add = [&](const char* what, Value v) { all.push_back({what, std::move(v)}); };
    add_alphas(all, right);
    add(ggx ? "it is the density of Beckmann's distribution, not of GGX"
            : "it is the density of the distribution of GGX, not of Beckmann's",
        about(plain ? all_normals(others) : visible(others), true));
    const auto ndf = [=](const Direction&, const Direction& m, const Alpha& a) {
        return value(own + "ndf", m, a);
    };
    if (plain)
        add("the cosine of the normal is left out: it is D", about(ndf, true));
    else {
        add("visibility (G1) is left out: it is the density D cos of all normals",
            about(all_normals(own), true));
        add("it is D, without cosine and visibility", about(ndf, true));
        add("G1 is left out: it is D |wo.wm| / cos",
            about([=](const Direction& o, const Direction& m,
                      const Alpha& a) { return ndf(o, m, a) * dot(o, m) / o[2]; },
                  true));
        add("the division by the cosine of wo is left out",
            about([=](const Direction& o, const Direction& m,
                      const Alpha& a) { return normals(o, m, a) * o[2]; },
                  true));
        add("wo.wm is left out", about([=](const Direction& o, const Direction& m,
                                           const Alpha& a) { return normals(o, m, a) / dot(o, m); },
                                       true));
        add("G2 stands in place of G1", about(
                                            [=](const Direction& o, const Direction& m, const Alpha& a) {
                                                return normals(o, m, a) *
                                                       value(own + "g2", o, reflect(o, m), a) /
                                                       value(own + "g1", o, a);
                                            },
                                            true));
        add("wo is taken to point to the surface: its sign is wrong",
            [=](const Direction& o, const Direction& w, const Alpha& a) { return right(-o, w, a); });
        add("wo is turned by half a turn about the normal: x and y have the wrong sign",
            [=](const Direction& o, const Direction& w, const Alpha& a) {
                return right({-o[0], -o[1], o[2]}, w, a);
            });
    }
    if (!plain && !ggx)
        add("masking is the rational fit of Walter et al. 2007, off by up to half a hundredth",
            about(
                [=](const Direction& o, const Direction& m, const Alpha& a) {
                    const double cot = o[2] / std::hypot(a[0] * o[0], a[1] * o[1]);
                    const double fit =
                        cot < 1.6 ? (3.535 * cot + 2.181 * cot * cot) / (1 + 2.276 * cot + 2.577 * cot * cot)
                                  : 1;
                    return normals(o, m, a) * fit / value(own + "g1", o, a);
                },
                true));
    if (!mirrored) {
        add("the Jacobian of the reflection is in it: it is a density of wi, not of wm",
            [=](const Direction& o, const Direction& m, const Alpha& a) {
                return normals(o, m, a) / (4 * dot(o, m));
            });
        return all;
    }
    add("the Jacobian of the reflection, 1 / (4 wo.wm), is missing: it is a density of wm, not of wi",
        about(normals, false));
    add("visibility (G1) and the Jacobian of the reflection are missing: it is the density D cos of all "
        "normals",
        about(all_normals(own), false));
    add("it is D / 4, without visibility and wo.wm",
        about(
            [=](const Direction& o, const Direction& m, const Alpha& a) { return ndf(o, m, a) * dot(o, m); },
            true));
    add("the Jacobian has wi.n in place of wo.wm",
        [=](const Direction& o, const Direction& i, const Alpha& a) {
            return normals(o, normalised(o + i), a) / (4 * i[2]);
        });
    add("the Jacobian has wm.n in place of wo.wm",
        [=](const Direction& o, const Direction& i, const Alpha& a) {
            const Direction h = normalised(o + i);
            return normals(o, h, a) / (4 * h[2]);
        });
    add("it is the weight of a sample, not its density",
        [=](const Direction& o, const Direction& i, const Alpha& a) {
            return value(own + "weight", o, i, a);
        });
    const auto brdf = [=](const Direction& o, const Direction& i, const Alpha& a) {
        return value(own + "pdf_wi", o, i, a) * value(own + "weight", o, i, a);
    };
    add("it is the value of the BRDF times the cosine, not the density", brdf);
    add("it is the value of the BRDF, not the density",
        [=](const Direction& o, const Direction& i, const Alpha& a) { return brdf(o, i, a) / i[2]; });
    if (density.support != Support::mirrored)
        add("it is the density of all visible normals, not of a cap", about(visible(own), true));
    else if (ggx)
        add("it is the density of the bounded cap of 2023",
            [](const Direction& o, const Direction& i, const Alpha& a) {
                return value("vndf_ggx_pdf_wi_eto2023", o, i, a);
            });
    return all;
}

// Terms of a direction or two: the same about alpha and the distribution.
std::vector<Guess> terms(const Function& term, bool takes_wo, bool takes_w) {
    const auto evaluated = [=](const std::string& name) -> Value {
        const auto evaluation = reference::find_evaluation<double>(name);
        return [=](const Direction& o, const Direction& w, const Alpha& a) {
            std::vector<double> in;
            if (takes_wo) in.insert(in.end(), o.begin(), o.end());
            if (takes_w) in.insert(in.end(), w.begin(), w.end());
            in.insert(in.end(), a.begin(), a.end());
            double out[4];
            evaluation(in.data(), out, reference::Precision::f32);
            return out[0];
        };
    };
    const Value right = evaluated(term.model);
    std::vector<Guess> all{{"", right}};
    add_alphas(all, right);
    const std::string ggx = "vndf_ggx_", beckmann = "vndf_beckmann_";
    const bool is_ggx = term.model.starts_with(ggx);
    const std::string other = is_ggx ? beckmann + term.model.substr(ggx.size())
                                     : ggx + term.model.substr(std::min(beckmann.size(), term.model.size()));
    if (reference::find_evaluation<double>(other))
        all.push_back({is_ggx ? "it is Beckmann's, not that of GGX" : "it is that of GGX, not Beckmann's",
                       evaluated(other)});
    return all;
}

std::vector<Guess> guesses_of(const Function& function) {
    const auto takes = [&](const char* name) { return column(function, name) >= 0; };
    if (takes("n_x") || !takes("alpha_x") || takes("slope_x") || function.outputs.size() != 1) return {};
    if (function.kind == Kind::density) return densities(function);
    return terms(function, takes("wo_x") || takes("w_x"), takes("wi_x") || takes("wm_x"));
}

const char* name_of_factor(double factor) {
    constexpr double pi = 3.14159265358979323846;
    struct Known {
        double factor;
        const char* name;
    };
    static constexpr Known known[] = {
        {2, "2"},         {4, "4"},         {.5, "1/2"},           {.25, "1/4"},     {pi, "pi"},
        {1 / pi, "1/pi"}, {2 * pi, "2 pi"}, {.5 / pi, "1/(2 pi)"}, {4 * pi, "4 pi"}, {.25 / pi, "1/(4 pi)"}};
    for (const Known& k : known)
        if (std::abs(factor / k.factor - 1) < 2e-3) return k.name;
    return nullptr;
}

// Ratios of the values to those of a guess: where half of them lie, and how far apart all but a tenth are.
struct Ratios {
    double median = 0, spread = 0;
};
Ratios ratios(const std::vector<double>& values, const std::vector<double>& guessed) {
    std::vector<double> all;
    for (std::size_t i = 0; i < values.size(); ++i) {
        constexpr double nothing = 1e-30;
        if (std::abs(values[i]) < nothing && guessed[i] < nothing) continue;
        const double ratio = values[i] / guessed[i];
        if (!std::isfinite(ratio)) return {0, 1e30};
        all.push_back(ratio);
    }
    if (all.size() < values.size() / 4) return {0, 1e30};
    std::sort(all.begin(), all.end());
    const std::size_t n = all.size();
    const double median = all[n / 2];
    return {median, median > 0 ? (all[n - 1 - n / 20] - all[n / 20]) / median : 1e30};
}

}  // namespace

Mistake mistake_of_value(runtime::Evaluator& evaluator, const Function& function, const Scope& scope,
                         std::uint64_t seed) {
    const std::vector<Guess> guesses = guesses_of(function);
    if (guesses.empty()) return {};
    // Where no formula has anything to lose: away from grazing, and rough.
    Scope easy = scope;
    easy.domain = Domain::upper;
    easy.alpha.low = std::clamp(.15, scope.alpha.low, scope.alpha.high);
    easy.alpha.high = std::clamp(.8, easy.alpha.low, scope.alpha.high);
    std::vector<Point> points = scoped_points(function, easy, 2048, seed);
    const bool of_wi = column(function, "wi_x") >= 0, of_wm = column(function, "wm_x") >= 0;
    std::erase_if(points, [&](const Point& p) {
        return !(p.cos_theta > .1) || (of_wi && !(p.wi[2] > .05)) || !(dot(p.wo, p.wm) > .05) ||
               !(p.wm[2] > .3);
    });
    const Table table = tabulate(function, points, evaluator.input_real());
    const std::vector<double> values = evaluate(evaluator, function, table).front();
    const auto zeros = static_cast<std::size_t>(std::count(values.begin(), values.end(), 0));
    if (zeros > values.size() - values.size() / 10)
        return {"it is 0 where it is not, as if wo pointed to the surface, or another side were up",
                fmt::format("{} of {} values", zeros, values.size())};
    struct Fit {
        const Guess* guess = nullptr;
        Ratios ratios;
    };
    std::optional<Fit> best;
    for (const Guess& guess : guesses) {
        std::vector<double> guessed;
        for (std::size_t i = 0; i < points.size(); ++i) {
            const Point& p = points[i];
            guessed.push_back(guess.value(p.wo, of_wi ? p.wi : of_wm ? p.wm : p.wo, p.alpha));
        }
        const Ratios r = ratios(values, guessed);
        if (!(r.spread < 2e-3)) continue;
        if (!best || (std::abs(best->ratios.median - 1) > 2e-3 && std::abs(r.median - 1) < 2e-3))
            best = Fit{&guess, r};
    }
    if (!best) return {};
    const double factor = best->ratios.median;
    const bool scaled = std::abs(factor - 1) > 2e-3;
    if (!scaled && best->guess->what.empty()) return {"", "", true};
    std::string what = best->guess->what;
    if (scaled) {
        const char* const name = name_of_factor(factor);
        what += fmt::format("{}it is {} times what it should be", what.empty() ? "" : ", and ",
                            name ? std::string(name) : fmt::format("{:.4g}", factor));
    }
    return {what, fmt::format("so it is, within {:.1g}, at 90 % of {} inputs",
                              std::max(best->ratios.spread, 1e-6), points.size())};
}

}  // namespace vndf::conformance
