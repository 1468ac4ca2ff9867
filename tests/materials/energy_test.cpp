// What is claimed of the tables of energy: they are what the device measures, which is what quadrature finds; and with them no
// light is lost.
#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "energy/measure.h"
#include "error.h"
#include "reference/energy.h"
#include "reference/walk.h"
#include "runtime/sources.h"
#include "splitmix64.h"
#include "support/bsdf_program.h"
#include "support/catch.h"

namespace {

using namespace vndf;
using Vector = reference::Vec3<double>;

constexpr double pi = 3.14159265358979323846;

const std::vector<energy::Surface> surfaces{
    {"ggx", "correlated"}, {"ggx", "separable"}, {"beckmann", "correlated"}, {"beckmann", "separable"}};

std::string switches(const energy::Surface& s) {
    return fmt::format("NDF={} MASKING={} SAMPLING=plain FRESNEL=none", s.ndf, s.masking);
}

struct Point {
    Vector w;
    double alpha_x, alpha_y;
};

double by_quadrature(const energy::Surface& s, const Point& p) {
    const auto loss = s.ndf == "ggx" ? reference::directional_loss<reference::Ggx>
                                     : reference::directional_loss<reference::Beckmann>;
    return loss(s.masking == "separable", p.w, p.alpha_x, p.alpha_y);
}

Vector direction(double cosine, double phi) {
    const double sine = std::sqrt((1 - cosine) * (1 + cosine));
    return {sine * std::cos(phi), sine * std::sin(phi), cosine};
}

// Cosines often near the horizon; roughnesses from 1e-3 to 2, one up to `ratio` times the other.
std::vector<Point> points(std::size_t count, double ratio) {
    SplitMix64 draw(1);
    std::vector<Point> all;
    while (all.size() < count) {
        const double u = draw.uniform(), alpha = std::exp(std::log(1e-3) + draw.uniform() * std::log(2e3));
        const double other = std::exp((2 * draw.uniform() - 1) * std::log(ratio));
        all.push_back(
            {direction(draw.uniform() < .5 ? u : u * u * u, 2 * pi * draw.uniform()), alpha, alpha * other});
        if (all.back().alpha_y < 1e-3 || all.back().alpha_y > 2) all.pop_back();
    }
    return all;
}

Columns looked_up(const BsdfProgram& program, const std::vector<Point>& points) {
    Columns in(5);
    for (const Point& p : points) {
        const double values[5] = {p.w.x, p.w.y, p.w.z, p.alpha_x, p.alpha_y};
        for (int c = 0; c < 5; ++c) in[c].push_back(values[c]);
    }
    return program.run("vndf_batch_energy", in, 2);
}

BsdfProgram table_of(const energy::Surface& s, const std::vector<runtime::Substitution>& mutants = {}) {
    return BsdfProgram(switches(s), mutants, static_cast<int>(mutants.size()), runtime::Real::f32,
                       "kernels/batch/energy.cl");
}

// The largest error of a loss.
double table_error(const energy::Surface& s, const BsdfProgram& program, std::size_t count, double ratio) {
    const std::vector<Point> all = points(count, ratio);
    const Columns found = looked_up(program, all);
    double worst = 0;
    for (std::size_t i = 0; i < all.size(); ++i)
        worst = std::max(worst, std::abs(found[0][i] - by_quadrature(s, all[i])));
    return worst;
}

// As energy.h says.
struct Claim {
    double ratio, error;
};
const std::vector<Claim> claims{{1, 3.5e-3}, {2, .065}, {10, .13}};

// --- Glass ---

struct GlassPoint {
    Point p;
    double eta;
};
// Roughnesses to 1, indices from 1.02 to 3 on either side.
std::vector<GlassPoint> glass_points(std::size_t count, double ratio) {
    SplitMix64 draw(2);
    std::vector<GlassPoint> all;
    for (const Point& p : points(4 * count, ratio))
        if (p.alpha_x <= 1 && p.alpha_y <= 1 && all.size() < count)
            all.push_back({p, std::exp((draw.uniform() < .5 ? -1 : 1) *
                                       (std::log(1.02) + draw.uniform() * std::log(3 / 1.02)))});
    return all;
}

reference::GlassParts by_quadrature(const energy::Surface& s, const GlassPoint& g) {
    const auto parts = s.ndf == "ggx" ? reference::directional_parts<reference::Ggx>
                                      : reference::directional_parts<reference::Beckmann>;
    return parts(s.masking == "separable", g.p.w, g.p.alpha_x, g.p.alpha_y, g.eta);
}

Columns glass_looked_up(const BsdfProgram& program, const std::vector<GlassPoint>& points) {
    Columns in(6);
    for (const GlassPoint& g : points) {
        const double values[6] = {g.p.w.x, g.p.w.y, g.p.w.z, g.p.alpha_x, g.p.alpha_y, g.eta};
        for (int c = 0; c < 6; ++c) in[c].push_back(values[c]);
    }
    return program.run("vndf_batch_energy_glass", in, 2);
}

// Light that glass of each point has with its factors, less what falls on it: the largest, and the root of the mean square.
struct GlassError {
    double largest = 0, mean = 0;
};
GlassError glass_error(const energy::Surface& s, const BsdfProgram& program, std::size_t count,
                       double ratio) {
    const std::vector<GlassPoint> all = glass_points(count, ratio);
    const Columns factors = glass_looked_up(program, all);
    GlassError error;
    for (std::size_t i = 0; i < all.size(); ++i) {
        const reference::GlassParts parts = by_quadrature(s, all[i]);
        const double lost = factors[0][i] * parts.reflected + factors[1][i] * parts.refracted - 1;
        error.largest = std::max(error.largest, std::abs(lost));
        error.mean += lost * lost / static_cast<double>(all.size());
    }
    error.mean = std::sqrt(error.mean);
    return error;
}

// As energy_glass.h says.
struct GlassClaim {
    double ratio, largest, mean;
};
const std::vector<GlassClaim> glass_claims{{1, .08, .006}, {2, .2, .018}, {10, .35, .035}};

// Of walks over a surface with heights, those that end above it.
template <class N>
double walked_back(const GlassPoint& g, int walks) {
    SplitMix64 numbers(7);
    const auto draw = [&] { return numbers.uniform(); };
    reference::HeightWalk<N, decltype(draw)> walk(g.p.alpha_x, g.p.alpha_y, g.eta, draw);
    int back = 0;
    for (int i = 0; i < walks; ++i) back += walk(g.p.w).wi.z > 0;
    return static_cast<double>(back) / walks;
}

// The numbers of an array that a header has, the first one with a size in brackets.
std::vector<int> whole_numbers_of(const std::string& path) {
    std::vector<int> numbers;
    for (const runtime::SourceFile& file : runtime::embedded_sources())
        if (file.path == path) {
            std::istringstream text(std::string(file.text.substr(file.text.find("] = {") + 5)));
            for (int x = 0; text >> x; text.ignore()) numbers.push_back(x);
        }
    return numbers;
}

// One place of the table in `step`.
void expect_committed_glass(const energy::Surface& s, std::size_t step) {
    const energy::GlassViews all = energy::glass_views();
    energy::GlassViews some;
    for (std::size_t i = 0; i < all.views.size(); i += step)
        some.views.push_back(all.views[i]), some.etas.push_back(all.etas[i]);
    const std::vector<int> committed =
        whole_numbers_of(fmt::format("kernels/vndf/energy_glass_{}_{}.h", s.ndf, s.masking));
    CAPTURE(s.ndf, s.masking);
    REQUIRE(committed.size() == energy::GlassTable::numbers);
    const auto measured = energy::glass_albedos(runtime::choose_device().device, s, some.views, some.etas);
    std::size_t others = 0;
    for (std::size_t k = 0; k < measured.size(); ++k) {
        const std::vector<float> parts = energy::glass_parts_of(measured[k]);
        for (std::size_t c = 0; c < 2; ++c)
            others += committed[2 * step * k + c] != static_cast<int>(parts[c]);
    }
    CHECK(others == 0);
}

// All light on a white conductor against what it reflects: a mean of weights, over u and the choice of the lobe.
double reflected(const BsdfProgram& program, const Point& p) {
    constexpr int side = 256;
    Columns in(6 + bsdf_parameters.size(), std::vector<double>(side * side, 1));
    const double values[3] = {p.w.x, p.w.y, p.w.z};
    for (int i = 0; i < side * side; ++i) {
        for (int c = 0; c < 3; ++c) in[c][i] = values[c];
        in[3][i] = (i / side + .5) / side, in[4][i] = (i % side + .5) / side;
        in[5][i] = std::fmod(i * .6180339887498949, 1);
        in[6][i] = p.alpha_x, in[7][i] = p.alpha_y;
        in[21][i] = in[22][i] = 0;
        in[6 + material_parameter("coat")][i] = 0;
    }
    const Columns out = program.sample(in);
    double sum = 0;
    for (const double x : out[3]) sum += x;
    return sum / (side * side);
}

}  // namespace

TEST_CASE("the tables' losses are those by quadrature") {
    for (const energy::Surface& s : surfaces)
        for (const Claim& claim : claims) {
            CAPTURE(s.ndf, s.masking, claim.ratio);
            CHECK(table_error(s, table_of(s), 400, claim.ratio) <= claim.error);
        }
}

TEST_CASE("mistakes in the look-up are noticed by quadrature") {
    const std::vector<runtime::Substitution> mistakes{
        {"kernels/vndf/energy.h", "return vndf_impl_share(VNDF_SQRT(VNDF_R(0.5) * effective));",
         "return vndf_impl_share(VNDF_R(0.5) * effective);", 1},
        {"kernels/vndf/energy_place.h", "VNDF_REAL both = (r + l) * (r + z);",
         "VNDF_REAL both = (r + l) * (r + l);", 1},
        {"kernels/vndf/energy.h", "return VNDF_FMA(row.share, high - low, low);", "return low;", 1},
        {"kernels/vndf/energy.h", "VNDF_FMA(column.share, d - c, c);", "VNDF_FMA(column.share, c - d, c);",
         1}};
    for (const runtime::Substitution& mistake : mistakes) {
        CAPTURE(mistake.new_text);
        CHECK(table_error(surfaces[0], table_of(surfaces[0], {mistake}), 200, 1) > claims[0].error);
    }
}

// What `clvndf energy` wrote, to the last digit that it has.
TEST_CASE("the committed tables are what this device measures") {
    for (const energy::Surface& s : surfaces) {
        const std::string path = fmt::format("kernels/vndf/energy_{}_{}.h", s.ndf, s.masking);
        CAPTURE(path);
        const std::string header = energy::header(energy::measured(runtime::choose_device().device, s));
        std::string committed;
        for (const runtime::SourceFile& file : runtime::embedded_sources())
            if (file.path == path) committed = file.text;
        CHECK(header == committed);
    }
}

TEST_CASE("what the device measures is what quadrature finds") {
    for (const energy::Surface& s : surfaces) {
        std::vector<energy::View> views;
        const std::vector<Point> all = points(128, 4);
        for (const Point& p : all) views.push_back({p.w.x, p.w.y, p.w.z, p.alpha_x, p.alpha_y});
        const std::vector<double> losses = energy::losses(runtime::choose_device().device, s, views);
        double worst = 0;
        for (std::size_t i = 0; i < all.size(); ++i)
            worst = std::max(worst, std::abs(losses[i] - by_quadrature(s, all[i])));
        CAPTURE(s.ndf, s.masking);
        CHECK(worst < 1e-3);
    }
}

TEST_CASE("quadrature finds that glass loses no light with the factors of the table") {
    for (const energy::Surface& s : surfaces)
        for (const GlassClaim& claim : glass_claims) {
            CAPTURE(s.ndf, s.masking, claim.ratio);
            const GlassError error = glass_error(s, table_of(s), 80, claim.ratio);
            CHECK(error.largest <= claim.largest);
            CHECK(error.mean <= 1.5 * claim.mean);
        }
}

TEST_CASE("mistakes in the look-up of glass are noticed by quadrature") {
    const char* file = "kernels/vndf/energy_glass.h";
    const std::vector<runtime::Substitution> mistakes{
        {file, "VNDF_DIVIDE(VNDF_SQRT(square), vndf_impl_max(eta, VNDF_R(1.0)))", "VNDF_SQRT(square)", 1},
        {file, "(eta < VNDF_R(1.0) ? VNDF_ENERGY_GLASS_LAYERS : 0)",
         "(eta > VNDF_R(1.0) ? VNDF_ENERGY_GLASS_LAYERS : 0)", 1},
        {file, "vndf_impl_between_of(VNDF_SQRT(effective), VNDF_ENERGY_GLASS_ROWS)",
         "vndf_impl_between_of(effective, VNDF_ENERGY_GLASS_ROWS)", 1},
        {file, "VNDF_DIVIDE(l2, effective > VNDF_R(0.0) ? effective : VNDF_R(1.0))", "l2", 1},
        {file, "int other = back > VNDF_R(0.0) ? cell.first + 1 : 0;",
         "int other = back > VNDF_R(0.0) ? cell.first : 0;", 1},
        {file, "VNDF_FMA(cell.column, b - a, a)", "a", 1},
        {file, "VNDF_FMA(cell.layer, vndf_impl_glass_on_plane(cell, next) - low, low)", "low", 1},
        {file, "VNDF_FMA(cell.row, vndf_impl_glass_on_line(cell, next) - low, low)", "low", 1}};
    for (const runtime::Substitution& mistake : mistakes) {
        CAPTURE(mistake.new_text);
        const GlassError error = glass_error(surfaces[0], table_of(surfaces[0], {mistake}), 60, 1);
        CHECK(error.mean > 1.5 * glass_claims[0].mean);
    }
    // Across the grooves a direction sees another roughness than along them.
    const runtime::Substitution even{file, "VNDF_FMA(VNDF_R(0.5) * z * z, VNDF_FMA(ax, ax, ay * ay), l2)",
                                     "VNDF_R(0.5) * VNDF_FMA(ax, ax, ay * ay)", 1};
    CHECK(glass_error(surfaces[0], table_of(surfaces[0], {even}), 600, 10).largest > glass_claims[2].largest);
}

TEST_CASE("the committed tables of glass are what this device measures") {
    // A group of work-items each.
    for (const std::size_t k : {0, 3}) expect_committed_glass(surfaces[k], 83);
}

TEST_CASE("the committed tables of glass are what this device measures, all of them", "[.energy-full]") {
    for (const energy::Surface& s : surfaces) expect_committed_glass(s, 1);
}

TEST_CASE("what the device measures of glass is what quadrature and walks with heights find") {
    for (const energy::Surface& s : surfaces) {
        std::vector<energy::View> views;
        std::vector<double> etas;
        const std::vector<GlassPoint> all = glass_points(24, 4);
        for (const GlassPoint& g : all) {
            views.push_back({g.p.w.x, g.p.w.y, g.p.w.z, g.p.alpha_x, g.p.alpha_y});
            etas.push_back(g.eta);
        }
        constexpr int walks = 1 << 10;
        const auto found = energy::glass_albedos(runtime::choose_device().device, s, views, etas, 64, walks);
        double reflected = 0, refracted = 0, walked = 0;
        for (std::size_t i = 0; i < all.size(); ++i) {
            const reference::GlassParts parts = by_quadrature(s, all[i]);
            reflected = std::max(reflected, std::abs(found[i].reflected - parts.reflected));
            refracted = std::max(refracted, std::abs(found[i].refracted - parts.refracted));
            const double share = s.ndf == "ggx" ? walked_back<reference::Ggx>(all[i], walks)
                                                : walked_back<reference::Beckmann>(all[i], walks);
            walked = std::max(walked, std::abs(found[i].walk - share));
        }
        CAPTURE(s.ndf, s.masking);
        // What quadrature of Beckmann is off by at the edge of total reflection.
        CHECK(reflected < (s.ndf == "ggx" ? 1.5e-3 : 4e-3));
        CHECK(refracted < (s.ndf == "ggx" ? 1.5e-3 : 4e-3));
        CHECK(walked < 5 * std::sqrt(.5 / walks));
    }
}

TEST_CASE("with energy given back a white conductor loses no light") {
    for (const energy::Surface& s : surfaces) {
        const BsdfProgram tables = table_of(s);
        for (const char* model : {"turquin", "kulla_conty"}) {
            const BsdfProgram program(switches(s) + " ENERGY=" + model +
                                      " LAMBERT=0 DIELECTRIC=0 SHADING_NORMAL=0");
            for (const double alpha : {.001, .03, .1, .3, 1., 2.})
                for (const double cosine : {.02, .1, .4, .8, 1.}) {
                    const Point p{direction(cosine, .3), alpha, alpha};
                    const double kept = reflected(program, p), average = looked_up(tables, {p})[1][0];
                    CAPTURE(s.ndf, s.masking, model, alpha, cosine, average);
                    // A diffuse lobe that is mostly at grazing incidence is hardly ever drawn, and below 2^-9 fades.
                    const bool diffuse = model == std::string("kulla_conty");
                    const double error = diffuse && average < .01 ? .01 : claims[0].error;
                    CHECK(kept < 1 + error);
                    if (!diffuse || average > 0x1p-9) CHECK(kept > 1 - error);
                }
        }
    }
}

TEST_CASE("a kept table is read back, and a damaged one is found out") {
    energy::Table table{surfaces[0], std::vector<float>(energy::Table::rows * energy::Table::columns, .25f)};
    table.losses[7] = .1f;
    const std::string text = energy::kept(table);
    CHECK(energy::read_kept(surfaces[0], text, "file").losses == table.losses);
    const auto refused = [&](const energy::Surface& s, const std::string& changed) {
        CHECK_THROWS_AS(energy::read_kept(s, changed, "file"), InputError);
    };
    refused(surfaces[1], text);
    refused(surfaces[0], text.substr(0, text.size() - 1));
    refused(surfaces[0], text + "1\n");
    refused(surfaces[0], "");
    std::string changed = text;
    changed[text.size() / 2] ^= 1;
    refused(surfaces[0], changed);
    changed = text;
    changed.replace(text.find("table 1"), 7, "table 0");
    refused(surfaces[0], changed);
}

TEST_CASE("a kept table of glass is read back, and no other is taken for it") {
    energy::GlassTable table{surfaces[0], std::vector<float>(energy::GlassTable::numbers, 9876)};
    table.parts[7] = 12345;
    const std::string text = energy::kept(table), header = energy::header(table);
    CHECK(energy::read_kept_glass(surfaces[0], text, "file").parts == table.parts);
    CHECK_THROWS_AS(energy::read_kept_glass(surfaces[1], text, "file"), InputError);
    CHECK_THROWS_AS(energy::read_kept_glass(surfaces[0], text + "1\n", "file"), InputError);
    CHECK_THROWS_AS(energy::read_kept(surfaces[0], text, "file"), InputError);
    CHECK(header.find("unsigned short vndf_energy_glass_parts[10400] = {") != std::string::npos);
    CHECK(header.find(" 12345,") != std::string::npos);
}

namespace {

// Metals by eta and k: gold's red, green and blue.
constexpr double metal[3][2] = {{.18, 3.42}, {.42, 2.35}, {1.37, 1.77}};
using Albedos = std::array<double, 3>;  // for each channel

Columns metal_rows(const Point& p, std::size_t count, bool walk) {
    Columns in(walk ? 5 + bsdf_parameters.size() : 6 + bsdf_parameters.size(), std::vector<double>(count, 1));
    const std::size_t first = in.size() - bsdf_parameters.size();
    const double values[3] = {p.w.x, p.w.y, p.w.z};
    SplitMix64 draw(1);
    for (std::size_t i = 0; i < count; ++i) {
        for (int c = 0; c < 3; ++c) in[c][i] = values[c];
        for (std::size_t c = 3; c < first; ++c)
            in[c][i] = walk ? static_cast<double>(c == 3 ? i : 1) : draw.uniform();
        in[first][i] = p.alpha_x, in[first + 1][i] = p.alpha_y;
        for (int c = 0; c < 3; ++c) in[first + 2 + c][i] = metal[c][0], in[first + 5 + c][i] = metal[c][1];
        in[first + material_parameter("coat")][i] = 0;
        in[in.size() - 3][i] = in[in.size() - 2][i] = 0;  // ng
    }
    return in;
}

Albedos mean_weights(const Columns& out) {
    Albedos means{};
    for (int c = 0; c < 3; ++c)
        for (const double x : out[3 + c]) means[c] += x / static_cast<double>(out[3 + c].size());
    return means;
}

// How far the albedo of each model is from the walk's, at the worst of some directions.
std::map<std::string, Albedos> gaps(double alpha_x, double alpha_y, std::size_t count) {
    const std::string base = "FRESNEL=conductor";
    static const BsdfProgram walk(base, {}, 0, runtime::Real::f32, "kernels/batch/walk.cl");
    static const std::map<std::string, BsdfProgram> models = [&] {
        std::map<std::string, BsdfProgram> all;
        for (const char* model : {"none", "turquin", "kulla_conty"})
            all.try_emplace(model, base + " ENERGY=" + model);
        return all;
    }();
    std::map<std::string, Albedos> worst;
    for (const double cosine : {.1, .3, .6, 1.})
        for (const double phi : {0., pi / 2}) {
            const Point p{direction(cosine, phi), alpha_x, alpha_y};
            const Albedos truth =
                mean_weights(walk.run("vndf_batch_walk_conductor_sample", metal_rows(p, count, true), 7));
            for (const auto& [model, program] : models) {
                const Albedos found = mean_weights(program.sample(metal_rows(p, count, false)));
                for (int c = 0; c < 3; ++c)
                    worst[model][c] = std::max(worst[model][c], std::abs(found[c] - truth[c]));
            }
        }
    return worst;
}

}  // namespace

TEST_CASE("what gives energy back is nearer to the walk than what does not") {
    for (const auto& [x, y] : {std::pair{.5, .5}, {1., 1.}, {.8, .2}}) {
        const auto worst = gaps(x, y, 1 << 15);
        CAPTURE(x, y);
        for (int c = 0; c < 3; ++c)
            for (const char* model : {"turquin", "kulla_conty"}) {
                CAPTURE(model, c);
                CHECK(worst.at(model)[c] < .75 * worst.at("none")[c]);
                CHECK(worst.at(model)[c] < .08);
            }
    }
}

// By hand: the table of kernels/README.md.
TEST_CASE("the gap to the walk", "[.energy-gap]") {
    fmt::print("| alpha | none | turquin | kulla_conty |\n| --- | --- | --- | --- |\n");
    for (const auto& [x, y] :
         {std::pair{.1, .1}, {.3, .3}, {.5, .5}, {1., 1.}, {.4, .2}, {.5, .125}, {1., .25}, {1., .1}}) {
        const auto worst = gaps(x, y, items_by_hand());
        fmt::print("| {}, {} |", x, y);
        for (const char* model : {"none", "turquin", "kulla_conty"})
            fmt::print(" {:.3f}, {:.3f}, {:.3f} |", worst.at(model)[0], worst.at(model)[1],
                       worst.at(model)[2]);
        fmt::print("\n");
    }
}

namespace {

// What glass reflects and what it lets through.
struct Parts {
    double reflected = 0, through = 0;
};
Parts parts_of(const Columns& out) {
    Parts parts;
    const double n = static_cast<double>(out[3].size());
    for (std::size_t i = 0; i < out[3].size(); ++i)
        (out[2][i] > 0 ? parts.reflected : parts.through) += out[3][i] / n;
    return parts;
}

// How far both are from the walk's, at the worst of some directions.
Parts glass_gap(const char* energy, double alpha_x, double alpha_y, double eta, std::size_t count) {
    static std::map<std::string, BsdfProgram> models;
    static const BsdfProgram walk("", {}, 0, runtime::Real::f32, "kernels/batch/walk.cl");
    const BsdfProgram& model =
        models
            .try_emplace(energy,
                         fmt::format("CONDUCTOR=0 SAMPLING=plain TRANSPORT=importance ENERGY={}", energy))
            .first->second;
    Parts worst;
    for (const double cosine : {.1, .3, .6, 1.})
        for (const double phi : {0., pi / 2}) {
            const Point p{direction(cosine, phi), alpha_x, alpha_y};
            Columns in = metal_rows(p, count, false), walked = metal_rows(p, count, true);
            in[6 + material_parameter("metal")].assign(count, 0);
            in[6 + material_parameter("ior")].assign(count, eta);
            in[6 + material_parameter("thin_walled")].assign(count, 0);
            walked[5 + material_parameter("first_r")].assign(count, eta);
            const Parts found = parts_of(model.sample(in)),
                        truth = parts_of(walk.run("vndf_batch_walk_dielectric_sample", walked, 7));
            worst.reflected = std::max(worst.reflected, std::abs(found.reflected - truth.reflected));
            worst.through = std::max(worst.through, std::abs(found.through - truth.through));
        }
    return worst;
}

}  // namespace

TEST_CASE("what rough glass loses beside the walk is what it is said to be") {
    // Of the tables of kernels/README.md.
    const auto expect = [](const char* energy, double alpha, double eta, double reflected, double through) {
        const Parts gap = glass_gap(energy, alpha, alpha, eta, 1 << 16);
        CAPTURE(energy, alpha, eta, gap.reflected, gap.through);
        CHECK(std::abs(gap.reflected - reflected) < .006);
        CHECK(std::abs(gap.through - through) < .006);
    };
    expect("none", .1, 1.5, .026, .054);
    expect("none", 1, 1.5, .011, .570);
    expect("turquin", .1, 1.5, 0, 0);
    expect("turquin", 1, 1.5, 0, 0);
}

// What the table knows nothing of: a weaker interface and one with a colour.
TEST_CASE("glass with any interface gives back little more than there is") {
    const BsdfProgram program("CONDUCTOR=0 SAMPLING=plain TRANSPORT=importance ENERGY=turquin");
    constexpr std::size_t count = 1 << 11;
    for (const double eta : {1.1, 1.5, 2.5, 1 / 1.1, 1 / 1.5, 1 / 2.5})
        for (const double alpha : {.3, 1.})
            for (const double cosine : {.1, .5, 1.})
                for (const auto& [specular, colour] :
                     {std::pair{0., 1.}, {.5, 1.}, {1., 0.}, {1., 4.}, {.5, 30.}, {1., 30.}}) {
                    Columns in = metal_rows({direction(cosine, .3), alpha, alpha}, count, false);
                    const auto set = [&](const char* name, double x) {
                        in[6 + material_parameter(name)].assign(count, x);
                    };
                    set("metal", 0), set("ior", eta), set("thin_walled", 0), set("specular", specular);
                    for (const char* channel :
                         {"specular_colour_r", "specular_colour_g", "specular_colour_b"})
                        set(channel, colour);
                    const Parts all = parts_of(program.sample(in));
                    CAPTURE(eta, alpha, cosine, specular, colour, all.reflected, all.through);
                    CHECK(all.reflected + all.through < 1.06);
                }
}

// By hand: the tables of kernels/README.md.
TEST_CASE("the gap of glass to the walk", "[.energy-gap]") {
    for (const char* energy : {"none", "turquin"}) {
        fmt::print("{}\n\n| alpha | 1.1 | 1.5 | 2.5 | 1 / 1.1 | 1 / 1.5 | 1 / 2.5 |\n", energy);
        fmt::print("| --- | --- | --- | --- | --- | --- | --- |\n");
        for (const auto& [x, y] :
             {std::pair{.1, .1}, {.3, .3}, {.5, .5}, {1., 1.}, {.4, .2}, {1., .25}, {1., .1}}) {
            fmt::print("| {}, {} |", x, y);
            for (const double eta : {1.1, 1.5, 2.5, 1 / 1.1, 1 / 1.5, 1 / 2.5}) {
                const Parts gap = glass_gap(energy, x, y, eta, items_by_hand());
                fmt::print(" {:.3f}, {:.3f} |", gap.reflected, gap.through);
            }
            fmt::print("\n");
        }
    }
}

// By hand: the errors that energy.h states.
TEST_CASE("errors of the tables of energy", "[.energy-full]") {
    for (const energy::Surface& s : surfaces)
        for (const Claim& claim : claims)
            fmt::print("{} {}, alphas within {} of each other: {:.2g}\n", s.ndf, s.masking, claim.ratio,
                       table_error(s, table_of(s), items_by_hand() >> 7, claim.ratio));
}
TEST_CASE("errors of the tables of glass", "[.energy-full]") {
    for (const energy::Surface& s : surfaces)
        for (const GlassClaim& claim : glass_claims) {
            const GlassError error = glass_error(s, table_of(s), items_by_hand() >> 7, claim.ratio);
            fmt::print("{} {}, alphas within {} of each other: {:.2g}, mean {:.2g}\n", s.ndf, s.masking,
                       claim.ratio, error.largest, error.mean);
        }
}
