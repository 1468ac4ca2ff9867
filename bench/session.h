// What is to be measured: functions, published listings, copies and the C++ build, ready to launch on one device.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "conformance/inputs/points.h"
#include "kernels.h"
#include "runtime/device_evaluator.h"

namespace vndf::bench {

struct Timing {
    double wall_s;   // from the launch to the end of the wait for it
    double event_s;  // as the driver says; 0 if it says nothing
};

// One line of the benchmark: FUNCTION/POLICY/REAL/stream, .../compute, copy_40B/stream or fma/compute.
struct Entry {
    std::string name;
    double samples = 0;  // of one launch
    std::function<Timing()> launch;
    std::function<void()> warm;             // before it, untimed
    std::map<std::string, double> figures;  // counters that do not depend on time: err_p50, ...
    double useful = 1;                      // the part of the samples that are not rejected
    std::string copy, published;            // names of the entries to compare with; empty: none
    std::string arithmetic;                 // name of the entry whose samples are operations; empty: none
    std::string label;
};

class Session {
  public:
    explicit Session(const runtime::Device& device);

    void add(const Function& function, runtime::Math math, runtime::Real real);
    // The function with other numbers of iterations, as policies steps1, steps2 ..., if it has a fixed number of them.
    void add_steps(const Function& function);
    // The listing of the function's paper, if it is one of those at hand.
    void add_published(const Function& function);
    // What the isotropic sampler competes with: a basis about n, the cap in it and back; ours and the listing.
    void add_basis(const Function& function);
    // The same header as C++, on every thread of the host.
    void add_cpp(const Function& function);

    std::vector<Entry>& entries() { return entries_; }
    // The build options of what was built first: policy and type apart, they are the same for all.
    const std::string& build_options() const { return build_options_; }

  private:
    // How a function is computed: the source that has its entry point, and the OpenCL C function behind it.
    struct Form {
        std::string policy, root, callee;
        std::vector<runtime::Substitution> substitutions = {};
        bool same_map = true;  // whether the function's reference is its own
    };
    void add_program(const Function& function, runtime::Math math, runtime::Real real, const Form& form);
    cl::Kernel stream_kernel(const Function& function, runtime::DeviceEvaluator& evaluator);
    double build(const Function& function, runtime::Math math, runtime::Real real,
                 const runtime::ProgramOptions& options);
    Entry stream_entry(const Function& function, runtime::DeviceEvaluator& evaluator);
    Entry compute_entry(const Function& function, runtime::DeviceEvaluator& evaluator);
    std::string copy_entry(std::size_t reads, std::size_t writes, runtime::Real real);
    std::string arithmetic_entry();
    Entry long_entry(const cl::Kernel& kernel, std::size_t items, std::size_t most);
    const Entry* find_entry(const std::string& name) const;
    void add_accuracy(Entry& entry, const Function& function, runtime::Evaluator& evaluator);
    double useful_part(const Function& function, runtime::Evaluator& evaluator);

    const conformance::Table& table(const Function& function, runtime::Real real);
    cl::Buffer& input(const Function& function, std::size_t index, runtime::Real real);
    cl::Buffer& output(std::size_t index);
    Timing launch(const cl::Kernel& kernel, std::size_t items);

    runtime::Program arithmetic_;  // measures the device's rate; the others are built in its context
    std::map<std::string, cl::Buffer> inputs_;
    std::map<std::string, conformance::Table> tables_;
    std::vector<cl::Buffer> outputs_;
    std::vector<std::unique_ptr<runtime::DeviceEvaluator>> evaluators_;  // keep their programs
    std::vector<Entry> entries_;
    std::string build_options_;
};

// Whether the listing of this function's paper is among those ported.
bool is_published(const Function& function);
// Whether add_steps and add_basis have something to add.
bool has_steps(const Function& function);
bool has_basis(const Function& function);

}  // namespace vndf::bench
