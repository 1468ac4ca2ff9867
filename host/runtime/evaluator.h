// Anything that evaluates registered functions on arrays: a device, the host build of the same headers, or
// the reference.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "registry.h"

namespace vndf::runtime {

enum class Math { strict, builtin, native };
enum class Real { f32, f64 };

inline constexpr std::string_view to_string(Math math) {
    return math == Math::strict ? "strict" : math == Math::builtin ? "builtin" : "native";
}
inline constexpr std::string_view to_string(Real real) {
    return real == Real::f32 ? "float" : "double";
}
inline constexpr std::size_t size_of(Real real) {
    return real == Real::f32 ? sizeof(float) : sizeof(double);
}

class Evaluator {
  public:
    virtual ~Evaluator() = default;

    // Evaluates `function` on n rows. inputs: one array for each scalar of function.inputs, of input_real();
    // outputs: one array for each scalar of function.outputs, of output_real().
    virtual void run(const Function& function, std::size_t n, const std::vector<const void*>& inputs,
                     const std::vector<void*>& outputs) = 0;

    virtual Real input_real() const = 0;
    virtual Real output_real() const = 0;

    // "Portable Computing Language / cpu-haswell, strict float", for reports.
    virtual std::string describe() const = 0;
};

// Throws InputError for Math::native, which exists on devices only.
void require_host_policy(Math math);

// Throws InputError for Math::native in double, which no device has.
void require_policy(Math math, Real real);

// kernels/vndf compiled as C++, Math::strict or Math::builtin.
class HostEvaluator final : public Evaluator {
  public:
    HostEvaluator(Math math, Real real) : math_(math), real_(real) { require_host_policy(math); }
    void run(const Function& function, std::size_t n, const std::vector<const void*>& inputs,
             const std::vector<void*>& outputs) override;
    Real input_real() const override { return real_; }
    Real output_real() const override { return real_; }
    std::string describe() const override;

  private:
    Math math_;
    Real real_;
};

// The reference in double, fed with numbers of `real` and with the clamps of that type; results are doubles.
class ReferenceEvaluator final : public Evaluator {
  public:
    explicit ReferenceEvaluator(Real real) : real_(real) {}
    void run(const Function& function, std::size_t n, const std::vector<const void*>& inputs,
             const std::vector<void*>& outputs) override;
    Real input_real() const override { return real_; }
    Real output_real() const override { return Real::f64; }
    std::string describe() const override;

  private:
    Real real_;
};

}  // namespace vndf::runtime
