// Somebody else's OpenCL function in place of a registered one: its file, what it is judged as, and a program in which it has
// the entry point that a function of the registry has. Whatever takes a Function and an Evaluator takes it as it takes ours.
#pragma once

#include <deque>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "conformance/inputs/grids.h"
#include "registry.h"
#include "runtime/device_evaluator.h"

namespace vndf::conformance {

struct UserOptions {
    std::string file;      // of OpenCL C
    std::string function;  // its name there; of a BSDF the value
    std::string
        as;  // "ggx_sample_wm", a registered name with or without vndf_, "bsdf", or one of bsdf_parts()
    std::string pdf;      // of a sampler and of a BSDF, the name of its density; or empty
    std::string sample;   // of a BSDF, the name of its sampler; or empty
    std::string options;  // for the compiler
    Scope scope;
};

class UserKernel {
  public:
    // Reads the file and what it includes. Throws InputError for what cannot be read or judged.
    explicit UserKernel(UserOptions options);
    UserKernel(const UserKernel&) = delete;  // functions() and program() point into it

    const UserOptions& options() const { return options_; }
    bool is_bsdf() const { return options_.as == "bsdf"; }

    // The user's functions as the registry would describe them, each once: the one to judge first, then its density (and of a
    // BSDF its sampler). `name` is the user's, `model` the registered function that it is compared with.
    const std::deque<Function>& functions() const { return functions_; }
    const Function& function() const { return functions_.front(); }
    const Function* pdf() const;     // nullptr if there is none
    const Function* sample() const;  // of a BSDF

    // The registered function to time or show beside it; nullptr for a BSDF and its parts.
    const Function* ours() const { return ours_; }

    // A program with an entry point vndf_batch_NAME for each of functions(), after the text of the user. Built with the user's
    // options, not with ours: division is not made to round correctly.
    runtime::ProgramOptions program(runtime::Real real = runtime::Real::f32) const;

    // Builds it. Throws Error with exit status 2 and the compiler's words, at the lines of the user's files, if these do not
    // compile; InputError if they have no such function, or with other arguments.
    runtime::DeviceEvaluator evaluator(const runtime::Device& device,
                                       runtime::Real real = runtime::Real::f32) const;

    // The same with every float of the user's text a double, which tells rounding from mistakes; nothing if the device or the
    // compiler will not have it.
    std::optional<runtime::DeviceEvaluator> in_double(const runtime::Device& device) const;

  private:
    struct File {
        std::string path, text;
    };
    void describe();
    void load(const std::string& path, int depth);
    runtime::ProgramOptions program_of(const std::deque<File>& files, runtime::Real real) const;

    UserOptions options_;
    std::deque<Function> functions_;
    const Function* ours_ = nullptr;
    std::deque<File> files_;
};

// What --as may be beside names of the registry.
const std::vector<std::string>& general_names();

// A function of a BSDF by itself, which can be evaluated, not judged: bsdf_value, bsdf_pdf, bsdf_sample.
const std::vector<std::string>& bsdf_parts();

}  // namespace vndf::conformance
