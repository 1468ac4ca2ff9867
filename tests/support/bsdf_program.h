// A material of kernels/vndf/bsdf.h on the default device, with switches: tables in, tables out.
#pragma once

#include <cstdlib>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "effects.h"
#include "runtime/program.h"

namespace vndf {

// How many inputs the tests that are run by hand take: the environment's CLVNDF_ITEMS, or as many as are claimed.
inline std::size_t items_by_hand() {
    const char* text = std::getenv("CLVNDF_ITEMS");
    return text ? std::strtoul(text, nullptr, 10) : std::size_t{1} << 20;
}

using Columns = std::vector<std::vector<double>>;

inline const std::vector<std::string>& bsdf_parameters = material_parameters();

class BsdfProgram {
  public:
    // switches: "NDF=beckmann LAMBERT=0".
    explicit BsdfProgram(const std::string& switches, const std::vector<runtime::Substitution>& mutants = {},
                         int mutant = 0, runtime::Real real = runtime::Real::f32,
                         const std::string& root = "kernels/batch/bsdf.cl")
        : program_(runtime::choose_device().device, runtime::Math::strict, real,
                   options(root, switches, mutants, mutant)) {}
    runtime::Real real() const { return program_.real(); }

    // wo, wi, the material -> f (3), pdf
    Columns eval_pdf(const Columns& in) const { return run("vndf_batch_bsdf_eval_pdf", in, 4); }
    // wo, u1, u2, u_lobe, the material -> wi (3), weight (3), pdf, lobe
    Columns sample(const Columns& in) const { return run("vndf_batch_bsdf_sample", in, 8); }

    // distance, the material -> what is left of each channel
    Columns transmittance(const Columns& in) const { return run("vndf_batch_bsdf_transmittance", in, 3); }

    // Any entry point of the root: one work-item for each row.
    Columns run(const char* name, const Columns& in, std::size_t outputs) const {
        return real() == runtime::Real::f32 ? run_as<float>(name, in, outputs)
                                            : run_as<double>(name, in, outputs);
    }

  private:
    static runtime::ProgramOptions options(const std::string& root, const std::string& switches,
                                           const std::vector<runtime::Substitution>& mutants, int mutant) {
        runtime::ProgramOptions options;
        options.root = root;
        std::string word;
        for (const char c : switches + ' ') {
            if (c != ' ') {
                word += c;
            } else if (!word.empty()) {
                options.build_options += " -DVNDF_" + word;
                word.clear();
            }
        }
        options.substitutions = mutants;
        options.mutant = mutant;
        return options;
    }

    template <class T>
    Columns run_as(const char* name, const Columns& in, std::size_t outputs) const {
        const std::size_t items = in.front().size(), bytes = runtime::whole_groups(items) * sizeof(T);
        Columns out;
        program_.guarded(fmt::format("run {}", name), [&] {
            cl::Kernel kernel = program_.kernel(name);
            std::vector<cl::Buffer> buffers;
            for (std::size_t i = 0; i < in.size() + outputs; ++i) {
                cl::Buffer& buffer = buffers.emplace_back(program_.buffer(bytes));
                if (i < in.size()) {
                    std::vector<T> column(in[i].begin(), in[i].end());
                    column.resize(runtime::whole_groups(items), column.front());
                    program_.queue().enqueueWriteBuffer(buffer, CL_TRUE, 0, bytes, column.data());
                }
                kernel.setArg(static_cast<cl_uint>(i), buffer);
            }
            program_.launch(kernel, items);
            std::vector<T> column(items);
            for (std::size_t i = 0; i < outputs; ++i) {
                program_.queue().enqueueReadBuffer(buffers[in.size() + i], CL_TRUE, 0, items * sizeof(T),
                                                   column.data());
                out.emplace_back(column.begin(), column.end());
            }
        });
        return out;
    }

    runtime::Program program_;
};

}  // namespace vndf
