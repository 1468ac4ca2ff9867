// What is claimed of every material: its value, its density, its samples.
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <numeric>
#include <set>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "conformance/judge/statistics.h"
#include "reference/integrals.h"
#include "reference/materials.h"
#include "runtime/evaluator.h"
#include "registry.h"
#include "splitmix64.h"
#include "support/bsdf_program.h"
#include "support/catch.h"
#include "support/shard.h"
#include "support/skip.h"

namespace {

using namespace vndf;
using reference::MaterialModel;
using Vector = reference::Vec3<double>;
using Parameters = reference::MaterialParameters<double>;
using View = reference::MaterialView<double>;

constexpr double pi = 3.14159265358979323846, eps = 0x1p-24;

// --- Choices ---

struct Choice {
    std::string switches;
    MaterialModel model;
};

Choice choice_of(const std::string& ndf, const std::string& sampling, const std::string& fresnel,
                 const std::string& masking, const std::string& transport,
                 const std::string& energy = "none") {
    using M = MaterialModel;
    const std::map<std::string, M::Sampling> samplings{{"plain", M::Sampling::plain},
                                                       {"bounded", M::Sampling::bounded},
                                                       {"conic", M::Sampling::conic},
                                                       {"tilted", M::Sampling::tilted}};
    const std::map<std::string, M::Fresnel> fresnels{{"none", M::Fresnel::none},
                                                     {"conductor", M::Fresnel::conductor},
                                                     {"schlick", M::Fresnel::schlick},
                                                     {"f82", M::Fresnel::f82}};
    Choice choice;
    choice.switches = fmt::format("NDF={} SAMPLING={} FRESNEL={} MASKING={} TRANSPORT={}", ndf, sampling,
                                  fresnel, masking, transport);
    if (energy != "none") choice.switches += " ENERGY=" + energy;
    choice.model.ndf = ndf == "beckmann" ? M::Ndf::beckmann : M::Ndf::ggx;
    choice.model.sampling = samplings.at(sampling);
    choice.model.fresnel = fresnels.at(fresnel);
    choice.model.masking = masking == "separable" ? M::Masking::separable : M::Masking::correlated;
    choice.model.transport = transport == "importance" ? M::Transport::importance : M::Transport::radiance;
    choice.model.energy = energy == "none"      ? M::Energy::none
                          : energy == "turquin" ? M::Energy::turquin
                                                : M::Energy::kulla_conty;
    return choice;
}

// Each value of each choice at least once.
std::vector<Choice> some_choices() {
    return {choice_of("ggx", "bounded", "schlick", "correlated", "radiance"),
            choice_of("ggx", "plain", "conductor", "correlated", "importance"),
            choice_of("ggx", "conic", "f82", "separable", "radiance"),
            choice_of("ggx", "tilted", "schlick", "correlated", "radiance"),
            choice_of("beckmann", "plain", "conductor", "correlated", "radiance"),
            choice_of("beckmann", "plain", "none", "separable", "importance"),
            choice_of("ggx", "bounded", "conductor", "correlated", "radiance", "turquin"),
            choice_of("ggx", "plain", "none", "separable", "importance", "turquin"),
            choice_of("ggx", "bounded", "schlick", "correlated", "radiance", "kulla_conty"),
            choice_of("beckmann", "plain", "f82", "separable", "radiance", "kulla_conty")};
}

std::vector<Choice> all_choices() {
    std::vector<Choice> all;
    for (const auto& [ndf, sampling] : {std::pair{"ggx", "plain"},
                                        {"ggx", "bounded"},
                                        {"ggx", "conic"},
                                        {"ggx", "tilted"},
                                        {"beckmann", "plain"}})
        for (const char* fresnel : {"none", "conductor", "schlick", "f82"})
            for (const char* masking : {"correlated", "separable"})
                for (const char* energy : {"none", "turquin", "kulla_conty"})
                    all.push_back(choice_of(ndf, sampling, fresnel, masking,
                                            masking[0] == 'c' ? "radiance" : "importance", energy));
    return all;
}

// --- Tables ---

struct Row {
    Vector wo{0, 0, 1}, wi{0, 0, 1};
    Parameters material{.3, .3, {1, 1, 1}, {1, 1, 1}, {1, 1, 1}, {1, 1, 1}, 1,
                        1,  0,  {1, 1, 1}, 0,         0,         .1,        {0, 0, 1}};
    double u1 = .5, u2 = .5, u_lobe = .5;
    double dispersion = 0;
    int channel = 0;
    reference::Rgb<double> absorption{};
};

float rounded(double x) {
    return static_cast<float>(x);
}
Vector rounded(const Vector& v) {
    return {rounded(v.x), rounded(v.y), rounded(v.z)};
}
void append(std::vector<double>& to, const Vector& v) {
    to.insert(to.end(), {v.x, v.y, v.z});
}

Columns columns(const std::vector<Row>& rows, bool sampled) {
    Columns all(6 + bsdf_parameters.size());
    for (auto& column : all) column.reserve(rows.size());
    std::vector<double> values;
    for (const Row& row : rows) {
        values.clear();
        append(values, row.wo);
        if (sampled)
            values.insert(values.end(), {row.u1, row.u2, row.u_lobe});
        else
            append(values, row.wi);
        const Parameters& m = row.material;
        values.insert(values.end(), {m.alpha_x, m.alpha_y});
        for (const auto& c : {m.first, m.second, m.tint, m.albedo})
            values.insert(values.end(), c.begin(), c.end());
        values.insert(values.end(), {m.metal, m.ior, m.transmission});
        values.insert(values.end(), m.transmittance.begin(), m.transmittance.end());
        values.push_back(m.specular);
        values.insert(values.end(), m.specular_colour.begin(), m.specular_colour.end());
        values.push_back(m.thin_walled);
        values.insert(values.end(), {row.dispersion, static_cast<double>(row.channel)});
        values.insert(values.end(), row.absorption.begin(), row.absorption.end());
        values.insert(values.end(), {m.diffuse_roughness, m.coat, m.coat_alpha});
        append(values, m.ng);
        for (std::size_t i = 0; i < all.size(); ++i) all[i].push_back(values[i]);
    }
    return all;
}

template <class R>
reference::Vec3<R> as(const Vector& v) {
    return {v.x, v.y, v.z};
}
template <class R>
reference::Rgb<R> as(const reference::Rgb<double>& c) {
    return {c[0], c[1], c[2]};
}
template <class R>
reference::MaterialParameters<R> as(const Parameters& m) {
    return {m.alpha_x,
            m.alpha_y,
            as<R>(m.first),
            as<R>(m.second),
            as<R>(m.tint),
            as<R>(m.albedo),
            m.metal,
            m.ior,
            m.transmission,
            as<R>(m.transmittance),
            m.diffuse_roughness,
            m.coat,
            m.coat_alpha,
            as<R>(m.ng),
            m.specular,
            as<R>(m.specular_colour),
            m.thin_walled};
}

// The row in numbers that are exact in float.
Row rounded(Row row) {
    Parameters& m = row.material;
    row.wo = rounded(row.wo), row.wi = rounded(row.wi), m.ng = rounded(m.ng);
    for (double* x : {&m.alpha_x, &m.alpha_y, &m.metal, &m.ior, &m.transmission, &m.diffuse_roughness,
                      &m.coat, &m.coat_alpha, &m.specular, &row.u1, &row.u2, &row.u_lobe})
        *x = rounded(*x);
    for (auto* colour : {&m.first, &m.second, &m.tint, &m.albedo, &m.transmittance, &m.specular_colour})
        for (double& x : *colour) x = rounded(x);
    return row;
}

Vector direction(double cosine, double phi) {
    const double sine = std::sqrt((1 - cosine) * (1 + cosine));
    return {sine * std::cos(phi), sine * std::sin(phi), cosine};
}

class Draw : public SplitMix64 {
  public:
    using SplitMix64::SplitMix64;
    double any(double low, double high) { return low + (high - low) * uniform(); }
    bool chance(double p) { return uniform() < p; }
    double one_of(const std::vector<double>& values) {
        return values[static_cast<std::size_t>(uniform() * static_cast<double>(values.size()))];
    }
    Vector anywhere(double least = -1) { return direction(any(least, 1), any(0, 2 * pi)); }
};

// Materials and directions as scenes have them, wi often near the mirror image of wo.
std::vector<Row> ordinary_rows(std::size_t count, std::uint64_t seed, bool two_normals = true,
                               bool in_float = true) {
    Draw draw(seed);
    std::vector<Row> rows;
    while (rows.size() < count) {
        Row row;
        Parameters& m = row.material;
        m.alpha_x = std::exp(draw.any(std::log(1e-3), std::log(2.)));
        m.alpha_y = draw.chance(.4) ? m.alpha_x : std::exp(draw.any(std::log(1e-3), std::log(2.)));
        for (double& x : m.first) x = draw.any(.02, 1.6);
        for (double& x : m.second) x = draw.any(0, draw.chance(.5) ? 1 : 8);
        for (auto* colour : {&m.tint, &m.transmittance})
            for (double& x : *colour) x = draw.uniform();
        for (double& x : m.albedo) x = draw.uniform();
        m.metal = draw.chance(.3) ? 1 : draw.chance(.2) ? 0 : draw.uniform();
        m.ior = draw.chance(.3) ? 1 : std::exp(draw.any(-.7, 1.1));
        m.transmission = draw.chance(.3) ? 0 : draw.chance(.4) ? 1 : draw.uniform();
        m.ng = two_normals && draw.chance(.5) ? draw.anywhere(.4) : Vector{0, 0, 1};
        row.wo = draw.anywhere(two_normals ? -1 : .02);
        // A facet of about this roughness.
        const double tan = std::min(m.alpha_x, m.alpha_y) * std::exp(draw.any(-3, 2)),
                     phi = draw.any(0, 2 * pi);
        const double side = row.wo.z < 0 ? -1 : 1;
        const Vector h = reference::normalised<double>({tan * std::cos(phi), tan * std::sin(phi), side});
        row.wi = draw.chance(.3) ? draw.anywhere(two_normals ? -1 : .02) : reference::reflect(row.wo, h);
        if (m.transmission > 0 && draw.chance(.6)) {
            const Vector through = reference::refract(row.wo, h, side < 0 ? 1 / m.ior : m.ior);
            if (reference::dot(through, through) > 0) row.wi = through;
        }
        m.diffuse_roughness = draw.chance(.5) ? 0 : draw.uniform();
        m.coat = draw.chance(.5) ? 0 : draw.chance(.3) ? 1 : draw.uniform();
        m.coat_alpha = std::exp(draw.any(std::log(1e-3), 0));
        if (draw.chance(.4)) {
            m.specular = draw.chance(.3) ? 1 : draw.chance(.2) ? 0 : draw.uniform();
            for (double& x : m.specular_colour)
                x = draw.chance(.2) ? 0 : draw.any(0, draw.chance(.3) ? 30 : 2);
        }
        m.thin_walled = draw.chance(.3);
        if (m.thin_walled && m.transmission > 0 && draw.chance(.6)) {
            row.wi = reference::reflect(row.wo, h);
            row.wi.z = -row.wi.z;
        }
        rows.push_back(in_float ? rounded(row) : row);
    }
    return rows;
}

// The ends of every range, and beyond.
std::vector<Row> hard_rows(std::size_t count, std::uint64_t seed) {
    Draw draw(seed);
    const std::vector<double> alphas{0, 1e-8, 1e-6, 1e-4, 1e-2, .5, 1, 10, 1e3, 1e5},
        cosines{1, 1 - 1e-7, .9, .5, .1, 1e-3, 1e-5, 1e-7, 0, -1e-7, -1e-3, -.5, -1 + 1e-7, -1},
        edges{0, 0x1p-33, 0x1p-24, .25, .5, .75, 1 - 0x1p-24, 1}, reflectances{0, 1e-4, .04, .5, 1, 1.5, 1e3},
        others{0, 1e-30, 1e-4, .5, 1, 8, 1e4}, shares{0, 0x1p-40, .5, 1 - 0x1p-24, 1};
    std::vector<Row> rows;
    while (rows.size() < count) {
        Row row;
        Parameters& m = row.material;
        m.alpha_x = draw.one_of(alphas);
        m.alpha_y = draw.chance(.5) ? m.alpha_x : draw.one_of(alphas);
        for (double& x : m.first) x = draw.one_of(reflectances);
        for (double& x : m.second) x = draw.one_of(others);
        for (double& x : m.tint) x = draw.one_of({0, .5, 1});
        for (double& x : m.albedo) x = draw.one_of({0, .5, 1});
        m.metal = draw.one_of(shares);
        m.ior = draw.one_of({0, 1e-3, .1, .6, 1 - 0x1p-24, 1, 1 + 0x1p-23, 1.0001, 1.5, 4, 1e3, 1e5});
        m.transmission = draw.one_of(shares);
        for (double& x : m.transmittance) x = draw.one_of({0, .5, 1});
        m.ng = draw.chance(.5) ? Vector{0, 0, 1} : direction(draw.one_of(cosines), draw.any(0, 2 * pi));
        row.wo = direction(draw.one_of(cosines), draw.one_of({0, .7, 3}));
        row.wi = draw.chance(.3)   ? Vector{-row.wo.x, -row.wo.y, row.wo.z}
                 : draw.chance(.1) ? Vector{-row.wo.x, -row.wo.y, -row.wo.z}
                                   : direction(draw.one_of(cosines), draw.one_of({0, .7, 3}));
        m.diffuse_roughness = draw.one_of(shares), m.coat = draw.chance(.5) ? 0 : draw.one_of(shares),
        m.coat_alpha = draw.one_of(alphas), m.specular = draw.chance(.5) ? 1 : draw.one_of(shares);
        if (draw.chance(.5))
            for (double& x : m.specular_colour) x = draw.one_of({0, .5, 1, 30, 1e30});
        m.thin_walled = draw.chance(.3);
        row.u1 = draw.one_of(edges), row.u2 = draw.one_of(edges), row.u_lobe = draw.one_of(edges);
        rows.push_back(rounded(row));
    }
    return rows;
}

// --- Checks: the worst case of each, in the unit of its limit ---

struct Found {
    std::string check;
    double figure, limit;
    std::string where;
    bool passed() const { return figure <= limit; }
};
using Findings = std::vector<Found>;

std::string text(const Row& row) {
    const Parameters& m = row.material;
    const auto rgb = [](const auto& c) { return fmt::format("({:a} {:a} {:a})", c[0], c[1], c[2]); };
    return fmt::format(
        "wo ({:a} {:a} {:a}) wi ({:a} {:a} {:a}) alpha ({:a} {:a}) first {} second {} tint {} albedo {} "
        "metal {:a} ior {:a} transmission {:a} specular {:a} {} thin_walled {} diffuse_roughness {:a} coat "
        "{:a} {:a} ng ({:a} {:a} {:a}) u "
        "({:a} {:a}) u_lobe {:a}",
        row.wo.x, row.wo.y, row.wo.z, row.wi.x, row.wi.y, row.wi.z, m.alpha_x, m.alpha_y, rgb(m.first),
        rgb(m.second), rgb(m.tint), rgb(m.albedo), m.metal, m.ior, m.transmission, m.specular,
        rgb(m.specular_colour), m.thin_walled, m.diffuse_roughness, m.coat, m.coat_alpha, m.ng.x, m.ng.y,
        m.ng.z, row.u1, row.u2, row.u_lobe);
}

class Worst {
  public:
    Worst(std::string check, double limit) : found_{std::move(check), 0, limit, {}} {}
    void add(double figure, const Row& row) {
        if (std::isnan(figure)) figure = std::numeric_limits<double>::infinity();
        if (figure > found_.figure) found_.figure = figure, found_.where = text(row);
    }
    operator Found() const { return found_; }

  private:
    Found found_;
};

// Directions and alphas with the index behind the surface over that in front, as the device rounds it.
Columns with_index(Columns in, const std::vector<Row>& rows, runtime::Real real) {
    in.emplace_back();
    for (const Row& row : rows) {
        const Parameters& m = row.material;
        const double ior = std::clamp(m.ior, 1e-3, 1e3);
        const bool inside = reference::dot(row.wo, m.ng) < 0 && m.transmission > 0 && m.metal < 1;
        const double over = real == runtime::Real::f32 ? 1 / rounded(ior) : 1 / ior;
        in.back().push_back(inside && !m.thin_walled ? over : ior);
    }
    return in;
}

// What the device finds in its tables for the directions of each row, turned to the side of wo.
std::vector<reference::Losses<double>> losses_of(const Choice& choice, runtime::Real real,
                                                 const std::vector<Row>& rows) {
    std::vector<reference::Losses<double>> losses(rows.size());
    if (choice.model.energy == MaterialModel::Energy::none) return losses;
    static std::map<std::pair<std::string, runtime::Real>, BsdfProgram> programs;
    const BsdfProgram& program =
        programs
            .try_emplace({choice.switches, real}, choice.switches, std::vector<runtime::Substitution>{}, 0,
                         real, "kernels/batch/energy.cl")
            .first->second;
    const auto seen = [&](bool of_wo) {
        Columns in(5);
        for (const Row& row : rows) {
            const Vector& w = of_wo ? row.wo : row.wi;
            const double side = reference::dot(row.wo, row.material.ng) < 0 ? -1 : 1;
            const double values[5] = {w.x, w.y, side * w.z, row.material.alpha_x, row.material.alpha_y};
            for (int c = 0; c < 5; ++c) in[c].push_back(values[c]);
        }
        return in;
    };
    const auto found = [&](bool of_wo) { return program.run("vndf_batch_energy", seen(of_wo), 2); };
    const Columns o = found(true), i = found(false);
    for (std::size_t k = 0; k < rows.size(); ++k) losses[k] = {o[0][k], i[0][k], o[1][k]};
    if (choice.model.energy != MaterialModel::Energy::turquin) return losses;
    const Columns glass = program.run("vndf_batch_energy_glass", with_index(seen(true), rows, real), 2);
    for (std::size_t k = 0; k < rows.size(); ++k)
        losses[k].reflected = glass[0][k], losses[k].refracted = glass[1][k];
    return losses;
}
template <class R>
reference::Losses<R> as(const reference::Losses<double>& losses) {
    return {losses.o, losses.i, losses.average, losses.reflected, losses.refracted};
}

double registered(const std::string& function, runtime::Real real = runtime::Real::f32) {
    for (const BsdfFunction& f : bsdf_functions())
        if (f.name == function) return real == runtime::Real::f32 ? f.float_bound : f.double_bound;
    throw std::logic_error("no bound of " + function);
}

// Value and density against the reference: errors over what the rounding of the reflectance's cosine, of a height above the
// geometric horizon and of the exponent can do.
template <class R>
Findings check_values_as(const Choice& choice, const BsdfProgram& program, std::size_t count) {
    const runtime::Real real = program.real();
    const bool is_double = real == runtime::Real::f64;
    const R eps = is_double ? R(0x1p-53) : R(0x1p-24), infinity = std::numeric_limits<R>::infinity();
    Worst value("value", registered("vndf_bsdf_eval", real)),
        density("density", registered("vndf_bsdf_pdf", real));
    const std::vector<Row> rows = ordinary_rows(count, 3, true, !is_double);
    const Columns out = program.eval_pdf(columns(rows, false));
    const auto losses = losses_of(choice, real, rows);
    for (std::size_t i = 0; i < rows.size(); ++i) {
        const Row& row = rows[i];
        const reference::MaterialView<R> view(
            choice.model, as<R>(row.material), as<R>(row.wo),
            is_double ? reference::Precision::f64 : reference::Precision::f32);
        const auto exact = view(as<R>(row.wi), as<R>(losses[i]));
        if (!exact.settled) continue;
        const R unit = eps * (1 + 2 * exact.exponent);
        const auto judge = [&](Worst& worst, double got, R right, R slope) {
            if (right > R(0x1p-100))
                worst.add(static_cast<double>(std::abs(got - right) / (unit * (right + slope))), row);
            else if (right == 0)
                worst.add(static_cast<double>(got > 0 ? infinity : R(0)), row);
        };
        for (int c = 0; c < 3; ++c) judge(value, out[c][i], exact.f[c], exact.slope[c]);
        judge(density, out[3][i], exact.pdf, exact.pdf_slope);
    }
    return {value, density};
}
Findings check_values(const Choice& choice, const BsdfProgram& program, std::size_t count) {
    return program.real() == runtime::Real::f32 ? check_values_as<double>(choice, program, count)
                                                : check_values_as<long double>(choice, program, count);
}

// The weight of a sample is value over density where it points; its density is the separate one where rounding the
// direction cannot move that.
Findings check_weights(const Choice& choice, const BsdfProgram& program, std::size_t count) {
    Worst weight("weight is value over density", registered("vndf_bsdf_sample")),
        density("densities agree", 1e-3);
    Draw draw(5);
    std::vector<Row> rows = ordinary_rows(count / 2, 4), hard = hard_rows(count / 2, 4);
    rows.insert(rows.end(), hard.begin(), hard.end());
    for (std::size_t i = 0; i < count / 2; ++i)
        rows[i].u1 = draw.uniform(), rows[i].u2 = draw.uniform(), rows[i].u_lobe = draw.uniform();
    for (Row& row : rows) row = rounded(row);
    const Columns samples = program.sample(columns(rows, true));
    for (std::size_t i = 0; i < rows.size(); ++i) rows[i].wi = {samples[0][i], samples[1][i], samples[2][i]};
    const Columns values = program.eval_pdf(columns(rows, false));
    for (std::size_t i = 0; i < rows.size(); ++i) {
        const double pdf = values[3][i];
        if (!(pdf > 0)) continue;
        // Lost: on the side that its lobe does not light, or where the sampler keeps nothing.
        if (samples[6][i] == 0 &&
            (rows[i].material.transmission > 0 || choice.model.sampling == MaterialModel::Sampling::tilted)) {
            for (int c = 3; c < 6; ++c) weight.add(samples[c][i] / eps, rows[i]);
            continue;
        }
        for (int c = 0; c < 3; ++c) {
            const double w = samples[3 + c][i], ratio = values[c][i] / pdf;
            const double lost = 0x1p-149 / pdf;  // of a value that is no normal number
            weight.add((std::abs(w - ratio) - lost) / (eps * std::max(1., w)), rows[i]);
        }
        const Parameters& m = rows[i].material;
        // Behind the shading normal Beckmann's density is steeper than that, and nothing is reflected.
        const bool behind = reference::dot(rows[i].wo, m.ng) * rows[i].wo.z < 0;
        const bool steep = behind && choice.model.ndf == MaterialModel::Ndf::beckmann;
        // Next to index 1 a refraction's is the more so the less it bends.
        const bool faint = m.transmission > 0 && std::abs(m.ior - 1) < .1;
        const double least = std::min({m.alpha_x, m.alpha_y, m.coat > 0 ? m.coat_alpha : 1});
        if (i < count / 2 && least > .05 && !steep && !faint)
            density.add(std::abs(samples[6][i] / pdf - 1), rows[i]);
    }
    return {weight, density};
}

// What makes importance of a weight.
double in_importance(const Choice& choice, const Row& row, double lobe) {
    if (lobe != 3 || row.material.thin_walled ||
        choice.model.transport == MaterialModel::Transport::importance)
        return 1;
    const double ior = std::clamp(row.material.ior, 1e-3, 1e3);
    return reference::dot(row.wo, row.material.ng) < 0 ? 1 / (ior * ior) : ior * ior;
}
// Whether no sample of a material weighs more than 1: not where the lobe is chosen before the normal, or for its smooth
// interface, nor of a lobe drawn by another law than its own.
bool weighs_one(const Choice& choice, const Parameters& m) {
    if (m.coat > 0 || (m.diffuse_roughness > 0 && m.metal < 1 && m.transmission < 1)) return false;
    return m.metal >= 1 || m.ior == 1 ||
           (choice.model.sampling == MaterialModel::Sampling::plain && m.transmission >= 1);
}

// Finite, not negative, of unit length, and no more than all of the light.
Findings check_hard(const Choice& choice, const BsdfProgram& program, std::size_t count) {
    Worst finite("finite and not negative", 0), unit("unit length", length_bound("WI")),
        energy("weight at most 1", 4);
    const std::vector<Row> rows = hard_rows(count, 6);
    const Columns values = program.eval_pdf(columns(rows, false)),
                  samples = program.sample(columns(rows, true));
    const auto bad = [](double x) { return !std::isfinite(x) || x < 0; };
    for (std::size_t i = 0; i < rows.size(); ++i) {
        for (const auto& column : values) finite.add(bad(column[i]), rows[i]);
        for (std::size_t c = 3; c < 7; ++c) finite.add(bad(samples[c][i]), rows[i]);
        const double x = samples[0][i], y = samples[1][i], z = samples[2][i];
        unit.add(std::abs(std::sqrt(x * x + y * y + z * z) - 1) / eps, rows[i]);
        if (!weighs_one(choice, rows[i].material)) continue;
        const double unit = in_importance(choice, rows[i], samples[7][i]);
        for (std::size_t c = 3; c < 6; ++c) energy.add((samples[c][i] * unit - 1) / eps, rows[i]);
    }
    if (choice.model.energy != MaterialModel::Energy::none) return {finite, unit};
    return {finite, unit, energy};
}

// The BSDF is the same for both directions exchanged, where there is one normal; of light that crosses the surface, over the
// square of the index where it arrives: f / cos(theta_i).
Findings check_reciprocity(const Choice& choice, const BsdfProgram& program, std::size_t count) {
    if (choice.model.energy == MaterialModel::Energy::turquin) return {};
    Worst worst("reciprocity", 2 * registered("vndf_bsdf_eval"));
    const std::vector<Row> rows = ordinary_rows(count, 7, false);
    std::vector<Row> turned = rows;
    for (Row& row : turned) std::swap(row.wo, row.wi);
    const Columns there = program.eval_pdf(columns(rows, false)),
                  back = program.eval_pdf(columns(turned, false));
    for (std::size_t i = 0; i < rows.size(); ++i) {
        const Row& row = rows[i];
        if (std::abs(row.wi.z) < .02) continue;
        const bool radiance = choice.model.transport == MaterialModel::Transport::radiance;
        const double square = row.material.ior * row.material.ior;
        const bool bent = row.wi.z < 0 && !row.material.thin_walled;
        const double scale = !bent ? 1 : radiance ? square : 1 / square;
        const auto exact = View(choice.model, row.material, row.wo, reference::Precision::f32)(row.wi),
                   turned_exact = View(choice.model, row.material, row.wi, reference::Precision::f32)(row.wo);
        if (!exact.settled || !turned_exact.settled) continue;
        for (int c = 0; c < 3; ++c) {
            const double a = there[c][i] * row.wo.z * scale, b = back[c][i] * std::abs(row.wi.z);
            const double slope =
                exact.f[c] > 0 ? exact.slope[c] / exact.f[c] + turned_exact.slope[c] / turned_exact.f[c] : 0;
            if (std::max(a, b) > 0x1p-100)
                worst.add(std::abs(a - b) / (eps * (1 + 2 * exact.exponent) * (1 + slope) * std::max(a, b)),
                          row);
        }
    }
    return {worst};
}

// --- Integrals over the sphere: theta and phi in bins of many midpoints ---

struct Grid {
    static constexpr int theta = 24, phi = 48;
    std::vector<Vector> node;
    std::vector<double> weight;
    std::vector<int> bin;
    explicit Grid(int fine) {
        const double step_t = pi / (theta * fine), step_p = 2 * pi / (phi * fine);
        for (int t = 0; t < theta * fine; ++t)
            for (int p = 0; p < phi * fine; ++p) {
                const double angle = (t + .5) * step_t;
                node.push_back(direction(std::cos(angle), (p + .5) * step_p));
                weight.push_back((std::cos(t * step_t) - std::cos((t + 1) * step_t)) * step_p);
                bin.push_back(t / fine * phi + p / fine);
            }
    }
    static int bin_of(const Vector& w) {
        const double turn = std::atan2(w.y, w.x) / (2 * pi);
        const int t = static_cast<int>(std::acos(std::clamp(w.z, -1., 1.)) / pi * theta);
        const int p = static_cast<int>((turn < 0 ? turn + 1 : turn) * phi);
        return std::min(t, theta - 1) * phi + std::min(p, phi - 1);
    }
};
// What a sum over midpoints is off by must not be seen beside the noise of so many samples.
const Grid& grid_for(std::size_t samples) {
    static const Grid coarse(8), fine(16);
    return samples <= 1 << 16 ? coarse : fine;
}

struct Lobe {
    double alpha_x, alpha_y, cosine, phi, metal, ior = 1, transmission = 0, diffuse_roughness = 0, coat = 0,
                                                 coat_alpha = .3, specular = 1, specular_colour = 1;
    bool thin_walled = false;
    double lean = 0;  // the angle of the geometric normal, away from wo
};
const std::vector<Lobe>& lobes() {
    static const std::vector<Lobe> all{
        {.3, .3, .6, .7, 1},
        {.6, .2, .9, 2, 1},
        {.25, .5, .15, -1, 1},
        {1, 1, .5, 0, 1},
        {.5, .5, -.7, 1, 1},
        {.3, .3, .6, .7, .4},
        {.6, .25, -.3, 2, .7},
        {.4, .4, .5, 0, 0},
        // Glass from outside and from inside, next to total reflection too; thinner behind; plastic;
        // everything.
        {.3, .3, .6, .7, 0, 1.5, 1},
        {.25, .5, -.8, 2, 0, 1.5, 1},
        {.3, .3, -.5, 1, 0, 1.5, 1},
        {.5, .3, .2, 0, 0, 1.5, 1},
        {.3, .4, .7, 1, 0, .7, 1},
        {.3, .3, .5, .7, 0, 1.5, 0},
        {.3, .5, .5, -2, .3, 1.8, .4},
        {.4, .3, -.6, 1, .2, 1.4, .6},
        // Rough diffuse in the open and under an interface; a coat over it, over metal and over everything, on glass from
        // outside and from inside.
        {.4, .4, .5, 1, 0, 1, 0, 1},
        {.3, .3, -.3, 2, .3, 1.5, 0, .6},
        {.4, .4, .6, .7, 0, 1, 0, .8, 1, .25},
        {.3, .6, .5, 2, 1, 1, 0, 0, .7, .2},
        {.3, .4, .4, 1, .3, 1.4, .5, .5, .8, .3},
        {.3, .3, .5, .7, 0, 1.5, 1, 0, 1, .2},
        {.4, .3, -.6, 1, 0, 1.5, 1, 0, 1, .3},
        // An interface that is weaker and brighter, and darker, on paint, on glass from inside too; thin walls, coated and in a mix.
        {.3, .4, .5, 1, 0, 1.5, 0, .5, 0, .3, .5, 3},
        {.3, .3, -.4, 1, 0, 1.5, 1, 0, 0, .3, .6, .2},
        {.4, .4, .6, -1, .2, 1.5, .5, 0, 0, .3, .7, 8},
        {.3, .3, .5, .7, 0, 1.5, 1, 0, 0, .3, 1, 1, true},
        {.5, .25, -.4, 1, .2, 1.5, .7, 0, .6, .3, .8, 2, true},
        // Under a geometric normal that leans: metal, paint under a coat, glass from outside and from inside, a wall.
        {.3, .3, .6, .7, 1, 1, 0, 0, 0, .3, 1, 1, false, .5},
        {.5, .25, .5, 2, .3, 1.5, 0, 0, .6, .2, 1, 1, false, .4},
        {.4, .4, .7, -1, 0, 1.5, 1, 0, .5, .3, 1, 1, false, .5},
        {.4, .4, -.7, -1, 0, 1.5, 1, 0, .5, .3, 1, 1, false, .5},
        {.3, .5, .5, 1, .2, 1.5, .7, 0, 0, .3, 1, 1, true, .5}};
    return all;
}

// Samples against the reference's density; all light against what is reflected of it, by quadrature and by samples.
Findings check_lobes(const Choice& choice, const BsdfProgram& program, const std::vector<Lobe>& lobes,
                     std::size_t samples) {
    const double rate = conformance::sidak(1e-6, lobes.size());
    const Grid& grid = grid_for(samples);
    Found chi2{"chi2 of the directions", 0, 1, {}};
    Worst furnace("furnace", 1.002), kept("all light kept", .03), mean("mean weight", 6.5),
        lost("samples without weight", 6.5), closed("closed form at alpha = 1", 2e-3);
    for (const Lobe& lobe : lobes) {
        Row row;
        row.wo = direction(lobe.cosine, lobe.phi);
        row.material.alpha_x = lobe.alpha_x, row.material.alpha_y = lobe.alpha_y,
        row.material.metal = lobe.metal, row.material.ior = lobe.ior,
        row.material.transmission = lobe.transmission,
        row.material.diffuse_roughness = lobe.diffuse_roughness, row.material.coat = lobe.coat,
        row.material.coat_alpha = lobe.coat_alpha, row.material.specular = lobe.specular,
        row.material.specular_colour.fill(lobe.specular_colour), row.material.thin_walled = lobe.thin_walled;
        row.material.ng = direction(std::cos(lobe.lean), lobe.phi + pi);
        if (choice.model.fresnel == MaterialModel::Fresnel::conductor)
            row.material.first = {1e-3, 1e-3, 1e-3},
            row.material.second = {1e3, 1e3, 1e3};  // all but a mirror
        row = rounded(row);

        // What is expected of each bin, and of the whole.
        const View view(choice.model, row.material, row.wo, reference::Precision::f32);
        std::vector<double> expected(Grid::theta * Grid::phi);
        std::vector<Row> nodes(grid.node.size(), row);
        for (std::size_t i = 0; i < nodes.size(); ++i) nodes[i].wi = grid.node[i];
        const auto losses = losses_of(choice, program.real(), nodes);
        for (std::size_t i = 0; i < nodes.size(); ++i)
            expected[grid.bin[i]] +=
                view.density(grid.node[i], losses[i]) * grid.weight[i] * static_cast<double>(samples);
        const double total = std::accumulate(expected.begin(), expected.end(), 0.);
        // Of light that crosses the surface, reflections below it and refractions above are lost; and where a density knows of the
        // geometric normal, reflections below that.
        const bool leans = choice.model.sampling == MaterialModel::Sampling::tilted && lobe.lean != 0,
                   crosses = lobe.transmission > 0 && lobe.metal < 1, loses = crosses || leans;
        const Columns values = program.eval_pdf(columns(nodes, false));
        double albedo = 0;
        const auto scale = [&](const Vector& wi) {
            return in_importance(choice, row, crosses && wi.z * row.wo.z < 0 ? 3 : 0);
        };
        for (std::size_t i = 0; i < nodes.size(); ++i)
            albedo += values[0][i] * grid.weight[i] * scale(grid.node[i]);

        std::vector<Row> rows(samples, row);
        Draw draw(9);
        for (Row& r : rows) r.u1 = draw.uniform(), r.u2 = draw.uniform(), r.u_lobe = draw.uniform();
        const Columns drawn = program.sample(columns(rows, true));
        std::vector<std::uint32_t> observed(expected.size());
        double sum = 0, squares = 0, missing = 0;
        for (std::size_t i = 0; i < samples; ++i) {
            const Vector wi{drawn[0][i], drawn[1][i], drawn[2][i]};
            if (loses && drawn[6][i] == 0)
                ++missing;
            else
                ++observed[Grid::bin_of(wi)];
            const double weight = drawn[3][i] * scale(wi);
            sum += weight, squares += weight * weight;
        }
        const double n = static_cast<double>(samples), average = sum / n;
        const double deviation = std::sqrt(std::max(squares / n - average * average, 1e-6) / n);
        for (double& x : expected) x *= (n - missing) / total;
        const double unseen = loses ? std::max(1 - total / n, 1e-6) : 0;
        lost.add(std::max(std::abs(missing / n - unseen) - 3e-3, 0.) / std::sqrt(std::max(unseen, 1e-6) / n),
                 row);
        const double p = conformance::chi_square(observed, expected).p;
        const double figure = p > 0 ? std::log(p) / std::log(rate) : std::numeric_limits<double>::infinity();
        if (!(figure <= chi2.figure)) chi2.figure = figure, chi2.where = text(row);
        const bool single = choice.model.energy == MaterialModel::Energy::none;
        // What the fits of a coat's albedo and of a rough surface under an interface may add.
        const double fitted = .004 * lobe.coat + (lobe.ior != 1 ? .003 * lobe.diffuse_roughness : 0);
        // What the tables of energy may add is not a dielectric's that keeps its loss.
        const bool raised = choice.model.energy == MaterialModel::Energy::turquin;
        const double tables = single ? 0 : .03 * (raised ? 1 : lobe.metal);
        const bool glass = raised && lobe.metal == 0 && lobe.transmission == 1 && lobe.specular == 1;
        // And what is below the geometric normal stays lost.
        if (single || lobe.lean != 0 || lobe.coat > 0 || (lobe.ior != 1 && !glass))
            furnace.add(albedo - fitted - tables, row);
        else
            kept.add(std::abs(albedo - 1), row);
        mean.add(std::max(std::abs(average - albedo) - 1e-3, 0.) / deviation, row);
        const double mu = std::abs(lobe.cosine);
        if (lobe.ior == 1 && lobe.coat == 0 && lobe.alpha_x == 1 && lobe.alpha_y == 1 && lobe.metal == 1 &&
            choice.model.ndf == MaterialModel::Ndf::ggx &&
            choice.model.masking == MaterialModel::Masking::correlated &&
            choice.model.fresnel != MaterialModel::Fresnel::conductor && single)
            closed.add(std::abs(albedo - (1 - mu * std::log(1 + 1 / mu))), row);
    }
    return {chi2, furnace, kept, mean, lost, closed};
}

// What an interface of index eta reflects of diffuse light inwards: from inside, all beyond the critical angle.
double reflected_inwards(double eta) {
    double sum = 1 - 1 / (eta * eta);
    const double rest = 1 / (eta * eta);
    // In the root of the distance from the critical angle, where the reflectance has one.
    reference::gauss<40>(0, 1, [&](double s, double weight) {
        const double cosine = std::sqrt(1 - rest * (1 - s * s));
        sum += reference::fresnel_dielectric<double>(cosine, 1 / eta) * rest * 2 * s * weight;
    });
    return sum;
}

// Paint under a smooth interface, against the integral that the kernels and the reference have a fit of.
Findings check_plastic(const Choice& choice, const BsdfProgram& program) {
    if (choice.model.energy != MaterialModel::Energy::none) return {};
    Worst worst("light between paint and interface", 1.4e-3);
    std::vector<Row> rows;
    for (int i = 0; i <= 300; ++i)
        for (const double albedo : {1., .5, .1}) {
            Row row;
            Parameters& m = row.material;
            m.metal = m.transmission = 0, m.alpha_x = m.alpha_y = 1e-6;
            m.ior = 1 + .01 * i;
            m.albedo = {albedo, albedo, albedo};
            row.wi = direction(.9, 0);
            rows.push_back(rounded(row));
        }
    const Columns values = program.eval_pdf(columns(rows, false));
    for (std::size_t i = 0; i < rows.size(); ++i) {
        const Row& row = rows[i];
        const double ior = row.material.ior, albedo = row.material.albedo[0];
        double expected = albedo / (ior * ior * (1 - albedo * reflected_inwards(ior))) * row.wi.z / pi;
        for (const Vector& w : {row.wo, row.wi})
            expected *= 1 - reference::fresnel_dielectric<double>(w.z, ior);
        worst.add(std::abs(values[0][i] / expected - 1), row);
    }
    return {worst};
}

Findings operator+(Findings a, const Findings& b) {
    a.insert(a.end(), b.begin(), b.end());
    return a;
}

Findings check_all(const Choice& choice, const BsdfProgram& program, std::size_t count,
                   const std::vector<Lobe>& lobes, std::size_t samples) {
    return check_values(choice, program, count) + check_weights(choice, program, count) +
           check_hard(choice, program, count) + check_reciprocity(choice, program, count) +
           check_plastic(choice, program) + check_lobes(choice, program, lobes, samples);
}

void expect_passed(const Choice& choice, const Findings& findings) {
    for (const Found& found : findings) {
        INFO(choice.switches << ": " << found.check << ": " << found.figure << " of " << found.limit << " at "
                             << found.where);
        CHECK(found.passed());
    }
}

// --- Between surfaces ---

// A function of the library for rows of arguments, as C++.
std::vector<float> results_of(const char* name, const std::vector<std::vector<float>>& arguments) {
    runtime::HostEvaluator evaluator(runtime::Math::strict, runtime::Real::f32);
    std::vector<float> result(arguments.front().size());
    std::vector<const void*> in;
    for (const auto& argument : arguments) in.push_back(argument.data());
    evaluator.run(*find_function(name), result.size(), in, {result.data()});
    return result;
}

// The index of a dispersion is that of vndf_eta_dispersed, to the bit, in everything that is asked of a material; what a body
// lets through that of vndf_transmittance.
Findings check_media(const Choice& choice, const BsdfProgram& program, std::size_t count) {
    if (choice.model.energy != MaterialModel::Energy::none) return {};
    Worst index("index of the channel", 0), left("light left by a body", 0);
    Draw draw(13);
    std::vector<Row> rows = ordinary_rows(count / 2, 13), hard = hard_rows(count / 2, 13);
    rows.insert(rows.end(), hard.begin(), hard.end());
    for (Row& row : rows) {
        row.u1 = draw.uniform(), row.u2 = draw.uniform(), row.u_lobe = draw.uniform();
        row.dispersion = draw.chance(.2) ? draw.one_of({0, 100, 1e9, -1}) : draw.any(0, 3);
        row.channel = static_cast<int>(draw.any(0, 3));
        for (double& x : row.absorption)
            x = draw.chance(.2) ? draw.one_of({0, 1e-30, 3e38, -1}) : std::exp(draw.any(-9, 5));
        row.dispersion = rounded(row.dispersion);
        for (double& x : row.absorption) x = rounded(x);
        row = rounded(row);
    }
    std::vector<std::vector<float>> arguments(3), way(2);
    for (const Row& row : rows) {
        arguments[0].push_back(rounded(row.material.ior));
        arguments[1].push_back(rounded(row.dispersion));
        arguments[2].push_back(row.channel == 0 ? 656.27f : row.channel == 1 ? 587.56f : 486.13f);
    }
    const std::vector<float> eta = results_of("vndf_eta_dispersed", arguments);
    std::vector<Row> plain = rows;
    for (std::size_t i = 0; i < rows.size(); ++i) plain[i].material.ior = eta[i], plain[i].dispersion = 0;
    const auto compare = [&](const Columns& a, const Columns& b) {
        for (std::size_t i = 0; i < rows.size(); ++i)
            for (std::size_t c = 0; c < a.size(); ++c) index.add(a[c][i] != b[c][i], rows[i]);
    };
    compare(program.eval_pdf(columns(rows, false)), program.eval_pdf(columns(plain, false)));
    compare(program.sample(columns(rows, true)), program.sample(columns(plain, true)));

    Columns in = columns(rows, true);
    in.erase(in.begin() + 1, in.begin() + 6);
    for (double& x : in.front())
        x = draw.chance(.2) ? draw.one_of({0, 3e38, -1}) : rounded(std::exp(draw.any(-9, 5)));
    const Columns through = program.transmittance(in);
    for (int c = 0; c < 3; ++c) {
        way = {{in.front().begin(), in.front().end()}, {}};
        for (const Row& row : rows) way[1].push_back(rounded(row.absorption[c]));
        const std::vector<float> expected = results_of("vndf_transmittance", way);
        for (std::size_t i = 0; i < rows.size(); ++i) left.add(through[c][i] != expected[i], rows[i]);
    }
    return {index, left};
}

// --- Seeded mistakes ---

struct Mistake {
    const char *what, *file, *old_text, *new_text, *switches;
    std::vector<std::string> noticed_by;
};
const std::vector<Mistake>& mistakes() {
    static const std::vector<Mistake> all{
#include "mutants.h"
    };
    return all;
}

Choice choice_with(const std::string& switches) {
    for (const Choice& choice : some_choices())
        if (choice.switches.find(switches) != std::string::npos) return choice;
    throw std::logic_error("no choice with " + switches);
}

}  // namespace

TEST_CASE("materials are what they are said to be") {
    for (const Choice& choice : some_choices())
        expect_passed(choice, check_all(choice, BsdfProgram(choice.switches), 1 << 14, lobes(), 1 << 15));
}

TEST_CASE("a dispersion is an index for each channel, and a body leaves of light what Beer's law says") {
    for (const Choice& choice : some_choices())
        expect_passed(choice, check_media(choice, BsdfProgram(choice.switches), 1 << 12));
}

TEST_CASE("index 1 lets everything straight through") {
    for (const Choice& choice : some_choices()) {
        if (choice.model.energy != MaterialModel::Energy::none) continue;
        const BsdfProgram program(choice.switches);
        Draw draw(11);
        std::vector<Row> rows = hard_rows(1 << 12, 12);
        for (Row& row : rows) {
            row.wo = draw.anywhere(draw.chance(.5) ? 1e-3 : -1);
            row.material.metal = 0, row.material.ior = row.material.transmission = 1,
            row.material.transmittance = {1, 1, 1}, row.material.coat = 0, row.material.ng = {0, 0, 1},
            row.material.thin_walled = false;
            row.u1 = draw.uniform(), row.u2 = draw.uniform(), row.u_lobe = draw.uniform();
            row = rounded(row);
        }
        const Columns drawn = program.sample(columns(rows, true));
        std::size_t wrong = 0;
        for (std::size_t i = 0; i < rows.size(); ++i) {
            const Vector& wo = rows[i].wo;
            const bool straight = drawn[0][i] == -wo.x && drawn[1][i] == -wo.y && drawn[2][i] == -wo.z;
            wrong +=
                !(straight && drawn[3][i] == 1 && drawn[5][i] == 1 && drawn[6][i] > 1e30 && drawn[7][i] == 3);
        }
        INFO(choice.switches);
        CHECK(wrong == 0);
    }
}

TEST_CASE("a rough diffuse surface loses what its fit says, and a white one reflects everything") {
    // The mean over azimuths of s / t, integrated by the cosine law, against what the reference takes for it.
    using Rough = reference::RoughDiffuse<double>;
    double loss = 0, white = 0;
    for (int k = 0; k <= 64; ++k) {
        const double z = std::max(k / 64., 1e-4);
        loss = std::max(loss, std::abs(Rough::loss(z) - Rough::exact_loss(z)));
        constexpr int fine = 256;
        double all = 0;
        for (int i = 0; i < fine; ++i)
            for (int j = 0; j < fine; ++j) {
                const double root = (i + .5) / fine, zi = root * root, phi = pi * (j + .5) / fine;
                const double s = std::sqrt((1 - z * z) * (1 - zi * zi)) * std::cos(phi);
                all += Rough{1}(1., z, zi, s) * 4 * zi * root / (fine * fine);
            }
        white = std::max(white, std::abs(all - 1));
    }
    CHECK(loss <= 2.6e-5);
    CHECK(white <= 1e-4);
}

TEST_CASE("under an interface a white rough diffuse surface reflects all of what gets in") {
    const BsdfProgram program("CONDUCTOR=0");
    // By how strong the interface is.
    std::map<double, double> worst;
    for (const auto& [strength, ior] : {std::pair{1., 1.05},
                                        {1., 1.2},
                                        {1., 1.33},
                                        {1., 1.5},
                                        {1., 2.},
                                        {1., 3.},
                                        {.5, 1.5},
                                        {.5, 3.},
                                        {0., 1.5},
                                        {0., 3.}})
        for (const double cosine : {.05, .3, .6, 1.}) {
            Row row;
            row.wo = direction(cosine, 0), row.material.metal = 0, row.material.ior = ior;
            row.material.specular = strength;
            row.material.diffuse_roughness = 1, row.material.alpha_x = row.material.alpha_y = 1e-3;
            std::vector<Row> rows(1 << 16, rounded(row));
            // By the diffuse lobe alone, whose samples begin where the others end.
            const double f = strength * reference::fresnel_dielectric(cosine, ior);
            Draw draw(9);
            for (Row& r : rows)
                r.u1 = draw.uniform(), r.u2 = draw.uniform(), r.u_lobe = f + (1 - f) * draw.uniform();
            const Columns drawn = program.sample(columns(rows, true));
            const double mean = std::accumulate(drawn[3].begin(), drawn[3].end(), 0.) / (1 << 16);
            worst[strength] = std::max(worst[strength], std::abs(mean - 1));
        }
    CAPTURE(worst[.5], worst[0]);
    CHECK(worst[1] <= 7e-3);
    CHECK(worst[.5] <= 1.5e-2);
    CHECK(worst[0] <= 1e-3);
}

TEST_CASE("a coat keeps what it reflects, and little more") {
    for (const char* ndf : {"ggx", "beckmann"}) {
        const Choice choice = choice_of(ndf, "plain", "none", "correlated", "radiance");
        const BsdfProgram program(choice.switches);
        double less = 0, more = 0, mean = 0, weights = 0;
        for (const double alpha : {.001, .05, .1, .2, .4, .7, 1.})
            for (const double cosine : {.02, .05, .1, .2, .35, .5, .65, .8, 1.}) {
                Row row;
                row.wo = direction(cosine, 0), row.material.metal = 0, row.material.albedo = {0, 0, 0};
                row.material.coat = 1, row.material.coat_alpha = alpha;
                std::vector<Row> rows(1 << 14, rounded(row));
                for (std::size_t i = 0; i < rows.size(); ++i)
                    rows[i].u1 = (static_cast<double>(i) + .5) / static_cast<double>(rows.size()),
                    rows[i].u2 = std::fmod(static_cast<double>(i) * .6180339887498949, 1), rows[i].u_lobe = 1;
                const Columns drawn = program.sample(columns(rows, true));
                // Each sample is the coat's, and its weight over the density of both.
                double reflected = 0;
                const double kept = reference::coat_albedo<double>(choice.model.ndf, cosine, alpha);
                for (std::size_t i = 0; i < rows.size(); ++i) {
                    REQUIRE(drawn[7][i] == 4);
                    const double both = drawn[6][i], base = (1 - kept) * std::max(drawn[2][i], 0.) / pi;
                    if (both > base) reflected += drawn[3][i] * both / (both - base) * kept;
                }
                const double error = kept - reflected / static_cast<double>(rows.size());
                less = std::max(less, -error), more = std::max(more, error);
                mean += error * cosine, weights += cosine;
            }
        INFO(ndf << ": less " << less << " more " << more << " mean " << mean / weights);
        CHECK(less <= 4e-3);
        CHECK(more <= .13);
        CHECK(mean / weights <= .02);
    }
}

TEST_CASE("materials in double are what they are said to be") {
    if (!runtime::choose_device().device.fp64) VNDF_SKIP("the device has no double");
    for (const Choice& choice : {some_choices()[0], some_choices()[3]})
        expect_passed(choice,
                      check_values(choice, BsdfProgram(choice.switches, {}, 0, runtime::Real::f64), 1 << 12));
}

TEST_CASE("every seeded mistake in a material is noticed") {
    std::vector<runtime::Substitution> all;
    for (const Mistake& m : mistakes())
        all.push_back({m.file, m.old_text, m.new_text, static_cast<int>(all.size()) + 1});
    const auto [part, parts] = shard();
    for (std::size_t i = part; i < all.size(); i += parts) {
        const Mistake& mistake = mistakes()[i];
        const Choice choice = choice_with(mistake.switches);
        const BsdfProgram program(choice.switches, {all[i]}, all[i].id);
        const std::vector<Lobe> some{{.3, .3, .6, .7, 1},
                                     {.6, .25, -.3, 2, .7},
                                     {.3, .3, .6, .7, 0, 1.5, 1},
                                     {.4, .3, -.6, 1, .2, 1.4, .6},
                                     {.3, .4, .2, 1, .3, 1.4, .5, .5, 1, .1},
                                     {.3, .3, .5, .7, .1, 1.5, .8, 0, 0, .3, .8, 2, true},
                                     {.4, .4, .6, .7, .5, 1.5, 0, 0, .3, .2, 1, 1, false, .5}};
        // Those checks alone that must notice it, each by the names of what it finds.
        Findings findings;
        const auto check = [&](const std::set<std::string>& names, const auto& found) {
            if (std::any_of(mistake.noticed_by.begin(), mistake.noticed_by.end(),
                            [&](const std::string& name) { return names.count(name) > 0; }))
                findings = findings + found();
        };
        check({"value", "density"}, [&] { return check_values(choice, program, 1 << 12); });
        check({"weight is value over density", "densities agree"},
              [&] { return check_weights(choice, program, 1 << 12); });
        check({"finite and not negative", "unit length", "weight at most 1"},
              [&] { return check_hard(choice, program, 1 << 12); });
        check({"reciprocity"}, [&] { return check_reciprocity(choice, program, 1 << 12); });
        check({"light between paint and interface"}, [&] { return check_plastic(choice, program); });
        check({"chi2 of the directions", "furnace", "all light kept", "mean weight"},
              [&] { return check_lobes(choice, program, some, 1 << 14); });
        check({"index of the channel", "light left by a body"},
              [&] { return check_media(choice, program, 1 << 10); });
        std::string failed;
        for (const Found& found : findings)
            if (!found.passed()) failed += " [" + found.check + "]";
        INFO(mistake.what << ": noticed by:" << failed);
        for (const std::string& check : mistake.noticed_by)
            CHECK(failed.find("[" + check + "]") != std::string::npos);
    }
}

// By hand: every choice, more of everything.
TEST_CASE("materials of every choice are what they are said to be", "[.bsdf-full]") {
    for (const Choice& choice : all_choices()) {
        const Findings findings = check_all(choice, BsdfProgram(choice.switches), items_by_hand(), lobes(),
                                            std::min<std::size_t>(items_by_hand(), 1 << 18));
        fmt::print("{}:", choice.switches);
        for (const Found& found : findings)
            fmt::print(" {} {:.3g} of {:.3g};", found.check, found.figure, found.limit);
        fmt::print("\n");
        expect_passed(choice, findings);
        const Findings doubles = check_values(choice, BsdfProgram(choice.switches, {}, 0, runtime::Real::f64),
                                              items_by_hand() / 8);
        for (const Found& found : doubles) fmt::print("  double: {} {:.3g};", found.check, found.figure);
        fmt::print("\n");
        expect_passed(choice, doubles);
    }
}
