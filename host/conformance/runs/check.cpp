#include "conformance/runs/check.h"

#include <algorithm>
#include <chrono>
#include <deque>
#include <future>
#include <map>
#include <set>

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

class Run {
  public:
    Run(runtime::DeviceEvaluator& evaluator, runtime::Math math, const std::vector<const Function*>& selected,
        const CheckOptions& options)
        : evaluator_(evaluator), math_(math), options_(options) {
        report_.device = evaluator.program().device().label();
        report_.options = evaluator.program().build_options();
        report_.math = to_string(math);
        report_.real = to_string(evaluator.input_real());
        report_.seed = options.seed;
        report_.quick = options.quick;
        report_.samples = std::size_t{1} << (options.quick ? 18 : 20);
        report_.in_histogram = report_.samples / histogram_share;
        report_.family_rate = family_rate;
        pointwise_.quick = options.quick;
        pointwise_.scope = options.scope;
        for (const Function* function : selected) {
            if (is_plain_sampler(*function))
                report_.tests += lobes(*function, pointwise_).size() * tests_per_lobe(*function);
            work_total_ += work(*function);
        }
        report_.tests += options.more_tests;
        report_.level = sidak(family_rate, report_.tests);
        pointwise_.math = math;
        pointwise_.seed = options.seed;
        pointwise_.random_points =
            options.random_points ? options.random_points : std::size_t{1} << (options.quick ? 14 : 16);
        pointwise_.hard_stride = options.quick ? 7 : 1;
    }

    Report run(const std::vector<const Function*>& selected) {
        const auto start = std::chrono::steady_clock::now();
        for (const Function* function : selected) {
            options_.progress(function->name, work_done_ / work_total_);
            FunctionReport& judged = report_.functions.emplace_back();
            judged.function = function;
            find(judged);
            if (!options_.scope)
                for (Finding& finding : check_extremes(evaluator_, *function, pointwise_))
                    judged.findings.push_back(std::move(finding));
            for (Finding& finding : judged.findings)
                if (!finding.passed() || options_.draws(finding.passed())) add_values(*function, finding);
            work_done_ += work(*function);
        }
        if (math_ == runtime::Math::strict && !options_.scope) compare_bits(selected);
        options_.progress("", 1);
        report_.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
        return std::move(report_);
    }

  private:
    // In lobes.
    double work(const Function& function) const {
        return 2 + (is_plain_sampler(function) ? static_cast<double>(lobes(function, pointwise_).size()) : 0);
    }

    void compare_bits(const std::vector<const Function*>& selected) {
        BitsOptions bits;
        bits.rows = report_.bit_rows = options_.quick ? quick_digest_rows : std::size_t{1} << 16;
        bits.flushes = !evaluator_.program().device().denormals;
        report_.bits = compare_with_host(evaluator_, selected, bits);
    }

    // What the function and the reference make of the finding's worst inputs.
    void add_values(const Function& function, Finding& finding) {
        if (finding.row.empty()) return;
        Table inputs;
        for (const double x : finding.row) inputs.columns.push_back({x});
        for (const auto& column : evaluate(evaluator_, function, inputs))
            finding.result.push_back(column.front());
        if (function.model.empty()) return;  // of a distribution, which has many maps
        finding.exact.resize(function.outputs.size());
        reference::find_evaluation<double>(function.model)(finding.row.data(), finding.exact.data(),
                                                           precision(evaluator_.input_real()));
    }

    void find(FunctionReport& judged) {
        const Function& function = *judged.function;
        judged.findings = options_.scope ? check_user(evaluator_, function, pointwise_)
                                         : check_pointwise(evaluator_, function, pointwise_);
        const auto add = [&](std::vector<Finding> more) {
            std::move(more.begin(), more.end(), std::back_inserter(judged.findings));
        };
        if (function.kind == Kind::density) add(check_normalisation(evaluator_, function, pointwise_));
        if (is_plain_sampler(function)) {
            add(measure_bias(evaluator_, function));
            evaluator_.input_real() == Real::f32 ? statistics<float>(judged) : statistics<double>(judged);
        }
    }

    template <class T>
    void statistics(FunctionReport& judged) {
        const Function& sampler = *judged.function;
        const KnownBias bias = known_bias(sampler);
        Drawer<T> drawer(evaluator_, sampler, options_.seed, report_.samples);
        WorstLobes worst(sampler);
        // A thread for each lobe drawn, as many at once as the host has.
        std::deque<std::future<LobePicture>> judging;
        const auto finish_first = [&] {
            LobePicture picture = judging.front().get();
            for (const LobeTest& test : picture.tests) worst.add(test, picture.row);
            if (options_.draws(picture.passed())) judged.pictures.push_back(std::move(picture));
            judging.pop_front();
        };
        // Numbered by function and lobe, so that --only repeats a run's samples.
        std::uint64_t stream =
            options_.scope ? 0 : static_cast<std::uint64_t>(&sampler - functions().data()) << 16;
        double done = 0;
        for (const Point& lobe : lobes(sampler, pointwise_)) {
            options_.progress(sampler.name, (work_done_ + ++done) / work_total_);
            Batch<T> batch = drawer.draw(lobe, stream++);
            if (judging.size() >= thread_count()) finish_first();
            judging.push_back(std::async(std::launch::async, [&, batch = std::move(batch)] {
                LobePicture picture;
                test_lobe(sampler, batch.row, batch.x.size(), batch.x.data(), batch.y.data(), batch.z.data(),
                          report_.level, bias, &picture);
                return picture;
            }));
        }
        while (!judging.empty()) finish_first();
        worst.append_to(judged.findings);
    }

    runtime::DeviceEvaluator& evaluator_;
    runtime::Math math_;
    const CheckOptions& options_;
    PointwiseOptions pointwise_;
    Report report_;
    double work_total_ = 0, work_done_ = 0;
};

}  // namespace

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
    return Run(evaluator, math, selected, options).run(selected);
}

}  // namespace vndf::conformance
