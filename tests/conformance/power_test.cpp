// How large a mistake has to be for clvndf check --kernel to see it: the numbers of tests/data/power.json, which tests/README.md
// shows, measured by the hidden case and held by the other.
#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstdlib>
#include <fstream>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "conformance/inputs/grids.h"
#include "conformance/inputs/rows.h"
#include "conformance/judge/lobes.h"
#include "conformance/judge/user.h"
#include "parallel.h"
#include "splitmix64.h"
#include "support/catch.h"

using namespace vndf;
using namespace vndf::conformance;

namespace {

constexpr double family_rate = 1e-6;  // of clvndf check
constexpr std::size_t samples_of(bool quick) {
    return std::size_t{1} << (quick ? 18 : 20);
}

// One sample's numbers, as a mistake of size x may change them.
struct Sample {
    std::array<float, 2> alpha, u;
};

// The numbers come from `u`, the mistake's own dice from `dice`.
struct Mistake {
    std::string what;
    void (*before)(Sample& sample, double x);
    void (*after)(Direction& m, const Sample& sample, double x);
    bool often_plain = false;  // a share x of the normals are those of the surface, not of the view
};

void nothing(Sample&, double) {}
void nothing(Direction&, const Sample&, double) {}

// Of vndf_ggx_sample_wm_dupuy2023, u1 the azimuth in a cap and u2 the distance from its rim.
const std::vector<Mistake>& mistakes() {
    static const std::vector<Mistake> all{
        {"both alphas times 1 + x",
         [](Sample& s, double x) {
             for (float& a : s.alpha) a *= static_cast<float>(1 + x);
         },
         nothing},
        {"one alpha times 1 + x", [](Sample& s, double x) { s.alpha[0] *= static_cast<float>(1 + x); },
         nothing},
        {"all slopes shifted by x alpha", nothing,
         [](Direction& m, const Sample& s, double x) { m[0] += x * s.alpha[0] * m[2]; }},
        {"a slice of the azimuth with a share x of a lobe is never drawn",
         [](Sample& s, double x) { s.u[0] *= static_cast<float>(1 - x); }, nothing},
        {"the outermost share x of a lobe is never drawn",
         [](Sample& s, double x) { s.u[1] *= static_cast<float>(1 - x); }, nothing},
        {"visibility is forgotten in a share x of the samples", nothing, nothing, true}};
    return all;
}

// The first n samples of a lobe with the mistake in them.
std::array<std::vector<float>, 3> draw(const Mistake& mistake, double x, const Point& lobe, std::size_t n,
                                       std::uint64_t seed) {
    const Function& visible = *find_function("vndf_ggx_sample_wm_dupuy2023");
    const Function& plain = *find_function("vndf_ggx_sample_wm_walter2007");
    runtime::HostEvaluator host(runtime::Math::strict, Real::f32);
    std::vector<std::vector<float>> in(visible.inputs.size(), std::vector<float>(n));
    std::vector<Sample> samples(n);
    SplitMix64 random(splitmix64(seed));
    for (std::size_t i = 0; i < n; ++i) {
        Sample& s = samples[i];
        s = {{static_cast<float>(lobe.alpha[0]), static_cast<float>(lobe.alpha[1])},
             {static_cast<float>(random.uniform()), static_cast<float>(random.uniform())}};
        mistake.before(s, x);
        for (int k = 0; k < 3; ++k) in[k][i] = static_cast<float>(lobe.wo[k]);
        for (int k = 0; k < 2; ++k) in[3 + k][i] = s.alpha[k], in[5 + k][i] = s.u[k];
    }
    std::array<std::vector<float>, 3> m, other;
    std::vector<const void*> inputs;
    for (const auto& column : in) inputs.push_back(column.data());
    const auto run = [&](const Function& function, std::array<std::vector<float>, 3>& to) {
        for (auto& column : to) column.resize(n);
        host.run(function, n,
                 {inputs.end() - static_cast<std::ptrdiff_t>(function.inputs.size()), inputs.end()},
                 {to[0].data(), to[1].data(), to[2].data()});
    };
    run(visible, m);
    if (mistake.often_plain) run(plain, other);
    for (std::size_t i = 0; i < n; ++i) {
        const auto& from = mistake.often_plain && random.uniform() < x ? other : m;
        Direction d{from[0][i], from[1][i], from[2][i]};
        mistake.after(d, samples[i], x);
        const double size = length(d);
        for (int k = 0; k < 3; ++k) m[k][i] = static_cast<float>(d[k] / size);
    }
    return m;
}

// Whether a run, of one sampler in the scope that is the default, fails for the mistake. `first` is the lobe to look at first, and
// becomes the one that showed it.
bool is_noticed(const Mistake& mistake, double x, bool quick, std::uint64_t seed, std::size_t& first) {
    const Function& sampler = *find_function("vndf_ggx_sample_wm_dupuy2023");
    const std::vector<Point> all = lobes(sampler, Scope(), quick);
    const double level = sidak(family_rate, all.size() * tests_per_lobe(sampler));
    const std::size_t begin = first;
    for (std::size_t k = 0; k < all.size(); ++k) {
        first = (begin + k) % all.size();
        const std::vector<double> row = tabulate(sampler, {all[first]}, Real::f32).row(0);
        const auto m = draw(mistake, x, all[first], samples_of(quick), splitmix64(seed + first));
        for (const LobeTest& t :
             test_lobe(sampler, row, m[0].size(), m[0].data(), m[1].data(), m[2].data(), level, KnownBias()))
            if (t.is_p ? t.figure < level : t.figure > 1) return true;
    }
    first = begin;
    return false;
}

// A density that is too large.
class TooLarge final : public runtime::Evaluator {
  public:
    explicit TooLarge(double x) : factor_(static_cast<float>(1 + x)) {}
    void run(const Function& function, std::size_t n, const std::vector<const void*>& inputs,
             const std::vector<void*>& outputs) override {
        host_.run(function, n, inputs, outputs);
        for (std::size_t i = 0; i < n; ++i) static_cast<float*>(outputs[0])[i] *= factor_;
    }
    Real input_real() const override { return Real::f32; }
    Real output_real() const override { return Real::f32; }
    std::string describe() const override { return "a density that is too large"; }

  private:
    runtime::HostEvaluator host_{runtime::Math::strict, Real::f32};
    float factor_;
};

bool is_noticed_in_density(double x, bool quick) {
    const Scope scope;
    PointwiseOptions options;
    options.scope = &scope, options.quick = quick;
    if (quick) options.random_points = std::size_t{1} << 14;
    TooLarge evaluator(x);
    const auto findings = check_user(evaluator, *find_function("vndf_ggx_pdf_wm"), options);
    return std::any_of(findings.begin(), findings.end(),
                       [](const Finding& f) { return !f.passed() && f.concern == Concern::wrong; });
}
constexpr const char* density_mistake = "a density times 1 + x";

// In how many of the trials; counts no further once too many were missed.
int noticed(const Mistake& mistake, double x, bool quick, int trials, int most_missed) {
    std::atomic<int> found = 0, missed = 0;
    static std::atomic<std::size_t> telling = 0;  // the lobe that showed the last one
    parallel_for(static_cast<std::size_t>(trials), 1, [&](unsigned, std::size_t trial, std::size_t) {
        if (missed > most_missed) return;
        std::size_t first = quick ? telling % 12 : telling.load();
        ++(is_noticed(mistake, x, quick, 1000 * (trial + 1), first) ? found : missed);
        telling = first;
    });
    return found;
}

constexpr int trials = 20, most_missed = 1;  // .95

// The smallest x of the sequence 1/16, 1/16 / sqrt(2), ... that is noticed, as are all before it.
template <class Noticed>
double smallest(Noticed noticed) {
    double x = std::sqrt(2.0) / 16;
    while (noticed(x / std::sqrt(2.0))) x /= std::sqrt(2.0);
    return x;
}

constexpr const char* file = CLVNDF_SOURCE_DIR "/tests/data/power.json";

}  // namespace

TEST_CASE("what is said of the power of check is so: that much is noticed, half of it is not") {
    const auto measured = nlohmann::json::parse(std::ifstream(file));
    REQUIRE(measured["mistakes"].size() == mistakes().size() + 1);
    CHECK((measured["trials"] == trials && measured["noticed"] == trials - most_missed));
    for (std::size_t i = 0; i < mistakes().size(); ++i) {
        const auto& row = measured["mistakes"][i];
        CAPTURE(row.dump());
        REQUIRE(row["mistake"] == mistakes()[i].what);
        const double x = row["quick"];
        CHECK(row["full"].get<double>() < x);
        CHECK(noticed(mistakes()[i], x, true, 3, 0) >= 2);
        std::size_t first = 0;
        CHECK_FALSE(is_noticed(mistakes()[i], x / 2, true, 7, first));
    }
    const auto& row = measured["mistakes"].back();
    REQUIRE(row["mistake"] == density_mistake);
    CHECK(is_noticed_in_density(row["quick"], true));
    CHECK_FALSE(is_noticed_in_density(row["quick"].get<double>() / 2, true));
}

// CLVNDF_POWER names the file to write.
TEST_CASE("the power of check, measured", "[.power-full]") {
    const char* path = std::getenv("CLVNDF_POWER");
    REQUIRE(path);
    nlohmann::ordered_json rows = nlohmann::ordered_json::array();
    const auto add = [&](const std::string& what, auto noticed) {
        rows.push_back({{"mistake", what},
                        {"quick", smallest([&](double x) { return noticed(x, true); })},
                        {"full", smallest([&](double x) { return noticed(x, false); })}});
        fmt::print("{}\n", rows.back().dump());
        std::fflush(stdout);
    };
    for (const Mistake& mistake : mistakes())
        add(mistake.what, [&](double x, bool quick) {
            return noticed(mistake, x, quick, trials, most_missed) >= trials - most_missed;
        });
    add(density_mistake, is_noticed_in_density);
    const Function& sampler = *find_function("vndf_ggx_sample_wm_dupuy2023");
    nlohmann::ordered_json runs;
    for (const bool quick : {true, false})
        runs[quick ? "quick" : "full"] = {{"lobes", lobes(sampler, Scope(), quick).size()},
                                          {"samples", samples_of(quick)}};
    const nlohmann::ordered_json all{
        {"trials", trials}, {"noticed", trials - most_missed}, {"runs", runs}, {"mistakes", rows}};
    std::ofstream(path) << all.dump(1) << '\n';
}
