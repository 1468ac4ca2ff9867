#include "session.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <thread>

#include <fmt/format.h>

#include "accuracy.h"
#include "conformance/judge/errors.h"
#include "cpp_build.h"
#include "error.h"
#include "sources.h"

namespace vndf::bench {
namespace {

using runtime::DeviceEvaluator, runtime::Math, runtime::Real;
using Clock = std::chrono::steady_clock;

constexpr std::size_t column_bytes = std::size_t{1} << 23;  // 80 MB with 10 columns: beyond the caches
constexpr std::size_t distinct_rows = std::size_t{1} << 16;
constexpr std::size_t warm_part = 16;       // of the data, to load code, not the data into a cache
constexpr double slow_launch_s = 0.03;      // longer launches are cut to a quarter of the samples
constexpr double compute_launch_s = 0.004;  // long beside the cost of a launch
constexpr std::size_t most_items = std::size_t{1} << 28;
constexpr std::size_t cpp_rows = 512;  // of the C++ build when compute-bound: they fit the first cache
constexpr std::size_t cpp_columns = column_bytes / sizeof(float) / 4;  // streaming

double seconds_since(Clock::time_point start) {
    return std::chrono::duration<double>(Clock::now() - start).count();
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

runtime::ProgramOptions program_options(const Function& function, const Rung& rung) {
    runtime::ProgramOptions options;
    if (rung.program) {
        options = *rung.program;
        options.more_source += foreign_source(function, rung.real);
        return options;
    }
    options.functions = {function.name};
    options.root = rung.root;
    options.more_files = sources();
    options.build_options = rung.flags;
    options.correct_divide_sqrt = rung.flags.empty();
    if (rung.layout.empty()) options.more_source = cached_source(function, rung.callee);
    if (rung.layout == "readme") options.root = "kernels/metal.cl";
    if (rung.root == "bench/layouts.cl")
        options.build_options +=
            fmt::format(" -DBENCH_CALLEE={} -DBENCH_GROUPS={}", rung.callee, cached_groups);
    return options;
}

}  // namespace

Session::Session(const runtime::Device& device, const SessionOptions& options)
    : options_(options), arithmetic_(device, Math::strict, Real::f32, own_program(arithmetic_source())) {}

// --- Arrays ---

const conformance::Table& Session::table(const Function& function, Real real, Side side) {
    if (!has_back(function)) side = Side::front;
    const std::string key =
        fmt::format("{} {} {}", function.name, to_string(real), side == Side::both ? "both" : "front");
    auto [found, missing] = tables_.try_emplace(key);
    if (missing)
        found->second = conformance::tabulate(
            function, points(distinct_rows, in_world_space(function), side, options_.alpha), real);
    return found->second;
}

// What `make` makes, repeated to the size; made once for each key.
cl::Buffer& Session::repeated(const std::string& key, std::size_t size,
                              const std::function<std::vector<char>()>& make) {
    const auto found = inputs_.find(key);
    if (found != inputs_.end()) return found->second;
    const std::vector<char> bytes = make();
    const cl::CommandQueue& queue = arithmetic_.queue();
    const cl::Buffer buffer = arithmetic_.buffer(size);
    queue.enqueueWriteBuffer(buffer, CL_TRUE, 0, std::min(size, bytes.size()), bytes.data());
    for (std::size_t filled = bytes.size(); filled < size; filled *= 2)
        queue.enqueueCopyBuffer(buffer, buffer, 0, filled, std::min(filled, size - filled));
    queue.finish();
    return inputs_[key] = buffer;
}

cl::Buffer& Session::input(const Function& function, std::size_t index, Real real) {
    const std::string key =
        fmt::format("{} {} {}", function.inputs[index], in_world_space(function), to_string(real));
    return repeated(key, column_bytes, [&] { return to_bytes(table(function, real).columns[index], real); });
}

cl::Buffer& Session::cached_input(const Function& function, std::size_t index, Real real, Side side) {
    if (!has_back(function)) side = Side::front;
    const std::string key =
        fmt::format("{} {} {} cached {}", function.inputs[index], in_world_space(function), to_string(real),
                    side == Side::both ? "both" : "front");
    const std::size_t rows = cached_groups * runtime::group_size;
    return repeated(key, rows * size_of(real), [&] {
        const std::vector<double>& column = table(function, real, side).columns[index];
        return to_bytes({column.begin(), column.begin() + rows}, real);
    });
}

// Floats of several columns row by row, each row `width` long.
cl::Buffer& Session::interleaved(const std::string& key, const std::vector<std::vector<double>>& columns,
                                 std::size_t width, std::size_t bytes) {
    return repeated(fmt::format("{} {} {}", key, width, bytes), bytes, [&] {
        std::vector<double> values(columns.front().size() * width);
        for (std::size_t c = 0; c < columns.size(); ++c)
            for (std::size_t i = 0; i < columns[c].size(); ++i) values[i * width + c] = columns[c][i];
        return to_bytes(values, Real::f32);
    });
}

cl::Buffer& Session::output(std::size_t index) {
    // Of arrays of structures one output has up to four columns.
    while (outputs_.size() <= index)
        outputs_.push_back(arithmetic_.buffer(column_bytes * (outputs_.empty() ? 4 : 1)));
    return outputs_[index];
}

// --- Launches ---

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

Entry Session::stream_entry(const cl::Kernel& kernel, Real real) {
    std::size_t items = column_bytes / size_of(real);
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
    // The first launches may compile and load: of three the best counts.
    const auto best_s = [&] {
        double best = INFINITY;
        for (int i = 0; i < 3; ++i) best = std::min(best, launch(kernel, items).wall_s);
        return best;
    };
    while (best_s() < compute_launch_s && items < most) items *= 2;
    Entry entry;
    entry.samples = static_cast<double>(items);
    entry.launch = [this, kernel, items] { return launch(kernel, items); };
    entry.warm = entry.launch;
    return entry;
}

// --- Kernels with their arguments ---

cl::Kernel Session::stream_kernel(const Function& function, DeviceEvaluator& evaluator) {
    cl::Kernel kernel = evaluator.program().kernel("vndf_batch_" + function.name);
    cl_uint argument = 0;
    for (std::size_t i = 0; i < function.inputs.size(); ++i)
        kernel.setArg(argument++, input(function, i, evaluator.input_real()));
    for (std::size_t i = 0; i < function.outputs.size(); ++i) kernel.setArg(argument++, output(i));
    kernel.setArg(argument, cl_uint{0});
    return kernel;
}

cl::Kernel Session::compute_kernel(const Function& function) {
    const DeviceEvaluator& evaluator = *evaluators_.back();
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
    return kernel;
}

cl::Kernel Session::cached_kernel(const Function& function, Side side) {
    const DeviceEvaluator& evaluator = *evaluators_.back();
    cl::Kernel kernel = evaluator.program().kernel("vndf_cached");
    cl_uint argument = 0;
    for (std::size_t i = 0; i < function.inputs.size(); ++i)
        kernel.setArg(argument++, cached_input(function, i, evaluator.input_real(), side));
    for (std::size_t i = 0; i < function.outputs.size(); ++i) kernel.setArg(argument++, output(i));
    return kernel;
}

// A sampler of (wo, alpha, u) over arrays of structures, or the README's example.
cl::Kernel Session::layout_kernel(const Function& function, const Rung& rung, bool cached) {
    const std::vector<std::vector<double>>& c = table(function, Real::f32, Side::front).columns;
    const std::string kind = cached ? "cached aos " : "aos ";
    const std::size_t rows = cached ? cached_groups * runtime::group_size : column_bytes / sizeof(float);
    const auto array = [&](const char* name, std::size_t first, std::size_t last, std::size_t width) {
        return interleaved(
            kind + name,
            {c.begin() + static_cast<std::ptrdiff_t>(first), c.begin() + static_cast<std::ptrdiff_t>(last)},
            width, rows * width * sizeof(float));
    };
    const bool readme = rung.layout == "readme";
    cl::Kernel kernel = evaluators_.back()->program().kernel(
        readme ? "sample_metal" : rung.layout + (cached ? "_cached" : "_stream"));
    cl_uint argument = 0;
    if (rung.layout == "aos_struct") {
        kernel.setArg(argument++, array("struct", 0, 7, 7));
    } else {
        kernel.setArg(argument++, array("wo", 0, 3, rung.layout == "aos_float4" ? 4 : 3));
        if (!readme) kernel.setArg(argument++, array("alpha", 3, 5, 2));
        kernel.setArg(argument++, array("u", 5, 7, 2));
        if (readme) {
            kernel.setArg(argument++, cl_float2{{0.3f, 0.2f}});
            kernel.setArg(argument++, 1.0f);
        }
    }
    kernel.setArg(argument++, output(0));
    if (readme)
        for (std::size_t i = 1; i < 3; ++i) kernel.setArg(argument++, output(i));
    if (rung.layout == "aos_one") kernel.setArg(argument++, 1.0f);
    if (rung.layout == "aos_stride")
        for (const cl_uint distance : {1u, 2u}) kernel.setArg(argument++, distance);
    return kernel;
}

// --- Entries ---

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

Entry Session::entry(const Function& function, const Rung& rung, Mode mode) {
    const std::size_t groups = mode == Mode::compute ? compute_groups : cached_groups;
    Entry entry;
    if (!rung.layout.empty())
        entry = mode == Mode::stream ? stream_entry(layout_kernel(function, rung, false), Real::f32)
                                     : long_entry(layout_kernel(function, rung, true),
                                                  groups * runtime::group_size, most_items);
    else if (mode == Mode::stream)
        entry = stream_entry(stream_kernel(function, *evaluators_.back()), rung.real);
    else
        entry = long_entry(mode == Mode::compute
                               ? compute_kernel(function)
                               : cached_kernel(function, mode == Mode::cached ? Side::both : Side::front),
                           groups * runtime::group_size, most_items);
    entry.name = entry_name(function, rung.key(), mode);
    if (is_published(function)) {
        entry.lean = entry_name(function, "lean/float", mode);
        if (rung.real == Real::f32) entry.published = entry_name(function, "published/float", mode);
    }
    return entry;
}

// Builds the program until its kernel has run: some drivers compile at the first launch. Returns the seconds that the
// same launch takes less the second time.
double Session::build(const Function& function, const Rung& rung, const runtime::ProgramOptions& options) {
    const std::size_t items = column_bytes / size_of(rung.real) / 64;
    const auto start = Clock::now();
    evaluators_.push_back(
        std::make_unique<DeviceEvaluator>(runtime::Program(arithmetic_, rung.math, rung.real, options)));
    const cl::Kernel kernel = rung.layout.empty() ? stream_kernel(function, *evaluators_.back())
                                                  : layout_kernel(function, rung, false);
    launch(kernel, items);
    return seconds_since(start) - launch(kernel, items).wall_s;
}

// A layout that computes something else would be worth nothing. The kernel has just run.
void Session::require_same_results(const Function& function, const Rung& rung) {
    const std::size_t rows = 4096, width = rung.layout == "aos_float4" ? 4 : 3;
    conformance::Table few;
    for (const auto& column : table(function, Real::f32).columns)
        few.columns.emplace_back(column.begin(), column.begin() + rows);
    const auto wanted = conformance::evaluate(*evaluators_.back(), function, few);
    launch(layout_kernel(function, rung, false), rows);
    std::vector<float> got(rows * width);
    arithmetic_.queue().enqueueReadBuffer(output(0), CL_TRUE, 0, got.size() * sizeof(float), got.data());
    for (std::size_t i = 0; i < rows; ++i)
        for (std::size_t k = 0; k < 3; ++k)
            if (got[i * width + k] != static_cast<float>(wanted[k][i]))
                throw DeviceError(fmt::format("{} over {}: another result than over an array for each scalar",
                                              function.name, rung.layout));
}

std::size_t Session::judged_rows(const Function& function) const {
    return is_plain_sampler(function) ? options_.judged_rows : options_.judged_rows / 4;
}

void Session::add_device(const Function& function, const Rung& rung) {
    const std::string copy = copy_entry(function.inputs.size(), function.outputs.size(), rung.real);
    const runtime::ProgramOptions options = program_options(function, rung);
    // The arrays are made before the clock starts.
    for (std::size_t i = 0; i < function.inputs.size(); ++i) input(function, i, rung.real);
    const double cold_s = build(function, rung, options);
    double warm_s = 0;
    if (options_.warm_builds) {
        evaluators_.pop_back();
        warm_s = build(function, rung, options);  // from the driver's cache
    }
    DeviceEvaluator& evaluator = *evaluators_.back();
    if (build_options_.empty()) build_options_ = evaluator.program().build_options();
    if (rung.root == "bench/layouts.cl") require_same_results(function, rung);
    Accuracy known;
    if (rung.layout != "readme")  // which has outputs of its own
        known = accuracy(evaluator, function, judged_rows(function), options_.alpha, rung.same_map);
    known.figures["build_cold_s"] = cold_s;
    if (options_.warm_builds) known.figures["build_warm_s"] = warm_s;
    for (const Mode mode : rung.modes) {
        Entry added = entry(function, rung, mode);
        added.figures = known.figures;
        added.useful = known.useful;
        if (mode == Mode::stream) {
            if (rung.layout.empty()) added.copy = copy;
            if (rung.key() == "strict/float" && operations(function) > 0) {
                added.figures["operations"] = operations(function);
                added.arithmetic = arithmetic_entry();
            }
        }
        entries_.push_back(std::move(added));
    }
}

// --- The C++ build ---

// A column of the inputs, or zeros for a result; for compute-bound measurements few rows, of one lobe, for each thread.
std::shared_ptr<std::vector<float>> Session::cpp_array(const Function& function, std::size_t scalar,
                                                       bool compute) {
    const bool is_input = scalar < function.inputs.size();
    const std::string name =
        is_input ? function.inputs[scalar] : fmt::format("out {}", scalar - function.inputs.size());
    auto& array = cpp_arrays_[fmt::format("{} {} {}", name, is_input && in_world_space(function), compute)];
    if (array) return array;
    const unsigned threads = std::max(1u, std::thread::hardware_concurrency());
    array = std::make_shared<std::vector<float>>(compute ? cpp_rows * threads : cpp_columns);
    if (!is_input) return array;
    const std::vector<double>& values = table(function, Real::f32).columns[scalar];
    const double lobe_value = lobe(in_world_space(function)).scalar(name);
    for (std::size_t row = 0; row < array->size(); ++row)
        (*array)[row] =
            static_cast<float>(compute && is_lobe(name) ? lobe_value : values[row % values.size()]);
    return array;
}

Entry Session::cpp_entry(const Function& function, bool compute) {
    const runtime::HostFunction callee = find_cpp_function(function.name.c_str());
    const unsigned threads = std::max(1u, std::thread::hardware_concurrency());
    const std::size_t rows = compute ? cpp_rows : cpp_columns, passes = compute ? 2048 : 1;
    std::vector<std::shared_ptr<std::vector<float>>> arrays;
    for (std::size_t i = 0; i < function.inputs.size() + function.outputs.size(); ++i)
        arrays.push_back(cpp_array(function, i, compute));
    const auto work = [=, inputs = function.inputs.size()](unsigned thread) {
        const std::size_t part = compute ? rows : rows / threads, first = part * thread;
        std::vector<const void*> in;
        std::vector<void*> out;
        for (std::size_t i = 0; i < arrays.size(); ++i)
            i < inputs ? in.push_back(arrays[i]->data() + first) : out.push_back(arrays[i]->data() + first);
        for (std::size_t pass = 0; pass < passes; ++pass) callee(in.data(), out.data(), part);
    };
    Entry entry;
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
    return entry;
}

void Session::add_cpp(const Function& function, const Rung& rung) {
    for (const Mode mode : rung.modes) {
        Entry entry = cpp_entry(function, mode == Mode::compute);
        entry.name = entry_name(function, rung.key(), mode);
        if (const Entry* strict = find_entry(entry_name(function, "strict/float", Mode::stream))) {
            entry.useful = strict->useful;
            entry.figures = strict->figures;  // the same bits
            for (const char* other : {"build_cold_s", "build_warm_s", "operations"})
                entry.figures.erase(other);
            if (mode == Mode::stream) entry.copy = strict->copy;
        }
        if (is_published(function)) {
            entry.published = entry_name(function, "published/float", mode);
            entry.lean = entry_name(function, "lean/float", mode);
        }
        entries_.push_back(std::move(entry));
    }
}

void Session::add(const Function& function, const Rung& rung) {
    if (!rung.on_device) return add_cpp(function, rung);
    arithmetic_.guarded("measure " + function.name, [&] { add_device(function, rung); });
}

}  // namespace vndf::bench
