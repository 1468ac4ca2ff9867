#include "session.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <set>
#include <thread>

#include <fmt/format.h>

#include "conformance/judge/known_bias.h"
#include "conformance/judge/pointwise.h"
#include "cpp_build.h"
#include "inputs.h"
#include "sources.h"

namespace vndf::bench {
namespace {

using runtime::DeviceEvaluator, runtime::Math, runtime::Real;
using Clock = std::chrono::steady_clock;

constexpr std::size_t column_bytes = std::size_t{1} << 24;  // far beyond every cache, with 10 columns
constexpr std::size_t distinct_rows = std::size_t{1} << 16;
constexpr std::ptrdiff_t judged_rows = 1 << 14;  // the reference takes microseconds for each
constexpr std::size_t warm_part = 16;            // of the data, to load code, not the data into a cache
constexpr double slow_launch_s = 0.06;           // longer launches are cut to a quarter of the samples
constexpr double compute_launch_s = 0.004;       // long beside the cost of a launch
constexpr std::size_t most_items = std::size_t{1} << 28;
constexpr std::size_t cpp_rows = 512;  // of the C++ build when compute-bound: they fit the first cache

double seconds_since(Clock::time_point start) {
    return std::chrono::duration<double>(Clock::now() - start).count();
}

bool in_world_space(const Function& function) {
    return conformance::column(function, "n_x") >= 0;
}

// A program without any registered function.
runtime::ProgramOptions own_program(const std::string& source) {
    runtime::ProgramOptions options;
    options.root = "kernels/vndf/impl/shim.h";
    options.more_source = source;
    return options;
}

std::vector<char> to_bytes(const std::vector<double>& values, Real real) {
    std::vector<char> bytes(values.size() * size_of(real));
    if (real == Real::f64) {
        std::copy(values.begin(), values.end(), reinterpret_cast<double*>(bytes.data()));
    } else {
        std::copy(values.begin(), values.end(), reinterpret_cast<float*>(bytes.data()));
    }
    return bytes;
}

}  // namespace

bool is_published(const Function& function) {
    static const std::set<std::string> listings = {
        "vndf_ggx_sample_wm_heitz_deon2014",     "vndf_ggx_sample_wm_heitz2017",
        "vndf_ggx_sample_wm_heitz2018",          "vndf_ggx_sample_wm_dupuy2023",
        "vndf_ggx_sample_wm_benyoub2024",        "vndf_ggx_sample_wi_eto2023",
        "vndf_beckmann_sample_wm_heitz_deon2014"};
    return listings.contains(function.name);
}

bool has_steps(const Function& function) {
    return function.name == "vndf_beckmann_sample_wm_jakob2014";
}

bool has_basis(const Function& function) {
    return function.name == "vndf_ggx_sample_wm_benyoub2024";
}

Session::Session(const runtime::Device& device)
    : arithmetic_(device, Math::strict, Real::f32, own_program(arithmetic_source())) {}

const conformance::Table& Session::table(const Function& function, Real real) {
    auto [found, missing] = tables_.try_emplace(function.name + std::string(to_string(real)));
    if (missing) {
        found->second =
            conformance::tabulate(function, points(distinct_rows, in_world_space(function)), real);
    }
    return found->second;
}

// The column's distinct rows, repeated to its full length.
cl::Buffer& Session::input(const Function& function, std::size_t index, Real real) {
    const std::string key =
        fmt::format("{} {} {}", function.inputs[index], in_world_space(function), to_string(real));
    const auto found = inputs_.find(key);
    if (found != inputs_.end()) return found->second;
    const cl::CommandQueue& queue = arithmetic_.queue();
    const cl::Buffer buffer = arithmetic_.buffer(column_bytes);
    const std::vector<char> bytes = to_bytes(table(function, real).columns[index], real);
    queue.enqueueWriteBuffer(buffer, CL_TRUE, 0, bytes.size(), bytes.data());
    for (std::size_t filled = bytes.size(); filled < column_bytes; filled *= 2)
        queue.enqueueCopyBuffer(buffer, buffer, 0, filled, std::min(filled, column_bytes - filled));
    queue.finish();
    return inputs_[key] = buffer;
}

cl::Buffer& Session::output(std::size_t index) {
    while (outputs_.size() <= index) outputs_.push_back(arithmetic_.buffer(column_bytes));
    return outputs_[index];
}

Timing Session::launch(const cl::Kernel& kernel, std::size_t work_items) {
    cl::Event event;
    const auto start = Clock::now();
    arithmetic_.launch(kernel, work_items, &event);
    arithmetic_.queue().finish();
    const double wall_s = seconds_since(start);
    cl_ulong begin = 0, end = 0;
    event.getProfilingInfo(CL_PROFILING_COMMAND_START, &begin);
    event.getProfilingInfo(CL_PROFILING_COMMAND_END, &end);
    return {wall_s, static_cast<double>(end - begin) * 1e-9};
}

cl::Kernel Session::stream_kernel(const Function& function, DeviceEvaluator& evaluator) {
    cl::Kernel kernel = evaluator.program().kernel("vndf_batch_" + function.name);
    cl_uint argument = 0;
    for (std::size_t i = 0; i < function.inputs.size(); ++i)
        kernel.setArg(argument++, input(function, i, evaluator.input_real()));
    for (std::size_t i = 0; i < function.outputs.size(); ++i) kernel.setArg(argument++, output(i));
    kernel.setArg(argument, cl_uint{0});
    return kernel;
}

// Builds the program until its kernel has run: some drivers compile at the first launch. Returns the seconds that the
// same launch takes less the second time.
double Session::build(const Function& function, Math math, Real real,
                      const runtime::ProgramOptions& options) {
    const std::size_t items = column_bytes / size_of(real) / 64;
    const auto start = Clock::now();
    evaluators_.push_back(
        std::make_unique<DeviceEvaluator>(runtime::Program(arithmetic_, math, real, options)));
    const cl::Kernel kernel = stream_kernel(function, *evaluators_.back());
    launch(kernel, items);
    return seconds_since(start) - launch(kernel, items).wall_s;
}

Entry Session::stream_entry(const Function& function, DeviceEvaluator& evaluator) {
    std::size_t items = column_bytes / size_of(evaluator.input_real());
    const cl::Kernel kernel = stream_kernel(function, evaluator);
    launch(kernel, items);
    if (launch(kernel, items).wall_s > slow_launch_s) items /= 4;
    Entry entry;
    entry.samples = static_cast<double>(items);
    entry.launch = [this, kernel, items] { return launch(kernel, items); };
    entry.warm = [this, kernel, items] { launch(kernel, items / warm_part); };
    return entry;
}

// As many items, doubled from `items`, as make one launch long beside its own cost.
Entry Session::long_entry(const cl::Kernel& kernel, std::size_t items, std::size_t most) {
    launch(kernel, items);
    while (launch(kernel, items).wall_s < compute_launch_s && items < most) items *= 2;
    Entry entry;
    entry.samples = static_cast<double>(items);
    entry.launch = [this, kernel, items] { return launch(kernel, items); };
    entry.warm = entry.launch;
    return entry;
}

Entry Session::compute_entry(const Function& function, DeviceEvaluator& evaluator) {
    const Real real = evaluator.input_real();
    const conformance::Point point = lobe(in_world_space(function));
    cl::Kernel kernel = evaluator.program().kernel("vndf_compute");
    cl_uint argument = 0;
    for (std::size_t i = 0; i < function.inputs.size(); ++i, ++argument) {
        const double value = point.scalar(function.inputs[i]);
        if (!is_lobe(function.inputs[i]))
            kernel.setArg(argument, input(function, i, real));
        else if (real == Real::f32)
            kernel.setArg(argument, static_cast<float>(value));
        else
            kernel.setArg(argument, value);
    }
    for (std::size_t i = 0; i < function.outputs.size(); ++i) kernel.setArg(argument++, output(i));

    return long_entry(kernel, compute_groups * runtime::group_size, most_items);
}

const Entry* Session::find_entry(const std::string& name) const {
    const auto found = std::find_if(entries_.begin(), entries_.end(),
                                    [&](const Entry& entry) { return entry.name == name; });
    return found == entries_.end() ? nullptr : &*found;
}

// The fastest of the copies for so many arrays; registers it once.
std::string Session::copy_entry(std::size_t reads, std::size_t writes, Real real) {
    const std::size_t bytes = (reads + writes) * size_of(real);
    const std::string name = fmt::format("copy_{}B{}{}/stream", bytes, writes == 1 ? "_value" : "",
                                         real == Real::f64 ? "_double" : "");
    if (find_entry(name)) return name;
    const std::size_t items = column_bytes / size_of(real);
    Entry fastest;
    double best_s = INFINITY;
    for (const Copy copy : copies) {
        cl::Kernel kernel = runtime::Program(arithmetic_, Math::strict, real,
                                             own_program(copy_source(copy, reads, writes, real)))
                                .kernel("vndf_copy");
        cl_uint argument = 0;
        for (std::size_t i = 0; i < reads; ++i) {
            const std::string key = fmt::format("copy {}", i);
            if (!inputs_.contains(key)) {
                inputs_[key] = arithmetic_.buffer(column_bytes);
                arithmetic_.queue().enqueueFillBuffer(inputs_[key], 0.5f, 0, column_bytes);
            }
            kernel.setArg(argument++, inputs_[key]);
        }
        for (std::size_t i = 0; i < writes; ++i) kernel.setArg(argument++, output(i));
        const std::size_t work_items = items / items_per_work_item(copy, real);
        kernel.setArg(argument, static_cast<cl_uint>(work_items));
        double fastest_s = INFINITY;
        for (int i = 0; i < 4; ++i) fastest_s = std::min(fastest_s, launch(kernel, work_items).wall_s);
        if (fastest_s >= best_s) continue;
        best_s = fastest_s;
        fastest.launch = [this, kernel, work_items] { return launch(kernel, work_items); };
        fastest.warm = [this, kernel, work_items] { launch(kernel, work_items / warm_part); };
        fastest.label = fmt::format("{} copy, {} arrays to {}", to_string(copy), reads, writes);
    }
    fastest.name = name;
    fastest.samples = static_cast<double>(items);
    entries_.push_back(fastest);
    return name;
}

// The device's arithmetic rate: its samples are operations. Registers it once.
std::string Session::arithmetic_entry() {
    const std::string name = "fma/compute";
    if (find_entry(name)) return name;
    cl::Kernel kernel = arithmetic_.kernel("vndf_arithmetic");
    kernel.setArg(0, output(0));
    kernel.setArg(1, 0.5f);
    Entry entry = long_entry(kernel, runtime::group_size * arithmetic_.device().compute_units,
                             column_bytes / sizeof(float));
    entry.samples *= arithmetic_operations;
    entry.name = name;
    entry.label = "a sample is one operation; an fma is two";
    entries_.push_back(std::move(entry));
    return name;
}

// Errors on the very inputs that are timed.
void Session::add_accuracy(Entry& entry, const Function& function, runtime::Evaluator& evaluator) {
    const conformance::Table& inputs = table(function, evaluator.input_real());
    conformance::Table judged;
    for (const std::vector<double>& column : inputs.columns)
        judged.columns.emplace_back(column.begin(), column.begin() + judged_rows);
    const conformance::Errors errors = conformance::pointwise_errors(evaluator, function, judged);
    entry.figures["err_p50"] = errors.percentile(50);
    entry.figures["err_p99"] = errors.percentile(99);
    entry.figures["err_max"] = errors.max();
    // An approximate sampler is judged against its own map above: here its distribution against the exact one.
    for (const conformance::Finding& finding : conformance::measure_bias(evaluator, function))
        if (finding.check.find("CDF error") != std::string::npos)
            entry.figures["bias"] = std::max(entry.figures["bias"], finding.figure);
}

// The part of a sampler's directions that are reflections above the surface.
double Session::useful_part(const Function& function, runtime::Evaluator& evaluator) {
    if (function.kind != Kind::sampler) return 1;
    const auto results = conformance::evaluate(evaluator, function, table(function, evaluator.input_real()));
    const std::vector<conformance::Point> all = points(distinct_rows, in_world_space(function));
    const auto dot = [](const conformance::Direction& a, const conformance::Direction& b) {
        return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    };
    std::size_t useful = 0;
    for (std::size_t i = 0; i < all.size(); ++i) {
        const conformance::Direction d{results[0][i], results[1][i], results[2][i]};
        const double cosine = dot(all[i].wo, d), height = dot(d, all[i].n);
        useful += function.result == "WI" ? height > 0
                                          : cosine > 0 && 2 * cosine * height > dot(all[i].wo, all[i].n);
    }
    return static_cast<double>(useful) / static_cast<double>(all.size());
}

void Session::add_program(const Function& function, Math math, Real real, const Form& form) {
    arithmetic_.guarded("measure " + function.name, [&] {
        const std::string copy = copy_entry(function.inputs.size(), function.outputs.size(), real);
        runtime::ProgramOptions options;
        options.functions = {function.name};
        options.root = form.root;
        options.more_source = compute_source(function, form.callee);
        options.more_files = sources();
        options.substitutions = form.substitutions;
        options.mutant = form.substitutions.empty() ? 0 : 1;
        for (std::size_t i = 0; i < function.inputs.size(); ++i) input(function, i, real);
        const double cold_s = build(function, math, real, options);
        const double warm_s = build(function, math, real, options);  // from the driver's cache
        DeviceEvaluator& evaluator = *evaluators_.back();
        if (build_options_.empty()) build_options_ = evaluator.program().build_options();
        Entry stream = stream_entry(function, evaluator);
        Entry compute = compute_entry(function, evaluator);
        if (form.same_map) add_accuracy(stream, function, evaluator);
        stream.useful = useful_part(function, evaluator);
        stream.figures["build_cold_s"] = cold_s;
        stream.figures["build_warm_s"] = warm_s;
        compute.figures = stream.figures;
        compute.useful = stream.useful;
        const std::string name = fmt::format("{}/{}/{}", function.name, form.policy, to_string(real));
        stream.name = name + "/stream";
        stream.copy = copy;
        compute.name = name + "/compute";
        if (form.policy == "strict" && real == Real::f32 && operations(function) > 0) {
            stream.figures["operations"] = operations(function);
            stream.arithmetic = arithmetic_entry();
        }
        if (is_published(function) && real == Real::f32) {
            stream.published = function.name + "/published/float/stream";
            compute.published = function.name + "/published/float/compute";
        }
        entries_.push_back(std::move(stream));
        entries_.push_back(std::move(compute));
    });
}

void Session::add(const Function& function, Math math, Real real) {
    add_program(function, math, real,
                {std::string(to_string(math)), "kernels/batch/batch.cl", function.name});
}

void Session::add_steps(const Function& function) {
    if (!has_steps(function)) return;
    // Every form but the last keeps the last step, which alone is taken with the accurate residual.
    const std::string file = "kernels/vndf/impl/beckmann_slopes.h",
                      first = "VNDF_REAL offset = VNDF_IMPL_STEP(start, 0)",
                      second = "offset = VNDF_IMPL_STEP(offset, 0)",
                      last = "return VNDF_IMPL_STEP(offset, 1)", none = "VNDF_REAL offset = start";
    const std::vector<std::vector<runtime::Substitution>> forms = {
        {{file, first, none, 1}, {file, second, "", 1}, {file, last, "return offset", 1}},
        {{file, first, none, 1}, {file, second, "", 1}},
        {{file, first, none, 1}},
        {{file, second, second, 1}},
        {{file, second, second + "; " + second, 1}}};
    for (std::size_t steps = 0; steps < forms.size(); ++steps)
        add_program(function, Math::strict, Real::f32,
                    {fmt::format("steps{}", steps), "kernels/batch/batch.cl", function.name, forms[steps]});
}

void Session::add_published(const Function& function) {
    if (!is_published(function)) return;
    add_program(function, Math::builtin, Real::f32,
                {"published", "bench/published/batch.cl", "published_" + function.name.substr(5)});
}

void Session::add_basis(const Function& function) {
    if (!has_basis(function)) return;
    // Its azimuths are those of the basis: the distribution is the same, the map is another.
    const std::string root = "bench/cap_with_basis.cl";
    add_program(function, Math::strict, Real::f32, {"basis", root, "vndf_bench_cap_with_basis", {}, false});
    add_program(function, Math::builtin, Real::f32,
                {"published_basis", root, "published_cap_with_basis", {}, false});
}

void Session::add_cpp(const Function& function) {
    const runtime::HostFunction callee = find_cpp_function(function.name.c_str());
    const conformance::Point point = lobe(in_world_space(function));
    for (const bool compute : {false, true}) {
        // Compute-bound: one lobe and few rows, gone over again and again.
        const std::size_t rows = compute ? cpp_rows : column_bytes / sizeof(float) / 4;
        const unsigned threads = std::max(1u, std::thread::hardware_concurrency());
        const std::size_t passes = compute ? 2048 : 1;
        using Array = std::vector<float>;
        const auto arrays = std::make_shared<std::vector<Array>>();
        for (std::size_t i = 0; i < function.inputs.size() + function.outputs.size(); ++i) {
            Array& array = arrays->emplace_back(rows * (compute ? threads : 1));
            if (i >= function.inputs.size()) continue;
            const std::vector<double>& values = table(function, Real::f32).columns[i];
            const bool lobe_value = compute && is_lobe(function.inputs[i]);
            for (std::size_t row = 0; row < array.size(); ++row)
                array[row] = static_cast<float>(lobe_value ? point.scalar(function.inputs[i])
                                                           : values[row % values.size()]);
        }
        const auto work = [=, inputs = function.inputs.size()](unsigned thread) {
            const std::size_t part = compute ? rows : rows / threads, first = part * thread;
            std::vector<const void*> in;
            std::vector<void*> out;
            for (std::size_t i = 0; i < arrays->size(); ++i)
                i < inputs ? in.push_back((*arrays)[i].data() + first)
                           : out.push_back((*arrays)[i].data() + first);
            for (std::size_t pass = 0; pass < passes; ++pass) callee(in.data(), out.data(), part);
        };
        Entry entry;
        entry.name = fmt::format("{}/cpp/float/{}", function.name, compute ? "compute" : "stream");
        entry.samples = static_cast<double>(rows * (compute ? threads * passes : 1));
        entry.label = fmt::format("{} threads", threads);
        entry.warm = [] {};
        entry.launch = [=] {
            const auto start = Clock::now();
            std::vector<std::jthread> workers;
            for (unsigned thread = 0; thread < threads; ++thread) workers.emplace_back(work, thread);
            workers.clear();
            return Timing{seconds_since(start), 0};
        };
        if (const Entry* strict = find_entry(function.name + "/strict/float/stream")) {
            entry.useful = strict->useful;
            entry.figures = strict->figures;  // the same bits
            entry.figures.erase("build_cold_s");
            entry.figures.erase("build_warm_s");
            if (!compute) entry.copy = strict->copy;
        }
        if (is_published(function))
            entry.published =
                fmt::format("{}/published/float/{}", function.name, compute ? "compute" : "stream");
        entries_.push_back(std::move(entry));
    }
}

}  // namespace vndf::bench
