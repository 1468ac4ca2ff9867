#include "conformance/runs/check.h"

#include <algorithm>
#include <chrono>
#include <deque>
#include <future>
#include <map>
#include <set>

#include <nlohmann/json.hpp>

#include "conformance/judge/digest.h"
#include "conformance/judge/extremes.h"
#include "conformance/inputs/grids.h"
#include "conformance/inputs/rows.h"
#include "conformance/judge/known_bias.h"
#include "conformance/judge/lobes.h"
#include "parallel.h"
#include "conformance/judge/pointwise.h"
#include "conformance/judge/user.h"
#include "conformance/judge/values.h"

namespace vndf::reference {
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Bins, theta, phi)
}  // namespace vndf::reference

namespace vndf::conformance {
namespace {

constexpr double family_rate = 1e-6;

bool matches(std::string_view glob, std::string_view name) {
    if (glob.empty()) return name.empty();
    if (glob.front() == '*')
        return matches(glob.substr(1), name) || (!name.empty() && matches(glob, name.substr(1)));
    return !name.empty() && (glob.front() == '?' || glob.front() == name.front()) &&
           matches(glob.substr(1), name.substr(1));
}

// The directions of a lobe: what the device draws while the host judges the lobe before.
template <class T>
struct Batch {
    std::vector<double> row;
    std::vector<T> x, y, z;
};

template <class T>
class Drawer {
  public:
    Drawer(runtime::DeviceEvaluator& evaluator, const Function& sampler, std::uint64_t seed,
           std::size_t samples)
        : evaluator_(evaluator),
          sampler_(sampler),
          seed_(seed),
          inputs_(sampler.inputs.size(), std::vector<T>(samples)) {}

    Batch<T> draw(const Point& lobe, std::uint64_t stream) {
        const std::size_t n = inputs_.front().size();
        const Table table = tabulate(sampler_, {lobe}, evaluator_.input_real());
        Batch<T> batch{table.row(0), std::vector<T>(n), std::vector<T>(n), std::vector<T>(n)};
        std::vector<const void*> in;
        for (std::size_t i = 0; i < inputs_.size(); ++i) {
            if (const std::string& name = sampler_.inputs[i]; name != "u1" && name != "u2")
                std::fill(inputs_[i].begin(), inputs_[i].end(), static_cast<T>(batch.row[i]));
            in.push_back(inputs_[i].data());
        }
        evaluator_.uniforms(seed_, stream, n, inputs_.at(column(sampler_, "u1")).data(),
                            inputs_.at(column(sampler_, "u2")).data());
        evaluator_.run(sampler_, n, in, {batch.x.data(), batch.y.data(), batch.z.data()});
        return batch;
    }

  private:
    runtime::DeviceEvaluator& evaluator_;
    const Function& sampler_;
    std::uint64_t seed_;
    std::vector<std::vector<T>> inputs_;
};

// The form in which findings travel between processes.
using Json = nlohmann::json;

std::string packed(const Json& content) {
    std::string bytes;
    Json::to_cbor(content, bytes);
    return bytes;
}

// Enough that the host judges some while the device draws others.
constexpr std::size_t lobes_of_piece = 12, lobes_of_quick_piece = 6;

}  // namespace

NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Finding, check, figure, limit, unit, is_p, concern, biased, detail, worst,
                                   count, p50, p99, max, row, result, exact)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(LobeTest, name, is_p, figure, detail, limit, unit)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(CellCounts, observed, expected)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(MeanTest, name, difference, tolerance, error)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(LobePicture, row, pivots, directions, bins, means, notes, tests)

CheckRun::CheckRun(runtime::Math math, runtime::Real real, const std::vector<const Function*>& selected,
                   const CheckOptions& options)
    : math_(math), real_(real), options_(options), start_(std::chrono::steady_clock::now()) {
    report_.math = to_string(math);
    report_.real = to_string(real);
    report_.seed = options.seed;
    report_.quick = options.quick;
    report_.samples = std::size_t{1} << (options.quick ? 18 : 20);
    report_.in_histogram = report_.samples / histogram_share;
    report_.family_rate = family_rate;
    if (compares_bits()) report_.bit_rows = options.quick ? quick_digest_rows : std::size_t{1} << 16;
    pointwise_.quick = options.quick;
    pointwise_.scope = options.scope;
    for (const Function* function : selected) plan(*function);
    report_.tests += options.more_tests;
    report_.level = sidak(family_rate, report_.tests);
    pointwise_.math = math;
    pointwise_.seed = options.seed;
    pointwise_.random_points =
        options.random_points ? options.random_points : std::size_t{1} << (options.quick ? 14 : 16);
    pointwise_.hard_stride = options.quick ? 7 : 1;
}

CheckRun::~CheckRun() = default;

void CheckRun::plan(const Function& function) {
    pieces_.push_back({&function, 0, 0});
    work_total_ += work(pieces_.back());
    if (!is_plain_sampler(function)) return;
    const std::size_t count = lobes(function, pointwise_).size();
    report_.tests += count * tests_per_lobe(function);
    const std::size_t most = options_.quick ? lobes_of_quick_piece : lobes_of_piece;
    for (std::size_t first = 0; first < count; first += most) {
        pieces_.push_back({&function, first, std::min(first + most, count)});
        work_total_ += work(pieces_.back());
    }
}

// In lobes.
double CheckRun::work(const Piece& piece) const {
    return piece.is_lobes() ? static_cast<double>(piece.end - piece.first) : 2;
}

bool CheckRun::compares_bits() const {
    return math_ == runtime::Math::strict && !options_.scope;
}

// What is said of a function but for its samples.
struct CheckRun::Values {
    std::vector<Finding> findings, extremes;
    BitDifference bits = {};
};

std::string CheckRun::judge(runtime::DeviceEvaluator& evaluator, std::size_t number) const {
    const Piece& piece = pieces_.at(number);
    Json judged{{"device", evaluator.program().device().label()},
                {"options", evaluator.program().build_options()}};
    if (piece.is_lobes()) {
        judged["pictures"] =
            real_ == Real::f32 ? draw<float>(evaluator, piece) : draw<double>(evaluator, piece);
    } else {
        const Values values = judge_values(evaluator, *piece.function);
        const BitDifference& bits = values.bits;
        judged["findings"] = values.findings;
        judged["extremes"] = values.extremes;
        judged["bits"] = {bits.differing, bits.exempt, bits.ulps, bits.worst};
    }
    return packed(judged);
}

// All but the statistics of a sampler.
CheckRun::Values CheckRun::judge_values(runtime::DeviceEvaluator& evaluator, const Function& function) const {
    Values values{options_.scope ? check_user(evaluator, function, pointwise_)
                                 : check_pointwise(evaluator, function, pointwise_),
                  {}};
    const auto add = [&](std::vector<Finding> more) {
        std::move(more.begin(), more.end(), std::back_inserter(values.findings));
    };
    if (function.kind == Kind::density) add(check_normalisation(evaluator, function, pointwise_));
    if (is_plain_sampler(function)) add(measure_bias(evaluator, function));
    if (!options_.scope) values.extremes = check_extremes(evaluator, function, pointwise_);
    for (std::vector<Finding>* of : {&values.findings, &values.extremes})
        for (Finding& finding : *of)
            if (!finding.passed() || options_.draws(finding.passed()))
                add_values(evaluator, function, finding);
    if (!compares_bits()) return values;
    BitsOptions bits;
    bits.rows = report_.bit_rows;
    bits.flushes = !evaluator.program().device().denormals;
    values.bits = compare_with_host(evaluator, {&function}, bits).front();
    return values;
}

// What the function and the reference make of the finding's worst inputs.
void CheckRun::add_values(runtime::DeviceEvaluator& evaluator, const Function& function,
                          Finding& finding) const {
    if (finding.row.empty()) return;
    Table inputs;
    for (const double x : finding.row) inputs.columns.push_back({x});
    for (const auto& column : evaluate(evaluator, function, inputs)) finding.result.push_back(column.front());
    if (function.model.empty()) return;  // of a distribution, which has many maps
    finding.exact.resize(function.outputs.size());
    reference::find_evaluation<double>(function.model)(finding.row.data(), finding.exact.data(),
                                                       precision(real_));
}

// The pictures of a piece's lobes; of those that nobody will draw what they were tested for alone.
template <class T>
std::vector<LobePicture> CheckRun::draw(runtime::DeviceEvaluator& evaluator, const Piece& piece) const {
    const Function& sampler = *piece.function;
    const KnownBias bias = known_bias(sampler);
    Drawer<T> drawer(evaluator, sampler, options_.seed, report_.samples);
    std::vector<LobePicture> pictures;
    // A thread for each lobe drawn, as many at once as the host has.
    std::deque<std::future<LobePicture>> judging;
    const auto finish_first = [&] {
        LobePicture picture = judging.front().get();
        if (!options_.draws(picture.passed())) picture = {picture.row, {}, {}, {}, {}, {}, picture.tests};
        pictures.push_back(std::move(picture));
        judging.pop_front();
    };
    // Numbered by function and lobe, so that --only repeats a run's samples.
    const std::uint64_t stream =
        options_.scope ? 0 : static_cast<std::uint64_t>(&sampler - functions().data()) << 16;
    const std::vector<Point> all = lobes(sampler, pointwise_);
    for (std::size_t i = piece.first; i < piece.end; ++i) {
        Batch<T> batch = drawer.draw(all[i], stream + i);
        if (judging.size() >= thread_count()) finish_first();
        judging.push_back(std::async(std::launch::async, [&, batch = std::move(batch)] {
            LobePicture picture;
            test_lobe(sampler, batch.row, batch.x.size(), batch.x.data(), batch.y.data(), batch.z.data(),
                      report_.level, bias, &picture);
            return picture;
        }));
    }
    while (!judging.empty()) finish_first();
    return pictures;
}

// What is known so far of the function that is being taken.
struct CheckRun::Taking {
    explicit Taking(const Function& function) : worst(function) {}

    WorstLobes worst;
    std::vector<Finding> extremes;
};

void CheckRun::take(const std::string& bytes) {
    const Piece& piece = pieces_.at(taken_++);
    const Json judged = Json::from_cbor(bytes);
    report_.device = judged.at("device"), report_.options = judged.at("options");
    if (!piece.is_lobes()) {
        FunctionReport& report = report_.functions.emplace_back();
        report.function = piece.function;
        report.findings = judged.at("findings");
        taking_ = std::make_unique<Taking>(*piece.function);
        taking_->extremes = judged.at("extremes");
        if (compares_bits()) {
            const Json& bits = judged.at("bits");
            report_.bits.push_back({piece.function, bits.at(0), bits.at(1), bits.at(2), bits.at(3)});
        }
    } else {
        for (LobePicture& picture : judged.at("pictures").get<std::vector<LobePicture>>()) {
            for (const LobeTest& test : picture.tests) taking_->worst.add(test, picture.row);
            if (options_.draws(picture.passed()))
                report_.functions.back().pictures.push_back(std::move(picture));
        }
    }
    if (taken_ == pieces_.size() || pieces_[taken_].function != piece.function) finish_function();
    work_done_ += work(piece);
    options_.progress(piece.function->name, work_done_ / work_total_);
}

void CheckRun::finish_function() {
    std::vector<Finding>& findings = report_.functions.back().findings;
    taking_->worst.append_to(findings);
    std::move(taking_->extremes.begin(), taking_->extremes.end(), std::back_inserter(findings));
}

Report CheckRun::finish() {
    options_.progress("", 1);
    report_.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
    return std::move(report_);
}

std::vector<const Function*> select(const std::string& pattern) {
    std::vector<const Function*> selected;
    for (const Function& function : functions())
        if (function.name.find(pattern) != std::string::npos || matches(pattern, function.name))
            selected.push_back(&function);
    return selected;
}

std::vector<std::string> needed(const std::vector<const Function*>& selected) {
    std::set<std::string> names;
    for (const Function* function : selected) {
        names.insert(function->name);
        if (!function->with_pdf) continue;
        names.insert(function->plain);
        names.insert(function->density);
    }
    return {names.begin(), names.end()};
}

Report check(runtime::DeviceEvaluator& evaluator, runtime::Math math,
             const std::vector<const Function*>& selected, const CheckOptions& options) {
    CheckRun run(math, evaluator.input_real(), selected, options);
    for (std::size_t piece = 0; piece < run.pieces(); ++piece) run.take(run.judge(evaluator, piece));
    Report report = run.finish();
    report.device = evaluator.program().device().label();
    report.options = evaluator.program().build_options();
    return report;
}

}  // namespace vndf::conformance
