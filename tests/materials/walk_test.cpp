// What is claimed of the walks on the microsurface: they lose no light, their estimates are of the density of their samples, and
// they end where rays on a surface with heights end.
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "conformance/judge/statistics.h"
#include "reference/walk.h"
#include "splitmix64.h"
#include "support/bsdf_program.h"
#include "support/catch.h"

namespace {

using namespace vndf;
using Vector = reference::Vec3<double>;

constexpr double pi = 3.14159265358979323846;
constexpr double rate = 1e-6;  // of false alarms, over all lobes of a run

// eta 0: the conductor, which reflects everything.
struct Lobe {
    std::string ndf;
    double alpha_x, alpha_y, cosine, phi, eta;
};

std::string text(const Lobe& lobe) {
    return fmt::format("{} alpha ({} {}) cosine {} eta {}", lobe.ndf, lobe.alpha_x, lobe.alpha_y, lobe.cosine,
                       lobe.eta);
}

std::vector<Lobe> some_lobes() {
    std::vector<Lobe> all;
    for (const char* ndf : {"ggx", "beckmann"})
        for (const double eta : {0., 1.5, 1 / 1.5})
            for (const Lobe& lobe :
                 {Lobe{ndf, 1, 1, .7, 0, eta}, Lobe{ndf, .2, .8, .3, .7, eta}, Lobe{ndf, .5, .5, .05, 1, eta},
                  Lobe{ndf, 1.5, .6, eta > 0 ? -.6 : .9, 2, eta}})
                all.push_back(lobe);
    return all;
}

Vector direction(double cosine, double phi) {
    const double sine = std::sqrt((1 - cosine) * (1 + cosine));
    return {sine * std::cos(phi), sine * std::sin(phi), cosine};
}

// Rows of the entry points' inputs.
class Rows {
  public:
    Rows(const Lobe& lobe, std::size_t count) : lobe_(lobe), columns_(8 + bsdf_parameters.size()) {
        const Vector wo = direction(lobe.cosine, lobe.phi);
        fill(0, wo.x, count), fill(1, wo.y, count), fill(2, wo.z, count);
        for (int i : {3, 4, 5}) fill(i, 0, count);
        fill(6, 0, count), fill(7, 1, count);
        for (std::size_t i = 0; i < count; ++i) columns_[6][i] = static_cast<double>(i);
        for (std::size_t i = 8; i < columns_.size(); ++i) fill(i, 1, count);
        fill(8, lobe.alpha_x, count), fill(9, lobe.alpha_y, count);
        if (lobe.eta > 0) fill(10, lobe.eta, count);
        const std::size_t ng = columns_.size() - 3;
        fill(ng, 0, count), fill(ng + 1, 0, count);
    }
    void set_wi(std::size_t i, const Vector& wi) {
        columns_[3][i] = wi.x, columns_[4][i] = wi.y, columns_[5][i] = wi.z;
    }
    Columns with_wi() const { return columns_; }
    Columns without_wi() const {
        Columns all = columns_;
        all.erase(all.begin() + 3, all.begin() + 6);
        return all;
    }

  private:
    void fill(std::size_t column, double x, std::size_t count) { columns_[column].assign(count, x); }
    Lobe lobe_;
    Columns columns_;
};

const BsdfProgram& program(const std::string& ndf) {
    static std::map<std::string, BsdfProgram> all;
    const auto found = all.find(ndf);
    if (found != all.end()) return found->second;
    return all
        .try_emplace(ndf, "NDF=" + ndf + " FRESNEL=none", std::vector<runtime::Substitution>{}, 0,
                     runtime::Real::f32, "kernels/batch/walk.cl")
        .first->second;
}

Columns samples(const BsdfProgram& program, const Lobe& lobe, std::size_t count) {
    const char* name =
        lobe.eta > 0 ? "vndf_batch_walk_dielectric_sample" : "vndf_batch_walk_conductor_sample";
    return program.run(name, Rows(lobe, count).without_wi(), 7);
}

// Bins of the sphere, 6 by cosine and 8 by azimuth.
constexpr int bins = 6 * 8;
int bin_of(const Vector& w) {
    const double turn = std::atan2(w.y, w.x) / (2 * pi);
    const int z = static_cast<int>((std::clamp(w.z, -1., 1.) + 1) / 2 * 6);
    const int p = static_cast<int>((turn < 0 ? turn + 1 : turn) * 8);
    return std::min(z, 5) * 8 + std::min(p, 7);
}

struct Found {
    std::string check;
    double figure, limit;
    bool passed() const { return figure <= limit; }
};
using Findings = std::vector<Found>;

// The estimates at directions all over the sphere: their integral, and that over each bin against the samples there.
Findings check_estimates(const BsdfProgram& program, const Lobe& lobe, std::size_t count) {
    const char* name = lobe.eta > 0 ? "vndf_batch_walk_dielectric_eval" : "vndf_batch_walk_conductor_eval";
    SplitMix64 draw(3);
    Rows rows(lobe, count);
    std::vector<Vector> wi(count);
    for (std::size_t i = 0; i < count; ++i) {
        wi[i] = direction(2 * draw.uniform() - 1, 2 * pi * draw.uniform());
        rows.set_wi(i, wi[i]);
    }
    const Columns values = program.run(name, rows.with_wi(), 3), drawn = samples(program, lobe, count);
    conformance::Sums all;
    std::array<conformance::Sums, bins> at{};
    std::array<double, bins> drawn_at{};
    double lost = 0, negative = 0;
    for (std::size_t i = 0; i < count; ++i) {
        const double x = 4 * pi * values[0][i];
        all.add(x), at[bin_of(wi[i])].add(x);
        drawn_at[bin_of({drawn[0][i], drawn[1][i], drawn[2][i]})] += drawn[3][i];
        lost += drawn[3][i] != 1;
        negative += !(x >= 0 && x < 1e30);
    }
    const double n = static_cast<double>(count);
    const auto errors = [n](const conformance::Sums& sums) {
        return std::sqrt(std::max(sums.squares / n - sums.sum * sums.sum / n / n, 0.) / n);
    };
    double bin = 0;
    for (int b = 0; b < bins; ++b) {
        const double share = drawn_at[b] / n, other = std::sqrt(share * (1 - share) / n);
        const double tolerance = std::hypot(errors(at[b]), other) + 1e-4;
        bin = std::max(bin, std::abs(at[b].sum / n - share) / tolerance);
    }
    return {{"walks given up", lost, 0},
            {"finite and not negative", negative, 0},
            {"furnace of the estimates", std::abs(all.sum / n - 1) / errors(all), 6.5},
            {"estimates where the samples are", bin, 6.5}};
}

struct Draw {
    SplitMix64 numbers{7};
    double operator()() { return numbers.uniform(); }
};

// Two samples of the same: bins by direction and by one facet, two, or more.
template <class N>
Found check_heights(const BsdfProgram& program, const Lobe& lobe, std::size_t count) {
    std::vector<double> ours(3 * bins), theirs(3 * bins);
    const Columns drawn = samples(program, lobe, count);
    const Vector wo = direction(lobe.cosine, lobe.phi);
    const bool below = wo.z < 0;  // the reference begins above
    Draw draw;
    reference::HeightWalk<N, Draw> walk(lobe.alpha_x, lobe.alpha_y, below ? 1 / lobe.eta : lobe.eta, draw);
    const auto put = [](std::vector<double>& to, const Vector& wi, double facets) {
        ++to[(std::min(static_cast<int>(facets), 3) - 1) * bins + bin_of(wi)];
    };
    for (std::size_t i = 0; i < count; ++i) {
        put(ours, {drawn[0][i], drawn[1][i], drawn[2][i]}, drawn[6][i]);
        const reference::Walked w = walk(below ? Vector{-wo.x, -wo.y, -wo.z} : wo);
        put(theirs, below ? Vector{-w.wi.x, -w.wi.y, -w.wi.z} : w.wi, w.facets);
    }
    // Against the mean of both each of the two counts is half of the statistic.
    std::vector<std::uint32_t> observed;
    std::vector<double> expected;
    for (const auto* counts : {&ours, &theirs})
        for (std::size_t i = 0; i < ours.size(); ++i)
            if (ours[i] + theirs[i] >= 20) {
                observed.push_back(static_cast<std::uint32_t>((*counts)[i]));
                expected.push_back((ours[i] + theirs[i]) / 2);
            }
    const conformance::ChiSquare chi2 = conformance::chi_square(observed, expected);
    // Of the cells, twice as many as are free: Wilson and Hilferty's normal limit of half the degrees.
    const double k = static_cast<double>(observed.size()) / 2 - 1,
                 z = (std::cbrt(chi2.statistic / k) - (1 - 2 / (9 * k))) / std::sqrt(2 / (9 * k));
    return {"ends as with heights", z, 6};
}

Findings check(const BsdfProgram& program, const Lobe& lobe, std::size_t count) {
    Findings all;
    // Directions all over the sphere do not find a narrow lobe: the estimates' variance would not be seen.
    const double width =
        std::min(lobe.alpha_x, lobe.alpha_y) * (lobe.eta > 0 ? std::abs(1 - 1 / lobe.eta) : 1);
    if (width > .15) all = check_estimates(program, lobe, count);
    all.push_back(lobe.ndf == "ggx" ? check_heights<reference::Ggx>(program, lobe, count / 4)
                                    : check_heights<reference::Beckmann>(program, lobe, count / 4));
    return all;
}

struct Mistake {
    const char *what, *file, *old_text, *new_text;
    double eta;
    std::vector<std::string> noticed_by;
};
const std::vector<Mistake> mistakes{
    {"a ray that counts a facet's depth twice",
     "kernels/vndf/walk_surface.h",
     "depth - VNDF_DIVIDE(way, leaves",
     "VNDF_R(2.0) * depth - VNDF_DIVIDE(way, leaves",
     0,
     {"ends as with heights"}},
    {"an estimate without what covers the way out",
     "kernels/vndf/walk_surface.h",
     "vndf_impl_exp(-optical) : VNDF_R(0.0)",
     "VNDF_R(1.0) : VNDF_R(0.0)",
     0,
     {"furnace of the estimates"}},
    {"normals of the plain distribution's other azimuth",
     "kernels/vndf/walk_conductor.h",
     "VNDF_MAKE2(walk.ray.u.b, walk.ray.u.c)",
     "VNDF_MAKE2(walk.ray.u.b * VNDF_R(0.5), walk.ray.u.c)",
     0,
     {"ends as with heights", "estimates where the samples are"}},
    {"one number for the way and for the facet",
     "kernels/vndf/walk_dielectric.h",
     "VNDF_MAKE2(walk.ray.u.b, walk.ray.u.c)",
     "VNDF_MAKE2(walk.ray.u.b, walk.ray.u.a)",
     1.5,
     {"ends as with heights"}},
    {"a depth that stays on the way through",
     "kernels/vndf/walk_dielectric.h",
     "walk.ray.depth = mirrored ? walk.ray.depth : vndf_impl_walk_other_depth(walk.ray.depth);",
     "(void)0;",
     1.5,
     {"ends as with heights", "estimates where the samples are"}},
    {"an index that stays on the way through",
     "kernels/vndf/walk_dielectric.h",
     "walk.eta = mirrored ? walk.eta : VNDF_DIVIDE(VNDF_R(1.0), walk.eta);",
     "(void)0;",
     1.5,
     {"ends as with heights"}},
    {"the Jacobian of the other index",
     "kernels/vndf/walk_dielectric.h",
     "vndf_jacobian_refract(back, wi, walk.eta)",
     "vndf_jacobian_refract(back, wi, VNDF_R(1.0) / walk.eta)",
     1.5,
     {"furnace of the estimates"}},
};

}  // namespace

TEST_CASE("a walk loses no light and ends as rays on a surface with heights") {
    for (const Lobe& lobe : some_lobes())
        for (const Found& found : check(program(lobe.ndf), lobe, 1 << 17)) {
            INFO(text(lobe) << ": " << found.check << ": " << found.figure << " of " << found.limit);
            CHECK(found.passed());
        }
}

TEST_CASE("every seeded mistake in a walk is noticed") {
    for (const Mistake& m : mistakes) {
        const BsdfProgram changed("FRESNEL=none", {{m.file, m.old_text, m.new_text, 1}}, 1,
                                  runtime::Real::f32, "kernels/batch/walk.cl");
        std::string failed;
        for (const Found& found : check(changed, {"ggx", 1, .5, .4, .5, m.eta}, 1 << 17))
            if (!found.passed()) failed += " [" + found.check + "]";
        INFO(m.what << ": noticed by:" << failed);
        for (const std::string& check : m.noticed_by)
            CHECK(failed.find("[" + check + "]") != std::string::npos);
    }
}

// By hand: more of everything, with the largest figures.
TEST_CASE("walks lose no light, at length", "[.walk-full]") {
    std::map<std::string, double> worst;
    for (const char* ndf : {"ggx", "beckmann"})
        for (const double eta : {0., 1.3, 1.5, 2.4, 1 / 1.5})
            for (const double alpha : {.05, .2, .5, 1., 2.})
                for (const double ratio : {1., .25})
                    for (const double cosine : {1., .7, .3, .05, -.5}) {
                        if (eta == 0 && cosine < 0) continue;
                        const Lobe lobe{ndf, alpha, ratio * alpha, cosine, .5, eta};
                        for (const Found& found : check(program(ndf), lobe, items_by_hand())) {
                            worst[found.check] = std::max(worst[found.check], found.figure);
                            INFO(text(lobe)
                                 << ": " << found.check << ": " << found.figure << " of " << found.limit);
                            CHECK(found.passed());
                        }
                    }
    for (const auto& [check, figure] : worst) fmt::print("{}: {:.3g}\n", check, figure);
}
