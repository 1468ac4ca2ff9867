#include "conformance/runs/exhaustive.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <numeric>
#include <set>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "conformance/judge/errors.h"

namespace vndf::conformance {
namespace {

// The form in which what was found travels between processes.
using Json = nlohmann::json;

constexpr std::uint32_t all_u = 1u << 24;
constexpr std::uint32_t strip = 128;  // inputs of a work-item
constexpr std::uint32_t no_offender = ~0u;
constexpr std::uint32_t all_invariants = (1u << invariant_count) - 1;

// One u walks its multiples of 2^-24 while the other stays where it is: both ends as given and as clamped, what a
// generator of 32 bits can make below 2^-24, and the branch points.
constexpr std::array<float, 10> fixed_u{0,    0x1p-33f, 0x1p-32f, 0x1p-24f,     0.25f,
                                        0.5f, 0.75f,    1,        1 - 0x1p-23f, 1 - 0x1p-24f};
constexpr std::uint32_t lattices = 4;
constexpr std::uint32_t passes = 2 * fixed_u.size() + lattices;

// u_j = origin_j + 2^-24 ((step_j k + start_j) mod 2^24) for 0 <= k < 2^24.
struct Walk {
    std::array<float, 2> origin{0, 0};
    std::array<std::uint32_t, 2> step{1, 1}, start{0, 0};

    float u(int j, std::uint32_t k) const {
        return origin[j] + static_cast<float>((step[j] * k + start[j]) % all_u) * 0x1p-24f;
    }
};

Walk walk_of(std::uint32_t pass, std::uint32_t lobe) {
    Walk walk;
    if (pass < 2 * fixed_u.size()) {
        const std::uint32_t j = pass % 2;
        walk.origin[j] = fixed_u[pass / 2];
        walk.step[j] = 0;
    } else {
        // A rank-1 lattice by the golden ratio (an odd step: every u2 comes up once), shifted anew for each lobe.
        walk.step[1] = 10368889;
        walk.start[1] = ((pass * 0x9e3779b9u) ^ (lobe * 0x85ebca6bu)) >> 8;
    }
    return walk;
}

// The multiples of a step near the golden section of n, without a common divisor: an order of 0 ... n - 1.
std::size_t scattered(std::size_t i, std::size_t n) {
    std::size_t step = std::max<std::size_t>(1, n * 618 / 1000);
    while (std::gcd(step, n) != 1) ++step;
    return i * step % n;
}

struct Lobe {
    std::vector<float> row;   // a sampler's inputs
    bool defined = true;      // whether the sampler has a distribution there
    bool documented = false;  // whether it then returns the normal
};

Lobe lobe_of(const Function& sampler, const Point& point) {
    Lobe lobe;
    const Table table = tabulate(sampler, {point}, runtime::Real::f32);
    for (const std::vector<double>& column : table.columns) lobe.row.push_back(static_cast<float>(column[0]));
    if (column(sampler, "wo_x") < 0) return lobe;
    const auto at = [&](std::string_view name, float without) {
        return column(sampler, name) < 0 ? without : lobe.row[column(sampler, name)];
    };
    const bool opposite =
        at("wo_x", 0) == -at("n_x", 0) && at("wo_y", 0) == -at("n_y", 0) && at("wo_z", 0) == -at("n_z", 1);
    lobe.documented = sampler.domain == Domain::upper;
    lobe.defined = lobe.documented ? at("wo_z", 0) >= 0 : !opposite;
    return lobe;
}

using Tally = std::array<cl_uint, invariant_count + 1>;

// Whether all of a cap is sampled with a density: not where wo leaves no room for it, nor where -wo lies next to its rim.
bool has_room(const Point& point) {
    double chord2 = 0;
    for (int k = 0; k < 3; ++k) chord2 += (point.l[k] + point.wo[k]) * (point.l[k] + point.wo[k]);
    return point.one_minus_cos > 1e-3 * (1 + point.wo[2]) &&
           std::abs(std::sqrt(chord2) - std::sqrt(2 * point.one_minus_cos)) > 0x1p-11;
}

std::vector<Direction> hard_directions() {
    std::vector<Direction> directions;
    for (const double cosine : {1., 1 - 1e-7, .9, .5, .1, 1e-3, 1e-5, 1e-7, 1e-20, 0., -1e-20, -1e-7, -1e-5,
                                -1e-3, -.5, -.99, -1 + 1e-4, -1 + 1e-7, -1.})
        directions.push_back(std::abs(cosine) == 1 ? Direction{0, 0, cosine} : direction(cosine, 0.7));
    // Along an axis, where one tangential component vanishes, and next to the end that is undefined.
    for (const Direction& d : {Direction{1, 0, 0}, Direction{0, -1, 0}, Direction{-0.6, 0, 0.8},
                               Direction{0, 0.8, -0.6}, Direction{1e-12, 0, -1}, Direction{-1e-10, 1e-12, 1}})
        directions.push_back(d);
    return directions;
}

}  // namespace

bool ExhaustiveReport::passed() const {
    return inputs > 0 && std::all_of(samplers.begin(), samplers.end(), [](const Exhausted& sampler) {
               return std::all_of(sampler.offenders.begin(), sampler.offenders.end(),
                                  [](const Offenders& offenders) { return offenders.count == 0; });
           });
}

std::vector<const Function*> samplers_of(const std::vector<const Function*>& selected) {
    std::vector<const Function*> samplers;
    for (const Function* function : selected) {
        if (function->kind != Kind::sampler) continue;
        const Function* plain = find_function(function->plain);
        if (std::find(samplers.begin(), samplers.end(), plain) == samplers.end()) samplers.push_back(plain);
    }
    return samplers;
}

std::vector<Point> exhaustive_lobes(const Function& sampler) {
    const std::vector<std::array<double, 2>> alphas{
        {1e-8, 1e-8}, {1e-6, 1e-6}, {1e-4, 1e-4}, {1e-3, 1e-3}, {.01, .01}, {.1, .1},    {.5, .5},
        {1, 1},       {2, 2},       {10, 10},     {1e3, 1e3},   {1e-6, 1},  {1, 1e-6},   {1e-3, 1e3},
        {1e-4, .1},   {.2, .6},     {1e-8, 1e3},  {1e3, 1e-8},  {0, 0},     {1e-12, 0.3}};
    // The axes of the world-space sampler.
    const std::vector<Direction> axes{{0, 0, 1},
                                      direction(0, 1.3),
                                      direction(-.9, .4),
                                      direction(-1 + 1e-4, -1),
                                      direction(-1 + 1e-6, 2.2),
                                      {0, 0, -1},
                                      {1, 0, 0},
                                      direction(1e-7, -2.2),
                                      direction(-1e-20, 0.3)};
    const bool world = column(sampler, "n_x") >= 0;
    std::vector<Point> points;
    std::set<std::vector<double>> seen;
    std::size_t turn = 0;
    for (const auto& alpha : alphas)
        for (const Direction& wo : hard_directions())
            for (const std::size_t n : world ? std::vector{turn++ % axes.size(), turn * 5 % axes.size()}
                                             : std::vector<std::size_t>{0}) {
                Point point = make_point(wo, alpha, {1, 0}, axes[n], {0, 0}, 1.5);
                // Exactly n or -n in float, too.
                if (std::abs(wo[2]) == 1 && wo[0] == 0)
                    for (int k = 0; k < 3; ++k) point.wo[k] = wo[2] * axes[n][k];
                place_cap(point, true), place_tilt(point, false);
                if (column(sampler, "l_x") >= 0 && !has_room(point)) continue;
                if (seen.insert(tabulate(sampler, {point}, runtime::Real::f32).row(0)).second)
                    points.push_back(point);
            }
    std::vector<Point> order;
    for (std::size_t i = 0; i < points.size(); ++i) order.push_back(points[scattered(i, points.size())]);
    return order;
}

std::uint32_t exhaustive_parts(const std::vector<const Function*>& samplers) {
    std::size_t lobes = 0;
    for (const Function* sampler : samplers) lobes = std::max(lobes, exhaustive_lobes(*sampler).size());
    return passes * static_cast<std::uint32_t>(lobes);
}

runtime::ProgramOptions exhaustive_program(const std::vector<const Function*>& samplers) {
    runtime::ProgramOptions options;
    options.root = "kernels/batch/exhaustive.cl";
    for (const Function* sampler : samplers) options.functions.push_back(sampler->name);
    return options;
}

ExhaustiveWalk::ExhaustiveWalk(const std::vector<const Function*>& samplers, Slice slice)
    : samplers_(samplers), slice_(slice) {
    for (const Function* sampler : samplers) {
        lobes_.push_back(static_cast<std::uint32_t>(exhaustive_lobes(*sampler).size()));
        most_lobes_ = std::max(most_lobes_, lobes_.back());
        report_.whole += std::uint64_t{all_u} * passes * lobes_.back();
        Exhausted& exhausted = report_.samplers.emplace_back();
        exhausted.sampler = sampler;
        for (const char* name :
             {"all four numbers finite", "unit length",
              sampler->result == "WI" ? "half vector above the horizon" : "wm above the horizon",
              sampler->result == "WI" ? "wi in its cap" : "wm faces wo",
              "density positive where there is one, else 0"})
            exhausted.offenders.push_back({name, 0, {}});
    }
}

std::uint32_t ExhaustiveWalk::pieces() const {
    const std::uint32_t all = passes * most_lobes_;
    return slice_.index >= all ? 0 : (all - slice_.index - 1) / slice_.count + 1;
}

// Lobe by lobe, pass by pass; slices take the lobes in turn.
ExhaustiveWalk::Place ExhaustiveWalk::place(std::uint32_t piece) const {
    const std::uint32_t number = slice_.index + piece * slice_.count;
    return {number / most_lobes_, number % most_lobes_};
}

std::uint64_t ExhaustiveWalk::inputs(std::size_t sampler, std::uint32_t pieces) const {
    std::uint64_t inputs = 0;
    for (std::uint32_t piece = 0; piece < pieces; ++piece)
        if (place(piece).lobe < lobes_[sampler]) inputs += all_u;
    return inputs;
}

void ExhaustiveWalk::take(const std::string& walked) {
    const Json found = Json::from_cbor(walked);
    report_.device = found.at("device"), report_.options = found.at("options"),
    report_.math = found.at("math");
    ++taken_;
    for (const Json& one : found.at("samplers")) {
        Exhausted& exhausted = report_.samplers.at(one.at("sampler").get<std::size_t>());
        exhausted.inputs += all_u;
        exhausted.seconds += one.at("seconds").get<double>();
        report_.inputs += all_u;
        for (std::size_t i = 0; i < invariant_count; ++i) {
            Offenders& offenders = exhausted.offenders[i];
            if (offenders.count == 0) offenders.first = one.at("first").at(i);
            offenders.count += one.at("counts").at(i).get<std::uint64_t>();
        }
    }
}

void ExhaustiveWalk::resume(std::uint32_t taken, ExhaustiveReport report) {
    taken_ = taken;
    report_ = std::move(report);
}

// One sampler on the device.
class ExhaustiveWalker::OneSampler {
  public:
    OneSampler(const runtime::Program& program, const cl::Buffer& tally, const Function& sampler)
        : sampler_(sampler),
          program_(program),
          kernel_(program.kernel("vndf_exhaustive_" + sampler.name)),
          tally_(tally) {
        for (const Point& point : exhaustive_lobes(sampler)) lobes_.push_back(lobe_of(sampler, point));
    }

    std::size_t lobes() const { return lobes_.size(); }

    // The pass `round` over a lobe; lobes begin with different passes, so that a part of the walk has some of all.
    Json walk(std::uint32_t round, std::uint32_t lobe) {
        const auto start = std::chrono::steady_clock::now();
        const Walk walk = walk_of((round + lobe) % passes, lobe);
        const Tally tally = launch(lobes_[lobe], walk, all_invariants);
        std::vector<std::uint64_t> counts(tally.begin(), tally.begin() + invariant_count);
        std::vector<std::string> first(invariant_count);
        for (std::size_t i = 0; i < invariant_count; ++i)
            if (counts[i] != 0)
                first[i] = hex_row(lobes_[lobe], walk, launch(lobes_[lobe], walk, 1u << i).back());
        const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - start;
        return {{"counts", counts}, {"first", first}, {"seconds", taken.count()}};
    }

  private:
    Tally launch(const Lobe& lobe, const Walk& walk, std::uint32_t watch) {
        Tally tally{};
        tally.back() = no_offender;
        program_.queue().enqueueWriteBuffer(tally_, CL_FALSE, 0, sizeof tally, tally.data());
        cl_uint argument = 0;
        for (std::size_t i = 0; i < lobe.row.size(); ++i) {
            const std::string& name = sampler_.inputs[i];
            kernel_.setArg(argument++, name == "u1"   ? walk.origin[0]
                                       : name == "u2" ? walk.origin[1]
                                                      : lobe.row[i]);
        }
        for (const std::uint32_t value : {walk.step[0], walk.start[0], walk.step[1], walk.start[1], strip,
                                          std::uint32_t{lobe.defined}, std::uint32_t{lobe.documented}, watch})
            kernel_.setArg(argument++, cl_uint{value});
        kernel_.setArg(argument, tally_);
        program_.launch(kernel_, all_u / strip);
        program_.queue().enqueueReadBuffer(tally_, CL_TRUE, 0, sizeof tally, tally.data());
        return tally;
    }

    std::string hex_row(const Lobe& lobe, const Walk& walk, std::uint32_t k) const {
        std::vector<double> row(lobe.row.begin(), lobe.row.end());
        row[column(sampler_, "u1")] = walk.u(0, k);
        row[column(sampler_, "u2")] = walk.u(1, k);
        return conformance::hex_row(sampler_, row);
    }

    const Function& sampler_;
    const runtime::Program& program_;
    cl::Kernel kernel_;
    cl::Buffer tally_;
    std::vector<Lobe> lobes_;
};

ExhaustiveWalker::ExhaustiveWalker(const ExhaustiveWalk& walk, runtime::Program program)
    : walk_(walk), program_(std::move(program)) {
    program_.guarded("walk", [&] {
        tally_ = program_.buffer(sizeof(Tally));
        for (const Function* sampler : walk.samplers_) samplers_.emplace_back(program_, tally_, *sampler);
    });
}

ExhaustiveWalker::~ExhaustiveWalker() = default;

std::string ExhaustiveWalker::walk(std::uint32_t piece) {
    const auto [round, lobe] = walk_.place(piece);
    Json found{{"device", program_.device().label()},
               {"options", program_.build_options()},
               {"math", to_string(program_.math())},
               {"samplers", Json::array()}};
    program_.guarded("walk", [&] {
        for (std::size_t i = 0; i < samplers_.size(); ++i) {
            if (lobe >= samplers_[i].lobes()) continue;
            found["samplers"].push_back(samplers_[i].walk(round, lobe));
            found["samplers"].back()["sampler"] = i;
        }
    });
    std::string bytes;
    Json::to_cbor(found, bytes);
    return bytes;
}

std::string format_table(const ExhaustiveReport& report) {
    std::size_t width = 8;
    for (const Exhausted& s : report.samplers) width = std::max(width, s.sampler->name.size());
    std::string text =
        fmt::format("{:<{}}  {:>9}  {:>8}  {}\n", "sampler", width, "inputs", "M/s", "offenders");
    std::string details;
    for (const Exhausted& s : report.samplers) {
        std::string found;
        for (const Offenders& o : s.offenders) {
            if (o.count == 0) continue;
            found += fmt::format("{}{} ({})", found.empty() ? "" : ", ", o.count, o.invariant);
            details +=
                fmt::format("\nFAILED {}: {}: {} of {:.3g} inputs, the first\n  at {}\n", s.sampler->name,
                            o.invariant, o.count, static_cast<double>(s.inputs), o.first);
        }
        text += fmt::format("{:<{}}  {:>9.3g}  {:>8.0f}  {}\n", s.sampler->name, width,
                            static_cast<double>(s.inputs),
                            s.inputs == 0 ? 0 : 1e-6 * static_cast<double>(s.inputs) / s.seconds,
                            !found.empty()  ? found
                            : s.inputs == 0 ? "not walked"
                                            : "none");
    }
    const auto inputs = static_cast<double>(report.inputs), whole = static_cast<double>(report.whole);
    text += details;
    text += fmt::format("\n{} float on {}\n  {}\n", report.math, report.device, report.options);
    text += fmt::format("{:.3g} inputs walked, {:.3g} % of all {:.3g}, in {:.0f} s: {}\n", inputs,
                        100 * inputs / whole, whole, report.seconds, report.passed() ? "none bad" : "FAIL");
    return text;
}

}  // namespace vndf::conformance
