// The reference against 50-digit arithmetic, against its own definitions, and against closed forms.
#include <algorithm>
#include <boost/math/special_functions/erf.hpp>
#include <cmath>
#include <fstream>
#include <functional>
#include <limits>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "reference/distribution.h"
#include "reference/beckmann_maps.h"
#include "reference/conic_maps.h"
#include "reference/ggx_maps.h"
#include "reference/reference.h"
#include "registry.h"
#include "support/catch.h"
#include "support/skip.h"

using namespace vndf;
using reference::Distribution;
using reference::Precision;

namespace {

constexpr double pi = 3.14159265358979323846;

// --- The table of 50 digits ---

struct Row {
    std::string function;
    Precision precision;
    double condition, pdf_condition;
    std::vector<double> in;
    std::vector<long double> out;
    std::string text;
};

std::vector<Row> read_table() {
    std::ifstream file(CLVNDF_SOURCE_DIR "/tests/data/reference_50digits.csv");
    std::vector<Row> rows;
    std::string line;
    std::getline(file, line);
    while (std::getline(file, line)) {
        std::istringstream cells(line);
        std::string precision, condition, pdf_condition, in, out, number;
        Row row;
        std::getline(cells, row.function, ',');
        std::getline(cells, precision, ',');
        std::getline(cells, condition, ',');
        std::getline(cells, pdf_condition, ',');
        std::getline(cells, in, ',');
        std::getline(cells, out, ',');
        row.precision = precision == "f32" ? Precision::f32 : Precision::f64;
        row.condition = std::stod(condition);
        row.pdf_condition = std::stod(pdf_condition);
        for (std::istringstream list(in); list >> number;) row.in.push_back(std::stod(number));
        for (std::istringstream list(out); list >> number;) row.out.push_back(std::stold(number));
        row.text = line;
        rows.push_back(row);
    }
    return rows;
}
const std::vector<Row>& table() {
    static const std::vector<Row> rows = read_table();
    return rows;
}

template <class R>
using Vector = std::vector<R>;

bool is_pair(const Row& row) {
    return find_function(row.function)->kind == Kind::pair;
}

// The larger error of two numbers, each in units of epsilon (1 + condition) of its own.
template <class R>
double pair_error(const Row& row, const R* out) {
    const R unit = std::numeric_limits<R>::epsilon() / 2;
    double worst = 0;
    for (std::size_t k = 0; k < 2; ++k) {
        const double allowed = static_cast<double>(unit) * (1 + (k == 0 ? row.condition : row.pdf_condition));
        const long double off = std::abs(static_cast<long double>(out[k]) - row.out[k]);
        const double error = off == 0 ? 0 : static_cast<double>(off / std::abs(row.out[k])) / allowed;
        worst = std::max(worst, std::isfinite(error) ? error : std::numeric_limits<double>::infinity());
    }
    return worst;
}

// Errors of `out` in units of epsilon (1 + condition): of the direction or value, and of a sampler's density.
// Behind the roots of a map stands a stretched frame of length 1, which alpha > 1 magnifies.
template <class R>
double table_error(const Row& row, const R* out) {
    if (is_pair(row)) return pair_error(row, out);
    const R unit = std::numeric_limits<R>::epsilon() / 2;
    const auto n = row.out.size();
    long double square = 0, scale = 0;
    for (std::size_t k = 0; k < std::min<std::size_t>(3, n); ++k) {
        square += std::pow(static_cast<long double>(out[k]) - row.out[k], 2);
        scale += row.out[k] * row.out[k];
    }
    const bool sampler = n == 4;
    double stretch = 0;
    if (sampler) {
        const Function& f = *find_function(row.function);
        for (std::size_t j = 0; j < f.inputs.size(); ++j)
            if (f.inputs[j].rfind("alpha", 0) == 0) stretch = std::max(stretch, row.in[j]);
    }
    if (n == 1 && scale == 0) return out[0] == 0 ? 0 : std::numeric_limits<double>::infinity();
    double error = std::sqrt(static_cast<double>(square / (n == 1 ? scale : 1.0L)));
    error /= static_cast<double>(unit) * (1 + row.condition + stretch);
    if (sampler && row.out[3] > 0) {
        const auto pdf = static_cast<double>(std::abs(out[3] / row.out[3] - 1));
        error = std::max(error, pdf / (static_cast<double>(unit) * (1 + row.pdf_condition)));
    }
    return std::isfinite(error) ? error : std::numeric_limits<double>::infinity();
}

template <class R>
struct Worst {
    double error = 0;
    std::string row;
};

// The largest error over the rows whose function contains `part`, with the inputs changed by `change`.
template <class R>
Worst<R> worst_of(const std::string& part, const std::function<void(const Row&, Vector<R>& in)>& change = {},
                  const std::function<void(const Row&, R* out)>& spoil = {}) {
    Worst<R> worst;
    for (const Row& row : table()) {
        if (row.function.find(part) == std::string::npos) continue;
        Vector<R> in(row.in.begin(), row.in.end());
        if (change) change(row, in);
        R out[4];
        reference::find_evaluation<R>(row.function)(in.data(), out, row.precision);
        if (spoil) spoil(row, out);
        const double error = table_error(row, out);
        if (error > worst.error) worst = {error, row.text};
    }
    return worst;
}

constexpr double table_bound = 64;

// --- Lobes ---

struct Lobe {
    double cos_theta, phi, ax, ay;
};
std::ostream& operator<<(std::ostream& out, const Lobe& l) {
    return out << "cos " << l.cos_theta << " phi " << l.phi << " alpha " << l.ax << ", " << l.ay;
}

bool takes_cap(const Function& sampler) {
    return sampler.arguments == "WO_CAP_ALPHA_U" || sampler.arguments == "CONE2026_LOBE_U";
}

// The scalars of `sampler` at a lobe, its normal tilted for world-space samplers.
std::vector<double> scalars(const Function& sampler, const Lobe& l, double u1 = 0.5, double u2 = 0.5) {
    const double s = std::sqrt((1 - l.cos_theta) * (1 + l.cos_theta));
    if (sampler.arguments == "ALPHA_U") return {l.ax, l.ay, u1, u2};
    const double x = s * std::cos(l.phi), y = s * std::sin(l.phi), z = l.cos_theta;
    if (sampler.arguments == "WO_ALPHA_U" || sampler.arguments == "CONIC2026_LOBE_U" ||
        sampler.arguments == "LOBE_U" || sampler.arguments == "BECKMANN_LOBE_U")
        return {x, y, z, l.ax, l.ay, u1, u2};
    if (sampler.arguments == "WO_ALPHA1_U") return {x, y, z, l.ax, u1, u2};
    // A cap beside the mirror image of wo, whose cone of normals is above the surface for every lobe here.
    if (takes_cap(sampler)) {
        const double up = std::abs(z) + 0.3, length = std::sqrt(0.36 * s * s + up * up);
        return {x, y, z, -0.6 * x / length, -0.6 * y / length, up / length, 0.02, l.ax, l.ay, u1, u2};
    }
    // The frame turned by c = 0.6 about y: z -> n.
    return {0.6 * x - 0.8 * z, y, 0.8 * x + 0.6 * z, -0.8, 0, 0.6, l.ax, u1, u2};
}

// The density that the sampler is registered with.
Distribution distribution_of(const Function& sampler, const Lobe& l) {
    const bool one_alpha = sampler.arguments == "WO_N_ALPHA1_U" || sampler.arguments == "WO_ALPHA1_U";
    reference::Lobe lobe{.alpha_x = l.ax, .alpha_y = one_alpha ? l.ax : l.ay};
    const std::vector<double> in = scalars(sampler, l);
    if (sampler.arguments != "ALPHA_U") lobe.wo = {in[0], in[1], in[2]};
    if (sampler.arguments == "WO_N_ALPHA1_U") lobe.n = {in[3], in[4], in[5]};
    if (takes_cap(sampler)) lobe.l = {in[3], in[4], in[5]}, lobe.one_minus_cos = in[6];
    return {sampler.density, lobe};
}

std::string without_lobe(const std::string& name) {
    return name.ends_with("_lobe") ? name.substr(0, name.size() - 5) : name;
}

// Those whose samples are never lost; of the others clvndf check takes the same statistics of what is kept.
std::vector<const Function*> samplers() {
    std::vector<const Function*> result;
    for (const Function& f : functions())
        if (is_plain_sampler(f) && !may_miss(f)) result.push_back(&f);
    return result;
}

std::vector<Lobe> lobes(const Function& sampler) {
    std::vector<Lobe> all;
    const double alphas[][2] = {{1e-4, 1e-4}, {0.01, 0.01}, {0.5, 0.5}, {1, 1},
                                {2, 2},       {1e-3, 1},    {1, 1e-3},  {0.2, 0.6}};
    for (const auto& a : alphas)
        for (const double c : {1., 0.5, 1e-3, -0.5}) {
            if (c < 0 && (sampler.domain == Domain::upper || sampler.arguments == "ALPHA_U")) continue;
            const bool one = sampler.arguments == "WO_N_ALPHA1_U" || sampler.arguments == "WO_ALPHA1_U";
            if (one && a[0] != a[1]) continue;
            all.push_back({c, 0.7, a[0], a[1]});
        }
    return all;
}

double lattice(int i, double step) {
    return std::fmod(0.5 + step * i, 1);
}

// A direction of the map, drawn with the i-th point of a low-discrepancy sequence.
std::array<double, 4> draw(const Function& sampler, const Lobe& l, int i) {
    const auto in = scalars(sampler, l, lattice(i, 0.7548776662466927), lattice(i, 0.5698402909980532));
    std::array<double, 4> out{};
    reference::find_evaluation<double>(sampler.name + "_with_pdf")(in.data(), out.data(), Precision::f32);
    return out;
}

double evaluate(const std::string& name, const std::vector<double>& in,
                Precision precision = Precision::f32) {
    double out[4];
    reference::find_evaluation<double>(name)(in.data(), out, precision);
    return out[0];
}
std::array<double, 4> sample(const std::string& name, const std::vector<double>& in,
                             Precision precision = Precision::f32) {
    std::array<double, 4> out{};
    reference::find_evaluation<double>("vndf_" + name + "_with_pdf")(in.data(), out.data(), precision);
    return out;
}

}  // namespace

TEST_CASE(
    "every registered function has a reference, every sampler a condition number, every density a "
    "distribution") {
    std::set<std::string> in_table;
    for (const Row& row : table()) in_table.insert(row.function);
    CHECK(table().size() >= 200);
    for (const Function& f : functions()) {
        CAPTURE(f.name);
        CHECK(reference::find_evaluation<double>(f.name));
        CHECK(reference::find_evaluation<long double>(f.name));
        CHECK((reference::find_condition(f.name) != nullptr) == (f.kind == Kind::sampler));
        if (f.kind == Kind::density) CHECK_NOTHROW(Distribution(f.name, {}));
        CHECK(in_table.count(f.kind == Kind::sampler ? without_lobe(f.plain) + "_with_pdf"
                                                     : without_lobe(f.name)));
        // What a function of a lobe computes is what it computes without one.
        CHECK(reference::find_evaluation<double>(f.name) ==
              reference::find_evaluation<double>(without_lobe(f.plain) + (f.with_pdf ? "_with_pdf" : "")));
    }
    CHECK_FALSE(reference::find_evaluation<double>("vndf_ggx_sample_wm"));
    CHECK_THROWS_AS(reference::condition("vndf_ggx_ndf", nullptr, Precision::f32), std::invalid_argument);
    CHECK_THROWS_AS(Distribution("vndf_ggx_ndf", {}), std::invalid_argument);
}

TEST_CASE("both forms of a sampler give the same direction") {
    for (const Function* f : samplers())
        for (const Lobe& l : lobes(*f)) {
            const auto in = scalars(*f, l, 0.3, 0.6);
            const auto with_pdf = draw(*f, l, 0);
            std::array<double, 4> plain{}, fused{};
            reference::find_evaluation<double>(f->name)(in.data(), plain.data(), Precision::f32);
            reference::find_evaluation<double>(f->name + "_with_pdf")(in.data(), fused.data(),
                                                                      Precision::f32);
            CHECK((plain[0] == fused[0] && plain[1] == fused[1] && plain[2] == fused[2]));
            CHECK(std::hypot(with_pdf[0], with_pdf[1], with_pdf[2]) == Catch::Approx(1).epsilon(1e-14));
        }
}

TEST_CASE("the double reference agrees with 50-digit arithmetic within its bound") {
    for (const Function& f : functions()) {
        const auto worst = worst_of<double>(f.name);
        CAPTURE(f.name, worst.row);
        CHECK(worst.error <= table_bound);
    }
}

TEST_CASE("the long double reference agrees with 50-digit arithmetic within its bound") {
    if (std::numeric_limits<long double>::digits <= std::numeric_limits<double>::digits)
        VNDF_SKIP("long double is double here");
    for (const Function& f : functions()) {
        // The table takes the vectors of these for unit, which they are to 2^-53.
        if (f.name == "vndf_refract" || f.name.find("jacobian") != std::string::npos) continue;
        const auto worst = worst_of<long double>(f.name);
        CAPTURE(f.name, worst.row);
        CHECK(worst.error <= table_bound);
    }
}

TEST_CASE("the comparison with the table notices seeded errors") {
    using In = Vector<double>;
    const auto swapped = [](std::size_t a, std::size_t b) {
        return [a, b](const Row&, In& in) { std::swap(in[a], in[b]); };
    };
    const auto scaled = [](std::size_t at, double factor) {
        return [at, factor](const Row&, double* out) { out[at] *= factor; };
    };
    const std::string anisotropic[] = {"vndf_ggx_sample_wm_dupuy2023", "vndf_beckmann_sample_wm_jakob2014"};
    for (const auto& name : anisotropic) {
        CHECK(worst_of<double>(name, swapped(3, 4)).error > table_bound);  // alpha
        CHECK(worst_of<double>(name, swapped(5, 6)).error > table_bound);  // roles of u
    }
    CHECK(worst_of<double>("vndf_ggx_pdf_wi", {}, scaled(0, 4)).error > table_bound);  // no Jacobian
    for (const std::size_t number : {0, 1})
        for (const char* pair : {"vndf_ggx_pdf_wi_both", "vndf_beckmann_pdf_wi_both", "vndf_ggx_eval_pdf",
                                 "vndf_beckmann_eval_pdf"})
            CHECK(worst_of<double>(pair, {}, scaled(number, 1 + 1e-12)).error > table_bound);
    CHECK(worst_of<double>("vndf_ggx_sample_wm_heitz2018", {}, scaled(3, 1 + 1e-10)).error > table_bound);
    CHECK(worst_of<double>("vndf_ggx_sample_wm_heitz2017", {}, scaled(1, -1)).error >
          table_bound);  // T2 flipped
    CHECK(worst_of<double>("vndf_beckmann_lambda", {}, scaled(0, 1 + 1e-12)).error > table_bound);
    // The constant of the 2014 supplement, 1 / sqrt(pi) with 11 digits.
    CHECK(worst_of<double>("vndf_beckmann_sigma", {}, scaled(0, 0.56418958354 / 0.56418958354775629)).error >
          table_bound);
    // The plain cap's density for the bounded sampler.
    const auto plain_density = [](const Row& row, double* out) {
        std::vector<double> in = {row.in[0], row.in[1], row.in[2], out[0],
                                  out[1],    out[2],    row.in[3], row.in[4]};
        out[3] = evaluate("vndf_ggx_pdf_wi", in, row.precision);
    };
    CHECK(worst_of<double>("vndf_ggx_sample_wi_eto2023", {}, plain_density).error > table_bound);
}

TEST_CASE("the condition number contains the derivatives found by differences") {
    for (const Row& row : table()) {
        if (row.out.size() != 4) continue;
        const double condition = reference::condition(row.function, row.in.data(), row.precision);
        CAPTURE(row.text);
        CHECK(condition >= row.condition * (1 - 1e-4));  // plus the rotation of the stretched azimuth
        // That rotation moves a direction no more than moving wo's part across does: by |wo.x d/dx| + |wo.y d/dy| when
        // isotropic, up to the ratio of the alphas otherwise; and not at all without wo.
        if (row.function.find("walter2007") != std::string::npos)
            CHECK(condition == Catch::Approx(row.condition).epsilon(1e-4));
    }
}

TEST_CASE("dual numbers carry the derivative of every operation") {
    using D = reference::Dual<double, 2>;
    const auto f = [](auto x, auto y) {
        using std::atan2, std::cbrt, std::cos, std::erf, std::erfc, std::exp, std::log, std::log1p, std::sin,
            std::sqrt, std::abs;
        using R = decltype(x);
        return R(sqrt(x * y + 2) / (1 - x) + sin(x) * cos(y) - exp(-x) * log(y) + atan2(y, R(-x)) +
                 log1p(x) / y + erf(x) * erfc(y) + cbrt(y) * abs(R(x - y)) + 3 * x - y * 2 +
                 reference::erfc_inv<R>(x / 2) +
                 reference::gaussian_tail<R>(x).first * reference::gaussian_tail<R>(y + 3).first +
                 reference::gaussian_tail<R>(y).mass - (x + 1.5));
    };
    const double x = 0.3, y = 0.8, h = 1e-6;
    const D d = f(D::variable(x, 0), D::variable(y, 1));
    CHECK(d.value == Catch::Approx(f(x, y)).epsilon(1e-15));
    CHECK(d.partial[0] == Catch::Approx((f(x + h, y) - f(x - h, y)) / (2 * h)).epsilon(1e-8));
    CHECK(d.partial[1] == Catch::Approx((f(x, y + h) - f(x, y - h)) / (2 * h)).epsilon(1e-8));
}

namespace {

// |d direction / d(u1, u2)| of a map times its density.
using D2 = reference::Dual<double, 2>;
double pushforward(reference::Sample<D2> (*map)(const reference::Arguments<D2>&),
                   const std::vector<double>& wo, const std::vector<double>& n, double ax, double ay,
                   double u1, double u2) {
    reference::Arguments<D2> in;
    in.wo = reference::normalised<D2>({D2(wo[0]), D2(wo[1]), D2(wo[2])});
    in.n = {D2(n[0]), D2(n[1]), D2(n[2])};
    in.alpha_x = ax, in.alpha_y = ay, in.rotation = 0, in.least_u = 0;
    in.u1 = D2::variable(u1, 0), in.u2 = D2::variable(u2, 1);
    in.v1 = 1 - in.u1, in.v2 = 1 - in.u2;
    const auto s = map(in);
    const auto& a = s.direction.x.partial;
    const auto& b = s.direction.y.partial;
    const auto& c = s.direction.z.partial;
    return std::hypot(a[0] * b[1] - b[0] * a[1], b[0] * c[1] - c[0] * b[1], c[0] * a[1] - a[0] * c[1]) *
           s.pdf.value;
}

}  // namespace

TEST_CASE("the density of a sample is the inverse of its map's Jacobian") {
    using namespace reference;
    const double alphas[][2] = {{1e-4, 1e-4}, {0.01, 0.3}, {0.5, 0.5}, {1, 1}, {3, 0.2}};
    for (const auto& a : alphas)
        for (const double c : {0.99, 0.5, 0.01, -0.01, -0.5})
            for (const double u1 : {0.07, 0.4, 0.83})
                for (const double u2 : {0.11, 0.45, 0.77}) {
                    CAPTURE(a[0], a[1], c, u1, u2);
                    const double s = std::sqrt(1 - c * c);
                    const std::vector<double> wo = {s * 0.6, s * 0.8, c}, z = {0, 0, 1},
                                              n = {0.48, 0.6, -0.64};
                    const auto one = [](double jacobian) {
                        CHECK(jacobian == Catch::Approx(1).epsilon(1e-9));
                    };
                    one(pushforward(ggx_heitz_deon2014_exact<D2>, wo, z, a[0], a[1], u1, u2));
                    one(pushforward(ggx_heitz2018<D2>, wo, z, a[0], a[1], u1, u2));
                    one(pushforward(ggx_dupuy2023<D2>, wo, z, a[0], a[1], u1, u2));
                    one(pushforward(ggx_eto2023<D2>, wo, z, a[0], a[1], u1, u2));
                    one(pushforward(ggx_eto2023_polygon<D2>, wo, z, a[0], a[1], u1, u2));
                    one(pushforward(ggx_conic2026<D2>, wo, z, a[0], a[1], u1, u2));
                    one(pushforward(ggx_benyoub2024<D2>, wo, n, a[0], a[0], u1, u2));
                    one(pushforward(beckmann_jakob2014<D2>, wo, z, a[0], a[1], u1, u2));
                    one(pushforward(ggx_walter2007<D2>, wo, z, a[0], a[1], u1, u2));
                    one(pushforward(beckmann_walter2007<D2>, wo, z, a[0], a[1], u1, u2));
                    if (c < 0) continue;
                    one(pushforward(ggx_heitz_deon2014<D2>, wo, z, a[0], a[1], u1, u2));
                    one(pushforward(ggx_heitz2017<D2>, wo, z, a[0], a[1], u1, u2));
                }
}

TEST_CASE("the three parts of the 2014 Beckmann map add up to its density") {
    // Each x is reached twice: |x| < a by both signs of the couple, below -a by the two terms a - x = a + |x|.
    const auto map = reference::beckmann_heitz_deon2014<D2>;
    const double c = 0.6, s = 0.8, a = c / s;
    const std::vector<double> wo = {s, 0, c}, z = {0, 0, 1};
    const double n = a * std::erfc(-a) + std::exp(-a * a) / std::sqrt(pi),
                 tail = std::exp(-a * a) / std::sqrt(pi) / n;
    const double constant = a * std::erfc(a) / n;
    const auto at = [&](double u1) { return pushforward(map, wo, z, 1, 1, u1, 0.3); };
    const auto slope = [&](double u1) {
        const auto m = sample("beckmann_sample_wm_heitz_deon2014", {s, 0, c, 1, 1, u1, 0.3});
        return -m[0] / m[2];
    };
    const double first = tail / 2, second = tail + constant / 2, centre = (1 + tail + constant) / 2 + 0.1;
    CHECK(slope(first) < -a);
    CHECK(slope(second) < -a);
    CHECK(std::abs(slope(centre)) < a);
    CHECK(at(first) == Catch::Approx((a - slope(first)) / -slope(first)).epsilon(1e-10));
    CHECK(at(second) == Catch::Approx((a - slope(second)) / a).epsilon(1e-10));
    CHECK(at(centre) == Catch::Approx(2).epsilon(1e-10));
}

namespace {

// Where a density takes the direction among the scalars of its sampler.
std::size_t direction_at(const Function& sampler) {
    return sampler.arguments == "ALPHA_U"         ? 0
           : sampler.arguments == "WO_N_ALPHA1_U" ? 6
           : takes_cap(sampler)                   ? 7
                                                  : 3;
}

}  // namespace

TEST_CASE("the density of a sample is the registered density there") {
    for (const Function* f : samplers()) {
        if (f->method == Method::approximate) continue;
        for (const Lobe& l : lobes(*f))
            for (int i = 0; i < 5; ++i) {
                const auto d = draw(*f, l, i);
                auto in = scalars(*f, l);
                in.resize(in.size() - 2);
                if (f->arguments == "WO_ALPHA1_U") in.push_back(in.back());  // the density takes two
                in.insert(in.begin() + static_cast<long>(direction_at(*f)), d.begin(), d.begin() + 3);
                CAPTURE(f->name, l, i);
                // Small alpha and wi: the rounding of d, 1e-16 / alpha, is felt; Beckmann behind: q times more.
                CHECK(evaluate(f->density, in) ==
                      Catch::Approx(d[3]).epsilon(f->result == "WI" || f->ndf == Ndf::beckmann ||
                                                          f->arguments == "WO_N_ALPHA1_U"
                                                      ? 1e-6
                                                      : 1e-11));
            }
    }
}

TEST_CASE("the rule integrates each registered density to 1") {
    for (const Function* f : samplers())
        for (const Lobe& l : lobes(*f)) {
            CAPTURE(f->name, l);
            const auto in = scalars(*f, l);
            const auto rule = distribution_of(*f, l).rule();
            const auto density = reference::find_evaluation<double>(f->density);
            const std::size_t at = direction_at(*f);
            std::vector<double> arguments(in.begin(), in.end() - 2);
            if (f->arguments == "WO_ALPHA1_U") arguments.push_back(arguments.back());
            arguments.insert(arguments.begin() + static_cast<long>(at), 3, 0.0);
            double total = 0, probability = 0;
            for (std::size_t i = 0; i < rule.size(); ++i) {
                arguments[at] = rule.x[i], arguments[at + 1] = rule.y[i], arguments[at + 2] = rule.z[i];
                double value;
                density(arguments.data(), &value, Precision::f64);
                total += rule.weight[i] * value;
                probability += rule.probability[i];
            }
            CHECK(total == Catch::Approx(1).epsilon(1e-6));
            CHECK(probability == Catch::Approx(1).epsilon(3e-7));
        }
}

TEST_CASE("moments agree with the closed forms of the hemisphere and of the Gaussian") {
    for (const double c : {1., 0.8, 0.3, 1e-3, -0.4, -0.9}) {
        CAPTURE(c);
        const double s = std::sqrt(1 - c * c), theta = std::acos(c);
        const auto m = Distribution("vndf_ggx_pdf_wm", {.wo = {s, 0, c}}).moments();
        const auto close = [](double value, double exact) { CHECK(std::abs(value - exact) < 1e-9); };
        const double mean_io = 4 * (pi - theta + s * c) / (3 * pi * (1 + c));
        close(m.mean[9], mean_io);  // m . i
        close(m.variance[9] + mean_io * mean_io, (1 + c) * (2 - c) / 4);
        close(m.mean[1], 0);  // across
        close(m.mean[4], 0.25);
        close(m.mean[2] * s - m.mean[0] * c, 4 * (1 - c) / (3 * pi));  // e_perp = (-c, 0, s)
        close(m.mean[3] + m.mean[4] + m.mean[5], 1);

        // Beckmann slopes, alpha = 0.7: E[x], E[x^2], E[y^2] by the rule.
        const double alpha = 0.7;
        if (c == 1 || c < 0) continue;
        const auto rule =
            Distribution("vndf_beckmann_pdf_wm", {.wo = {s, 0, c}, .alpha_x = alpha, .alpha_y = alpha})
                .rule(1);
        double x1 = 0, x2 = 0, y2 = 0;
        for (std::size_t i = 0; i < rule.size(); ++i) {
            const double x = -rule.x[i] / rule.z[i], y = rule.y[i] / rule.z[i];
            x1 += rule.probability[i] * x, x2 += rule.probability[i] * x * x,
                y2 += rule.probability[i] * y * y;
        }
        const double a = c / (alpha * s), t = 1 / a;
        const double g = 1 / (1 + (t * std::exp(-a * a) / std::sqrt(pi) - std::erfc(a)) / 2);
        close(x1, -alpha * g * t * std::erfc(-a) / 4);
        close(x2, alpha * alpha * g * (std::erfc(-a) / 4 + t * std::exp(-a * a) / (2 * std::sqrt(pi))));
        close(y2, alpha * alpha / 2);
    }
}

TEST_CASE("fine and coarse rules agree on the moments, for every lobe") {
    for (const Function* f : samplers())
        for (const Lobe& l : lobes(*f)) {
            CAPTURE(f->name, l);
            const Distribution distribution = distribution_of(*f, l);
            const auto moments = distribution.moments();
            const auto rule = distribution.rule();
            double x = 0, zz = 0, yz = 0;
            for (std::size_t i = 0; i < rule.size(); ++i) {
                x += rule.probability[i] * rule.x[i];
                zz += rule.probability[i] * rule.z[i] * rule.z[i];
                yz += rule.probability[i] * rule.y[i] * rule.z[i];
            }
            const auto close = [&](double value, int k) {
                const double scale = std::sqrt(moments.variance[k] + moments.mean[k] * moments.mean[k]);
                CHECK(std::abs(value - moments.mean[k]) < 1e-5 * scale);
            };
            close(x, 0);
            close(zz, 5);
            close(yz, 8);
        }
}

TEST_CASE("the moments are those of the map") {
    for (const Function* f : samplers()) {
        if (f->method == Method::approximate) continue;
        for (const Lobe& l :
             {Lobe{0.5, 0.7, 0.5, 0.5}, Lobe{0.9, 0.7, 0.2, 0.2}, Lobe{-0.5, 0.7, 0.5, 0.5}}) {
            if (l.cos_theta < 0 && f->domain == Domain::upper) continue;
            CAPTURE(f->name, l);
            const auto moments = distribution_of(*f, l).moments();
            constexpr int n = 4096;
            double x = 0, y = 0, z = 0, xz = 0;
            for (int i = 0; i < n; ++i) {
                const auto d = draw(*f, l, i);
                x += d[0] / n, y += d[1] / n, z += d[2] / n, xz += d[0] * d[2] / n;
            }
            const double values[] = {x, y, z, xz};
            const int at[] = {0, 1, 2, 7};
            for (int k = 0; k < 4; ++k)
                CHECK(std::abs(values[k] - moments.mean[at[k]]) <
                      0.02 * std::sqrt(moments.variance[at[k]]) + 1e-12);
        }
    }
}

TEST_CASE("pivots undo the maps that are inverse distribution functions") {
    const auto check = [](const char* name, const Lobe& l, double u1, double u2, bool flip) {
        CAPTURE(name, l, u1, u2);
        const Function& f = *find_function(name);
        const auto in = scalars(f, l, u1, u2);
        double d[3], p1, p2;
        reference::find_evaluation<double>(name)(in.data(), d, Precision::f32);
        const Distribution distribution = distribution_of(f, l);
        distribution.pivots(1, &d[0], &d[1], &d[2], &p1, &p2);
        // The rounding of d in double, which a narrow lobe magnifies.
        const double rounding = distribution.pivot_rounding();
        const double bound = 1e-8 + (rounding < 0.1 ? 16 * 0x1p-29 * rounding : 1e-5);
        CHECK(std::abs(p1 - u1) < bound);
        CHECK(std::abs(p2 - (flip ? 1 - u2 : u2)) < bound);
    };
    for (const double c : {1., 0.9, 0.3, 1e-3, -1e-3, -0.5, -0.99})
        for (const double alpha : {1e-4, 0.02, 0.7, 2.})
            for (const double u1 : {1e-6, 0.3, 0.9, 1 - 1e-6})
                for (const double u2 : {1e-4, 0.2, 0.75}) {
                    const Lobe l{c, 0.7, alpha, alpha / 3};
                    check("vndf_ggx_sample_wm_heitz_deon2014_exact", l, u1, u2, true);
                    check("vndf_beckmann_sample_wm_jakob2014", l, u1, u2, false);
                    if (c > 0 && alpha > 1e-3) check("vndf_ggx_sample_wi_eto2023", l, u1, u2, false);
                }
}

TEST_CASE("pivots of every exact map are uniform, its histogram follows the bins") {
    constexpr int n = 4096;
    for (const Function* f : samplers()) {
        if (f->method == Method::approximate) continue;
        for (const Lobe& l : lobes(*f)) {
            CAPTURE(f->name, l);
            const Distribution distribution = distribution_of(*f, l);
            std::vector<double> x(n), y(n), z(n), p1(n), p2(n), theta(n), phi(n);
            for (int i = 0; i < n; ++i) {
                const auto d = draw(*f, l, i);
                x[i] = d[0], y[i] = d[1], z[i] = d[2];
            }
            distribution.pivots(n, x.data(), y.data(), z.data(), p1.data(), p2.data());
            for (auto* p : {&p1, &p2}) {
                std::sort(p->begin(), p->end());
                double distance = 0;
                for (int i = 0; i < n; ++i) distance = std::max(distance, std::abs((*p)[i] - (i + 0.5) / n));
                CHECK(distance < 0.01);  // a false distribution is off by O(0.1), the sequence by 0.005
            }
            const auto bins = distribution.bins(8, 8);
            const auto probabilities = distribution.bin_probabilities(bins);
            distribution.angles(n, x.data(), y.data(), z.data(), theta.data(), phi.data());
            std::vector<double> counts(64);
            for (int i = 0; i < n; ++i) {
                const double turned = phi[i] < bins.phi.front() ? phi[i] + 2 * pi : phi[i];
                const auto row =
                    std::upper_bound(bins.theta.begin(), bins.theta.end(), theta[i]) - bins.theta.begin() - 1;
                const auto column =
                    std::upper_bound(bins.phi.begin(), bins.phi.end(), turned) - bins.phi.begin() - 1;
                REQUIRE((row >= 0 && row < 8 && column >= 0 && column < 8));
                counts[row * 8 + column] += 1. / n;
            }
            double sum = 0, off = 0;
            for (int i = 0; i < 64; ++i)
                sum += probabilities[i], off = std::max(off, std::abs(probabilities[i] - counts[i]));
            CHECK(sum == Catch::Approx(1).epsilon(2e-7));
            CHECK(off < 0.006);
        }
    }
}

TEST_CASE("pivots notice a density that is off") {
    // The plain NDF's normals are no visible normals, nor is the cap's reflection bounded.
    const reference::Lobe lobe{.wo = {0.8, 0, 0.6}, .alpha_x = 0.5, .alpha_y = 0.5};
    const Distribution visible("vndf_ggx_pdf_wm", lobe);
    const Distribution bounded("vndf_ggx_pdf_wi_eto2023", lobe);
    constexpr int n = 4096;
    double distance = 0, cap_distance = 0;
    std::vector<double> p, q;
    for (int i = 0; i < n; ++i) {
        const double u1 = lattice(i, 0.7548776662466927), u2 = lattice(i, 0.5698402909980532);
        const auto m = sample("ggx_sample_wm_walter2007", {0.5, 0.5, u1, u2});
        double p1, p2;
        visible.pivots(1, &m[0], &m[1], &m[2], &p1, &p2);
        p.push_back(p1);
        const auto v = sample("ggx_sample_wm_dupuy2023", {0.8, 0, 0.6, 0.5, 0.5, u1, u2});
        const double c = 0.8 * v[0] + 0.6 * v[2],
                     wi[] = {2 * c * v[0] - 0.8, 2 * c * v[1], 2 * c * v[2] - 0.6};
        bounded.pivots(1, &wi[0], &wi[1], &wi[2], &p1, &p2);
        q.push_back(p2);
    }
    std::sort(p.begin(), p.end());
    std::sort(q.begin(), q.end());
    for (int i = 0; i < n; ++i) {
        distance = std::max(distance, std::abs(p[i] - (i + 0.5) / n));
        cap_distance = std::max(cap_distance, std::abs(q[i] - (i + 0.5) / n));
    }
    CHECK(distance > 0.05);
    CHECK(cap_distance > 0.02);
}

TEST_CASE("reflections have the closed-form parts above the horizon and albedos") {
    constexpr int side = 256;
    const auto lattice_mean = [&](const char* name, double c, double alpha, auto&& f) {
        const double s = std::sqrt(1 - c * c);
        double sum = 0;
        for (int i = 0; i < side; ++i)
            for (int j = 0; j < side; ++j)
                sum += f(sample(name, {s, 0, c, alpha, alpha, (i + 0.5) / side, (j + 0.5) / side}));
        return sum / (side * side);
    };
    const auto reflected_z = [](double c) {
        return [c](const std::array<double, 4>& m) {
            const double s = std::sqrt(1 - c * c);
            return 2 * (s * m[0] + c * m[2]) * m[2] - c;
        };
    };
    const auto above = [&](double c) {
        return [&, c](const std::array<double, 4>& m) { return reflected_z(c)(m) > 0 ? 1. : 0.; };
    };
    CHECK(lattice_mean("ggx_sample_wm_heitz2018", 0.3, 1, above(0.3)) == Catch::Approx(1 / 1.3).margin(1e-3));
    CHECK(lattice_mean("ggx_sample_wm_dupuy2023", 1, 0.5, above(1)) == Catch::Approx(1 / 1.25).margin(1e-3));
    CHECK(lattice_mean("beckmann_sample_wm_jakob2014", 1, 0.7, above(1)) ==
          Catch::Approx(1 - std::exp(-1 / 0.49)).margin(3e-3));
    const auto below = [](const std::array<double, 4>& wi) { return wi[2] < 0 ? 1. : 0.; };
    CHECK(lattice_mean("ggx_sample_wi_eto2023", 0.5, 0.5, below) == Catch::Approx(0.0533970877).margin(1e-3));
    CHECK(lattice_mean("ggx_sample_wi_eto2023", 1, 0.5, below) == 0);
    CHECK(lattice_mean("ggx_sample_wi_eto2023", 0.3, 1, below) == 0);

    const auto albedo = [&](double c, double alpha) {
        const double s = std::sqrt(1 - c * c);
        return lattice_mean("ggx_sample_wm_dupuy2023", c, alpha, [&](const std::array<double, 4>& m) {
            const double cosine = s * m[0] + c * m[2];
            const std::vector<double> in = {
                s, 0, c, 2 * cosine * m[0] - s, 2 * cosine * m[1], 2 * cosine * m[2] - c, alpha, alpha};
            return evaluate("vndf_ggx_g2", in) / evaluate("vndf_ggx_g1", {s, 0, c, alpha, alpha});
        });
    };
    CHECK(albedo(0.4, 1) == Catch::Approx(1 - 0.4 * std::log(1 + 1 / 0.4)).margin(1e-4));
    CHECK(albedo(0.5, 0.5) == Catch::Approx(0.698250696928).margin(1e-4));
}

TEST_CASE("poles, horizons and clamps are as documented") {
    const double float_max = std::numeric_limits<float>::max(),
                 double_max = std::numeric_limits<double>::max();
    for (const std::string ndf : {"ggx", "beckmann"}) {
        const std::string p = "vndf_" + ndf + "_";
        CHECK(evaluate(p + "lambda", {1, 0, 0, 0.5, 0.5}) == float_max);
        CHECK(evaluate(p + "lambda", {1, 0, 0, 0.5, 0.5}, Precision::f64) == double_max);
        CHECK(evaluate(p + "lambda", {0, 0, 1, 0.5, 0.5}) == 0);
        CHECK(evaluate(p + "lambda", {0, 0, -1, 0.5, 0.5}) == -1);
        CHECK(evaluate(p + "lambda", {0.6, 0, -0.8, 0.5, 0.5}) ==
              Catch::Approx(-1 - evaluate(p + "lambda", {0.6, 0, 0.8, 0.5, 0.5})));
        for (const double z : {0., -0.5}) {
            CHECK(evaluate(p + "g1", {std::sqrt(1 - z * z), 0, z, 0.5, 0.5}) == 0);
            CHECK(evaluate(p + "ndf", {std::sqrt(1 - z * z), 0, z, 0.5, 0.5}) == 0);
            CHECK(evaluate(p + "pdf_wm", {0, 0, 1, std::sqrt(1 - z * z), 0, z, 0.5, 0.5}) == 0);
        }
        CHECK(evaluate(p + "g2", {0, 0, 1, 0.6, 0, -0.8, 0.5, 0.5}) == 0);
        CHECK(evaluate(p + "sigma", {0, 0, -1, 0.5, 0.5}) == 0);
        CHECK(evaluate(p + "pdf_wm", {0, 0, -1, 0.6, 0, 0.8, 0.5, 0.5}) == 0);
        CHECK(evaluate(p + "pdf_wm", {0.8, 0, 0.6, -0.8, 0, 0.6, 0.5, 0.5}) == 0);  // faces away
        CHECK(evaluate(p + "pdf_wi", {0.6, 0, 0.8, 0.6, 0, -0.8, 0.5, 0.5}) == 0);  // h on the horizon
        CHECK(evaluate(p + "pdf_wi", {0.6, 0, 0.8, 0.8, 0, -0.6, 0.5, 0.5}) > 0);   // wi below it
        CHECK(evaluate(p + "slope_cdf", {0.6, 5}) == 1);
        CHECK(evaluate(p + "slope_pdf", {0.6, 5}) == 0);
        CHECK(evaluate(p + "slope_cdf_inverse", {-1, 0.5}) == -float_max);
        CHECK(evaluate(p + "sigma", {0.6, 0.48, 0.64, 0, 0}) ==
              evaluate(p + "sigma", {0.6, 0.48, 0.64, 1e-9, 1e-9}));
    }
    CHECK(evaluate("vndf_jacobian_reflect", {1, 0, 0, 0, 0, 1}) == float_max);
    CHECK(evaluate("vndf_jacobian_refract", {0, 0, 1, 0, 0, -1, 1}) == float_max);
    for (const auto& in : {std::vector<double>{0.8, 0, -0.6, 0, 0, 1, 1.5}, {0.8, 0, 0.6, 0, 0, 1, 0.7}}) {
        double out[3];
        reference::find_evaluation<double>("vndf_refract")(in.data(), out, Precision::f32);
        CHECK((out[0] == 0 && out[1] == 0 && out[2] == 0));  // from behind; total internal reflection
    }
    for (const char* name :
         {"ggx_sample_wm_heitz_deon2014", "ggx_sample_wm_heitz2017", "beckmann_sample_wm_heitz_deon2014"})
        CHECK(sample(name, {0.6, 0, -0.8, 0.5, 0.5, 0.3, 0.6}) == std::array<double, 4>{0, 0, 1, 0});
    for (const char* name :
         {"ggx_sample_wm_heitz2018", "ggx_sample_wm_dupuy2023", "ggx_sample_wm_heitz_deon2014_exact",
          "beckmann_sample_wm_jakob2014", "ggx_sample_wi_eto2023"}) {
        const auto m = sample(name, {0, 0, -1, 0.5, 0.5, 0.3, 0.6});
        CHECK(m[3] == 0);
        CHECK(std::hypot(m[0], m[1], m[2]) == Catch::Approx(1));
        CHECK(sample(name, {0.6, 0, 0.8, 0, 0, 0, 1}) ==
              sample(name, {0.6, 0, 0.8, double(1e-8f), double(1e-8f), 0x1p-33, 1 - 0x1p-24}));
        CHECK(sample(name, {0.6, 0, 0.8, 0, 0, 0, 1}, Precision::f64) ==
              sample(name, {0.6, 0, 0.8, 1e-8, 1e-8, 0x1p-65, 1 - 0x1p-53}, Precision::f64));
        CHECK(sample(name, {6, 0, 8, 0.5, 0.5, 0.3, 0.6})[0] ==
              Catch::Approx(sample(name, {0.6, 0, 0.8, 0.5, 0.5, 0.3, 0.6})[0]));
    }
    CHECK(std::isnan(sample("ggx_sample_wm_dupuy2023", {0.6, 0, std::nan(""), 0.5, 0.5, 0.3, 0.6})[0]));
}

TEST_CASE("at normal incidence each map takes the axes of its listing") {
    const auto azimuth = [](const char* name, double u1, double u2) {
        const auto m = sample(name, {0, 0, 1, 0.5, 0.5, u1, u2});
        return std::atan2(m[1], m[0]);
    };
    const double u = 0.1;
    CHECK(azimuth("ggx_sample_wm_dupuy2023", u, 0.4) == Catch::Approx(2 * pi * u));
    CHECK(azimuth("ggx_sample_wm_heitz2018", u, 0.4) == Catch::Approx(2 * pi * u));   // w1 = x, w2 = y
    CHECK(azimuth("ggx_sample_wm_heitz2017", 0.4, u) == Catch::Approx(-2 * pi * u));  // T1 = x, T2 = -y
    const auto slopes = sample("ggx_sample_wm_heitz_deon2014_exact", {0, 0, 1, 0.5, 0.5, 0.2, 0.7});
    CHECK(slopes[0] > 0);  // x < 0 for u1 < 1/2, y > 0 for u2 > 1/2; the normal is (-x, -y, 1)
    CHECK(slopes[1] < 0);
    const auto world = sample("ggx_sample_wm_benyoub2024", {0.6, 0, 0.8, 0, 0, 1, 0.5, 0.1, 0.4});
    const auto cap = sample("ggx_sample_wm_dupuy2023", {0.6, 0, 0.8, 0.5, 0.5, 0.6, 0.4});
    for (int k = 0; k < 4; ++k) CHECK(world[k] == Catch::Approx(cap[k]));
}

TEST_CASE("every sampler is finite, unit and above the horizon over the hard grid") {
    const double alphas[][2] = {{1e-8, 1e-8}, {1e-6, 1e-6}, {1e-3, 1e-3}, {0.1, 0.1}, {1, 1},
                                {10, 10},     {1e3, 1e3},   {1e-6, 1},    {1, 1e-6},  {1e-3, 1e3}};
    const double cosines[] = {1, 1 - 1e-7, 0.9, 0.1, 1e-5, 1e-7, 0, -1e-7, -1e-3, -0.5, -0.99, -1 + 1e-7};
    const double us[] = {0x1p-32, 0x1p-24, 0.25, 0.5, 0.75, 1 - 0x1p-24};
    for (const Function* f : samplers()) {
        const auto both = reference::find_evaluation<double>(f->name + "_with_pdf");
        for (const auto& a : alphas)
            for (const double c : cosines)
                for (const double phi : {0., 0.7})
                    for (const double u1 : us)
                        for (const double u2 : us) {
                            const auto in = scalars(*f, {c, phi, a[0], a[1]}, u1, u2);
                            double out[4];
                            both(in.data(), out, Precision::f32);
                            const bool fine =
                                std::abs(std::hypot(out[0], out[1], out[2]) - 1) < 1e-14 && out[3] >= 0 &&
                                out[3] <= std::numeric_limits<float>::max() &&
                                (f->result == "WI" || f->arguments == "WO_N_ALPHA1_U" || out[2] >= 0);
                            if (!fine)
                                FAIL_CHECK(f->name << " cos " << c << " phi " << phi << " alpha " << a[0]
                                                   << ", " << a[1] << " u " << u1 << ", " << u2);
                        }
    }
}

TEST_CASE("the cap's margin tells inside from outside") {
    const auto margin = [](const std::vector<double>& in) {
        return reference::cap_margin("vndf_ggx_pdf_wi_eto2023", in.data(), Precision::f32);
    };
    const auto pdf = [](const std::vector<double>& in) { return evaluate("vndf_ggx_pdf_wi_eto2023", in); };
    const auto with = [&](const std::array<double, 4>& wi) {
        return std::vector<double>{0.6, 0, 0.8, wi[0], wi[1], wi[2], 0.5, 0.5};
    };
    const auto inside = with(sample("ggx_sample_wi_eto2023", {0.6, 0, 0.8, 0.5, 0.5, 0.3, 0.6}));
    const auto edge = with(sample("ggx_sample_wi_eto2023", {0.6, 0, 0.8, 0.5, 0.5, 0.3, 1}));
    CHECK(margin(inside) > 1e3);
    CHECK(pdf(inside) > 0);
    CHECK(std::abs(margin(edge)) < 64);
    CHECK(pdf(edge) > 0);
    // A normal of the whole cap whose reflection the bound leaves out.
    const auto m = sample("ggx_sample_wm_dupuy2023", {0.6, 0, 0.8, 0.5, 0.5, 0.3, 0.999});
    const double c = 0.6 * m[0] + 0.8 * m[2];
    const auto outside = with({2 * c * m[0] - 0.6, 2 * c * m[1], 2 * c * m[2] - 0.8, 0});
    CHECK(margin(outside) < -1e3);
    CHECK(pdf(outside) == 0);
    CHECK(evaluate("vndf_ggx_pdf_wi", outside) > 0);
}
