// What is to be measured: forms of functions, copies and the C++ build, ready to launch on one device.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "inputs.h"
#include "kernels.h"
#include "rungs.h"
#include "runtime/device_evaluator.h"

namespace vndf::bench {

struct Timing {
    double wall_s;   // from the launch to the end of the wait for it
    double event_s;  // as the driver says; 0 if it says nothing
};

// One line of the benchmark: FUNCTION/RUNG/REAL/MODE, copy_40B/stream or fma/compute.
struct Entry {
    std::string name;
    double samples = 0;  // of one launch
    std::function<Timing()> launch;
    std::function<void()> warm;             // before it, untimed
    std::map<std::string, double> figures;  // counters that do not depend on time: err_p50, ...
    double useful = 1;                      // the part of the samples that are not rejected
    // Names of the entries to compare with; empty: none.
    std::string copy, published, lean;
    std::string arithmetic;  // the one whose samples are operations
    std::string label;
};

struct SessionOptions {
    std::size_t judged_rows = std::size_t{1} << 16;  // of plain samplers; others a quarter of them
    AlphaRange alpha = {};
    bool warm_builds = true;  // every program a second time, from the driver's cache
};

class Session {
  public:
    Session(const runtime::Device& device, const SessionOptions& options);

    // Its entries, one for each mode of the rung, with what they are compared with.
    void add(const Function& function, const Rung& rung);

    const std::vector<Entry>& entries() const { return entries_; }
    // The build options of what was built first: policy and type apart, they are the same for all.
    const std::string& build_options() const { return build_options_; }
    // In whose context everything is built.
    const runtime::Program& program() const { return arithmetic_; }

  private:
    using Arrays = std::vector<std::vector<float>>;

    void add_device(const Function& function, const Rung& rung);
    void add_cpp(const Function& function, const Rung& rung);
    Entry cpp_entry(const Function& function, bool compute);
    double build(const Function& function, const Rung& rung, const runtime::ProgramOptions& options);
    std::size_t judged_rows(const Function& function) const;
    void require_same_results(const Function& function, const Rung& rung);

    Entry entry(const Function& function, const Rung& rung, Mode mode);
    Entry stream_entry(const cl::Kernel& kernel, runtime::Real real);
    Entry long_entry(const cl::Kernel& kernel, std::size_t items, std::size_t most);
    cl::Kernel stream_kernel(const Function& function, runtime::DeviceEvaluator& evaluator);
    cl::Kernel compute_kernel(const Function& function);
    cl::Kernel cached_kernel(const Function& function, Side side);
    cl::Kernel layout_kernel(const Function& function, const Rung& rung, bool cached);
    std::string copy_entry(std::size_t reads, std::size_t writes, runtime::Real real);
    std::string arithmetic_entry();
    const Entry* find_entry(const std::string& name) const;

    const conformance::Table& table(const Function& function, runtime::Real real, Side side = Side::front);
    cl::Buffer& input(const Function& function, std::size_t index, runtime::Real real);
    cl::Buffer& cached_input(const Function& function, std::size_t index, runtime::Real real, Side side);
    cl::Buffer& interleaved(const std::string& key, const std::vector<std::vector<double>>& columns,
                            std::size_t width, std::size_t bytes);
    cl::Buffer& repeated(const std::string& key, std::size_t size,
                         const std::function<std::vector<char>()>& make);
    cl::Buffer& output(std::size_t index);
    std::shared_ptr<std::vector<float>> cpp_array(const Function& function, std::size_t scalar, bool compute);
    Timing launch(const cl::Kernel& kernel, std::size_t items);

    SessionOptions options_;
    runtime::Program arithmetic_;  // measures the device's rate; the others are built in its context
    std::map<std::string, cl::Buffer> inputs_;
    std::map<std::string, conformance::Table> tables_;
    std::map<std::string, std::shared_ptr<std::vector<float>>> cpp_arrays_;
    std::vector<cl::Buffer> outputs_;
    std::vector<std::unique_ptr<runtime::DeviceEvaluator>> evaluators_;  // keep their programs
    std::vector<Entry> entries_;
    std::string build_options_;
};

}  // namespace vndf::bench
