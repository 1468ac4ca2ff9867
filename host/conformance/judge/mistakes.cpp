// What samplers draw from by mistake.
#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>

#include <fmt/format.h>

#include "conformance/judge/errors.h"
#include "conformance/judge/mistakes.h"
#include "conformance/judge/statistics.h"
#include "conformance/judge/vectors.h"
#include "parallel.h"
#include "splitmix64.h"

namespace vndf::conformance {

using namespace vectors;

namespace {

using Columns = std::vector<std::vector<double>>;

// What draws a direction.
using Map = std::function<Direction(const Direction& wo, const Alpha& alpha, double u1, double u2)>;

Map map_of(const std::string& sampler) {
    const auto evaluation = reference::find_evaluation<double>(sampler);
    const bool plain = sampler.ends_with("walter2007");
    return [=](const Direction& o, const Alpha& a, double u1, double u2) {
        const double in[7] = {o[0], o[1], o[2], a[0], a[1], u1, u2};
        double out[4];
        evaluation(in + (plain ? 3 : 0), out, reference::Precision::f32);
        return Direction{out[0], out[1], out[2]};
    };
}

Direction stretched(const Direction& w, const Alpha& a) {
    return normalised({a[0] * w[0], a[1] * w[1], w[2]});
}

// A visible normal mirrored in stretched space in the plane of wo and the first tangent: what the disks of 2017 and 2018 give
// with the second tangent the wrong way round, of normals below the surface as those listings have it or as they are.
Direction mirrored(const Direction& m, bool clamped, const Direction& o, const Alpha& a) {
    const Direction v = stretched(o, a), h = normalised({m[0] / a[0], m[1] / a[1], m[2]});
    const Direction t1 = std::hypot(v[0], v[1]) > 0 ? normalised({-v[1], v[0], 0}) : Direction{1, 0, 0},
                    t2 = cross(v, t1);
    Direction n = h + -2 * dot(h, t2) * t2;
    if (clamped) n[2] = std::max(0.0, n[2]);
    return stretched(n, a);
}

// The listing of 2017 as printed, where ?: takes all before it for its condition.
Direction printed2017(const Direction& o, const Alpha& a, double u1, double u2) {
    constexpr double pi = 3.14159265358979323846;
    const Direction v = stretched(o, a);
    const Direction t1 = v[2] < 0.9999 ? normalised(cross(v, {0, 0, 1})) : Direction{1, 0, 0},
                    t2 = cross(t1, v);
    const double share = 1 / (1 + v[2]), r = std::sqrt(u1);
    const double phi = u2 < share ? u2 / share * pi : pi + (u2 - share) / (1 - share) * pi;
    const double p1 = r * std::cos(phi), p2 = r * std::sin(phi) * (u2 < share ? 1 : 0) != 0 ? 1 : v[2];
    const Direction n = p1 * t1 + p2 * t2 + std::sqrt(std::max(0.0, 1 - p1 * p1 - p2 * p2)) * v;
    return normalised({a[0] * n[0], a[1] * n[1], std::max(0.0, n[2])});
}

struct Hypothesis {
    std::string what;
    Map map;
};

// Normals of a view, or of the whole surface (plain), drawn wrongly.
std::vector<Hypothesis> of_normals(Ndf ndf, bool plain) {
    const bool ggx = ndf == Ndf::ggx;
    const auto visible_of = [](bool ggx) {
        return map_of(ggx ? "vndf_ggx_sample_wm_dupuy2023" : "vndf_beckmann_sample_wm_jakob2014");
    };
    const auto all_of = [](bool ggx) {
        return map_of(ggx ? "vndf_ggx_sample_wm_walter2007" : "vndf_beckmann_sample_wm_walter2007");
    };
    const Map right = plain ? all_of(ggx) : visible_of(ggx), other = plain ? all_of(!ggx) : visible_of(!ggx);
    std::vector<Hypothesis> all{{"", right}};
    const auto add = [&](const char* what, Map map) { all.push_back({what, std::move(map)}); };
    for (const AlphaMistake& mistake : alpha_mistakes)
        add(mistake.what, [=](const Direction& o, const Alpha& a, double u1, double u2) {
            return right(o, mistake.of(a), u1, u2);
        });
    add(ggx ? "it draws from Beckmann's distribution, not from that of GGX"
            : "it draws from the distribution of GGX, not from Beckmann's",
        other);
    if (plain)
        add("it draws visible normals, which depend on wo", visible_of(ggx));
    else
        add("visibility (G1) is left out: it draws from D cos, whatever the view", all_of(ggx));
    const auto u = [&](const char* what, const char* sampler, auto change) {
        add(what, [=, map = map_of(sampler)](const Direction& o, const Alpha& a, double u1, double u2) {
            change(u1, u2);
            return map(o, a, u1, u2);
        });
    };
    const char* const half_azimuth =
        "half of a lobe is left out: the azimuth takes half a turn (pi u in place of 2 pi u)";
    const char* const half_slope = "half of a lobe is left out: slopes of one sign alone";
    const char* const half_disk = "half of a lobe is left out: one of the two half disks";
    const auto first_half = [](double& u1, double&) { u1 /= 2; };
    const auto second_half = [](double&, double& u2) { u2 /= 2; };
    const auto upper = [](double&, double& u2) { u2 = .5 + u2 / 2; };
    const char* const plain_map =
        ggx ? "vndf_ggx_sample_wm_walter2007" : "vndf_beckmann_sample_wm_walter2007";
    if (plain) {
        u(half_azimuth, plain_map, first_half), u(half_azimuth, plain_map, second_half);
        return all;
    }
    add("half of a lobe is left out, all on one side of the plane y = 0 of stretched space",
        [=](const Direction& o, const Alpha& a, double u1, double u2) {
            Direction m = right(o, a, u1, u2);
            m[1] = std::abs(m[1]);
            return m;
        });
    if (ggx) {
        u(half_azimuth, "vndf_ggx_sample_wm_dupuy2023", first_half);
        u(half_azimuth, "vndf_ggx_sample_wm_heitz2018", first_half);
        add(half_disk, [map = map_of("vndf_ggx_sample_wm_heitz2017")](const Direction& o, const Alpha& a,
                                                                      double u1, double u2) {
            return map(o, a, u1, u2 / (1 + stretched(o, a)[2]));
        });
        u("the radius in the disk lacks its square root", "vndf_ggx_sample_wm_heitz2018",
          [](double&, double& u2) { u2 *= u2; });
        u("the radius in the disk lacks its square root", "vndf_ggx_sample_wm_heitz2017",
          [](double& u1, double&) { u1 *= u1; });
        u(half_slope, "vndf_ggx_sample_wm_heitz_deon2014_exact", upper);
        u(half_slope, "vndf_ggx_sample_wm_heitz_deon2014_exact", second_half);
        for (const bool clamped : {true, false})
            add("T2 points the wrong way: V x T1 in place of T1 x V, or the reverse",
                [=](const Direction& o, const Alpha& a, double u1, double u2) {
                    return mirrored(right(o, a, u1, u2), clamped, o, a);
                });
        add("?: takes the whole product before it for its condition, as in the listing of 2017", printed2017);
    } else {
        u(half_slope, "vndf_beckmann_sample_wm_jakob2014", upper);
        u(half_slope, "vndf_beckmann_sample_wm_jakob2014", second_half);
    }
    const auto view = [&](const char* what, auto change) {
        add(what, [=](const Direction& o, const Alpha& a, double u1, double u2) {
            return right(change(o), a, u1, u2);
        });
    };
    view("wo is taken to point to the surface: its sign is wrong", [](const Direction& o) { return -o; });
    view("wo is turned by half a turn about the normal: x and y have the wrong sign", [](const Direction& o) {
        return Direction{-o[0], -o[1], o[2]};
    });
    view("wo is taken for its mirror image under the surface", [](const Direction& o) {
        return Direction{o[0], o[1], -o[2]};
    });
    add("y is taken for up, in place of z", [=](const Direction& o, const Alpha& a, double u1, double u2) {
        const Direction m = right({o[0], o[2], o[1]}, a, u1, u2);
        return Direction{m[0], m[2], m[1]};
    });
    add("wo is not stretched by alpha", [=](const Direction& o, const Alpha& a, double u1, double u2) {
        return stretched(right(o, {1, 1}, u1, u2), a);
    });
    add("the normal is not stretched back by alpha",
        [=](const Direction& o, const Alpha& a, double u1, double u2) {
            return right(stretched(o, a), {1, 1}, u1, u2);
        });
    add("one random number is used for both",
        [=](const Direction& o, const Alpha& a, double u1, double) { return right(o, a, u1, u1); });
    return all;
}

std::vector<Hypothesis> hypotheses_of(const Function& sampler) {
    const bool plain = sampler.density.ends_with("walter2007");
    std::vector<Hypothesis> normals = of_normals(sampler.ndf, plain);
    const Map right = normals.front().map;
    if (sampler.result == "WM") {
        normals.push_back(
            {"the normal points into the surface: its sign is wrong",
             [=](const Direction& o, const Alpha& a, double u1, double u2) { return -right(o, a, u1, u2); }});
        normals.push_back({"the reflected direction is returned, not the normal",
                           [=](const Direction& o, const Alpha& a, double u1, double u2) {
                               return reflect(o, right(o, a, u1, u2));
                           }});
        return normals;
    }
    std::vector<Hypothesis> all;
    const auto reflected = [](const Map& map) {
        return [=](const Direction& o, const Alpha& a, double u1, double u2) {
            return reflect(o, map(o, a, u1, u2));
        };
    };
    const bool any = sampler.density.ends_with("_pdf_wi");
    if (!any)
        all.push_back({"", map_of(sampler.density == "vndf_ggx_pdf_wi_eto2023" ? "vndf_ggx_sample_wi_eto2023"
                                  : sampler.density == "vndf_ggx_pdf_wi_conic2026"
                                      ? "vndf_ggx_sample_wi_conic2026"
                                      : "vndf_ggx_sample_wi_eto2023_polygon")});
    for (const Hypothesis& h : normals) all.push_back({h.what, reflected(h.map)});
    if (!any) all[1].what = "it draws from all visible normals, not from a bounded cap of them";
    if (any && sampler.ndf == Ndf::ggx)
        all.push_back({"it draws from the bounded cap of 2023: judge it --as ggx_sample_wi_eto2023",
                       map_of("vndf_ggx_sample_wi_eto2023")});
    all.push_back({"the normal is returned, not the reflected direction", right});
    all.push_back({"the direction points into the surface: its sign is wrong",
                   [=](const Direction& o, const Alpha& a, double u1, double u2) {
                       return -reflect(o, right(o, a, u1, u2));
                   }});
    return all;
}

// Moderate lobes, in which mistakes look different.
std::vector<Point> plain_lobes(const Function& function, const Scope& scope) {
    const double high = std::clamp(.6, scope.alpha.low, scope.alpha.high),
                 low = std::clamp(high / 4, scope.alpha.low, scope.alpha.high);
    std::vector<Alpha> alphas{{high, low}, {low, high}, {high, high}};
    if (scope.isotropic || column(function, "alpha_y") < 0) alphas = {{high, high}, {low, low}};
    std::vector<Point> points;
    for (const Alpha& alpha : alphas)
        for (const auto& wo : {direction(.6, 0.7), direction(.3, 2), direction(.9, -2.2)})
            points.push_back(make_point(wo, alpha, {1, 0}, {0, 0, 1}, {.5, .5}, 1.5));
    return points;
}

constexpr std::size_t sample_count = std::size_t{1} << 15;
constexpr double least_p = 1e-5;

// Cells that hold about as many of some samples each: quantiles of z, and in each of the azimuth.
class Cells {
  public:
    static constexpr std::size_t n = 12;
    explicit Cells(std::vector<Direction> some) {
        std::sort(some.begin(), some.end(),
                  [](const Direction& a, const Direction& b) { return a[2] < b[2]; });
        const std::size_t part = some.size() / n;
        for (std::size_t i = 0; i < n; ++i) {
            if (i > 0) heights_.push_back(some[i * part][2]);
            std::vector<double> turns;
            for (std::size_t k = i * part; k < (i + 1) * part; ++k)
                turns.push_back(std::atan2(some[k][1], some[k][0]));
            std::sort(turns.begin(), turns.end());
            std::vector<double>& edges = azimuths_.emplace_back();
            for (std::size_t j = 1; j < n; ++j) edges.push_back(turns[j * part / n]);
        }
    }
    std::size_t operator()(const Direction& d) const {
        const auto place = [](const std::vector<double>& edges, double x) {
            return static_cast<std::size_t>(std::upper_bound(edges.begin(), edges.end(), x) - edges.begin());
        };
        const std::size_t row = place(heights_, d[2]);
        return row * n + place(azimuths_[row], std::atan2(d[1], d[0]));
    }

  private:
    std::vector<double> heights_;
    std::vector<std::vector<double>> azimuths_;
};

// One lobe's samples, counted but for a quarter of them, which the cells are made from.
struct Drawn {
    Point lobe;
    Cells cells;
    std::vector<std::uint32_t> counts;
    std::size_t counted = 0;
};

std::optional<Drawn> draw(runtime::DeviceEvaluator& evaluator, const Function& sampler, const Point& lobe,
                          std::uint64_t seed) {
    SplitMix64 random(seed);
    std::vector<Point> points(sample_count, lobe);
    for (Point& point : points) point.u = {random.uniform(), random.uniform()};
    const Columns d = evaluate(evaluator, sampler, tabulate(sampler, points, evaluator.input_real()));
    std::vector<Direction> directions;
    for (std::size_t i = 0; i < sample_count; ++i) {
        const Direction w{d[0][i], d[1][i], d[2][i]};
        if (std::isfinite(dot(w, w))) directions.push_back(w);
    }
    if (directions.size() < sample_count / 2) return std::nullopt;
    const auto quarter = directions.begin() + static_cast<std::ptrdiff_t>(directions.size() / 4);
    Drawn drawn{lobe, Cells({directions.begin(), quarter}), std::vector<std::uint32_t>(Cells::n * Cells::n),
                0};
    for (auto at = quarter; at != directions.end(); ++at) ++drawn.counts[drawn.cells(*at)], ++drawn.counted;
    return drawn;
}

// The chance that these samples and some of the map, drawn anew, differ so much.
double chance_of(const Drawn& drawn, const Map& map, std::size_t count, std::uint64_t seed) {
    SplitMix64 random(seed);
    std::vector<std::uint32_t> counts(drawn.counts.size());
    for (std::size_t i = 0; i < count; ++i) {
        const double u1 = random.uniform(), u2 = random.uniform();
        ++counts[drawn.cells(map(drawn.lobe.wo, drawn.lobe.alpha, u1, u2))];
    }
    return same_distribution_p(drawn.counts, counts);
}

}  // namespace

Mistake mistake_of_sampler(runtime::DeviceEvaluator& evaluator, const Function& sampler, const Scope& scope,
                           std::uint64_t seed) {
    if (column(sampler, "n_x") >= 0) return {};
    std::vector<Drawn> drawn;
    for (const Point& lobe : plain_lobes(sampler, scope)) {
        std::optional<Drawn> one = draw(evaluator, sampler, lobe, seed + drawn.size());
        if (!one) return {};
        drawn.push_back(std::move(*one));
    }
    // A few distinct values of all samples.
    const auto is_constant = [](const Drawn& d) {
        return std::count_if(d.counts.begin(), d.counts.end(), [](std::uint32_t n) { return n > 0; }) <= 2;
    };
    if (std::all_of(drawn.begin(), drawn.end(), is_constant))
        return {"the samples do not depend on u", "all samples of a lobe are in one place"};

    const std::vector<Hypothesis> hypotheses = hypotheses_of(sampler);
    // The least of all lobes, or of those up to one that tells; most maps are told by few samples.
    const auto chance = [&](const Hypothesis& hypothesis) {
        double least = chance_of(drawn.front(), hypothesis.map, drawn.front().counted / 16, seed + 999);
        for (std::size_t i = 0; i < drawn.size() && least > least_p; ++i)
            least = std::min(least, chance_of(drawn[i], hypothesis.map, drawn[i].counted, seed + 1000 + i));
        return least;
    };
    if (chance(hypotheses.front()) > least_p) return {"", "", true};
    std::vector<double> chances(hypotheses.size());
    parallel_for(hypotheses.size() - 1, 1,
                 [&](unsigned, std::size_t h, std::size_t) { chances[h + 1] = chance(hypotheses[h + 1]); });
    const auto best = std::max_element(chances.begin(), chances.end());
    if (!(*best > least_p)) return {};
    return {hypotheses[static_cast<std::size_t>(best - chances.begin())].what,
            fmt::format("samples with that mistake agree with these in {} lobes (chi2, p at least {:.2g})",
                        drawn.size(), *best)};
}

}  // namespace vndf::conformance
