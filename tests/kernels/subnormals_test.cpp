// Nothing on the way to an ordinary result is subnormal: such a number costs a hundred times an operation on most
// processors. An unoptimised build of the headers (support/unoptimised_build.cpp) executes what the source says, and the
// processor's flags tell of operands and results. conic2026 may meet one in 5000 calls.
#if defined(__SSE2__)
#include <xmmintrin.h>

#include <cmath>
#include <limits>
#include <random>

#include "conformance/judge/errors.h"
#include "registry.h"
#include "runtime/host_build.h"
#include "support/catch.h"

namespace vndf::runtime {
HostFunction find_unoptimised_function_float(const char* name);
HostFunction find_unoptimised_function_double(const char* name);
}  // namespace vndf::runtime

using namespace vndf;

namespace {

// Whether one call meets a subnormal operand or makes a result below the normal range.
template <class T>
bool meets_subnormal(runtime::HostFunction function, const std::vector<double>& row) {
    constexpr unsigned denormal_operand = 2, underflow = 16;
    T in[32], out[4];
    const void* inputs[32];
    void* outputs[4];
    for (std::size_t i = 0; i < row.size(); ++i) in[i] = static_cast<T>(row[i]), inputs[i] = &in[i];
    for (std::size_t i = 0; i < 4; ++i) outputs[i] = &out[i];
    _mm_setcsr(_mm_getcsr() & ~(denormal_operand | underflow));
    function(inputs, outputs, 1);
    return _mm_getcsr() & (denormal_operand | underflow);
}

// Arguments as a renderer has them: any direction, normals above the surface, alpha from 1e-3 to 10, u of 24 bits.
class Ordinary {
  public:
    std::vector<double> row(const Function& function) {
        std::vector<double> values;
        for (const std::string& name : function.inputs) {
            const bool first_of_vector = name.size() > 2 && name.substr(name.size() - 2) == "_x";
            if (name.rfind("alpha", 0) == 0)
                values.push_back(std::exp(uniform(std::log(1e-3), std::log(10.))));
            else if (name == "u1" || name == "u2")
                values.push_back(std::floor(uniform(0, 0x1p24)) * 0x1p-24);
            else if (name == "one_minus_cos")
                values.push_back(std::exp(uniform(std::log(1e-6), std::log(2.))));
            else if (name == "eta")
                values.push_back(uniform(.4, 2.5));
            else if (name == "k")
                values.push_back(uniform(0, 8));
            else if (name == "distance" || name == "sigma")
                values.push_back(uniform(0, 8));
            else if (name == "dispersion")
                values.push_back(uniform(0, 1));
            else if (name == "wavelength")
                values.push_back(uniform(380, 780));
            else if (name == "f0" || name == "f90" || name == "tint")
                values.push_back(uniform(0, 1));
            else if (name.rfind("cos_theta", 0) == 0 || name == "wo_dot_wm")
                values.push_back(uniform(-1, 1));
            else if (name == "x" || name.rfind("slope_", 0) == 0)
                values.push_back(normal_(engine_));
            else if (first_of_vector)
                add_direction(values, name == "wm_x");
        }
        return values;
    }

  private:
    double uniform(double low, double high) {
        return std::uniform_real_distribution<double>(low, high)(engine_);
    }
    // Of every sixteen one is the macroscopic normal, and one grazes.
    void add_direction(std::vector<double>& values, bool upper) {
        double x = normal_(engine_), y = normal_(engine_), z = normal_(engine_);
        const auto kind = engine_() % 16;
        if (kind == 0) x = y = 0, z = 1;
        if (kind == 1) z *= 1e-3;
        if (upper) z = std::abs(z);
        const double length = std::hypot(x, y, z);
        values.insert(values.end(), {x / length, y / length, z / length});
    }
    std::mt19937 engine_{1};
    std::normal_distribution<double> normal_;
};

template <class T>
void check_functions(runtime::HostFunction (*find)(const char*)) {
    for (const Function& function : functions()) {
        REQUIRE(Ordinary().row(function).size() == function.inputs.size());
        Ordinary ordinary;
        std::size_t bad = 0;
        for (int i = 0; i < 20000; ++i) {
            const std::vector<double> row = ordinary.row(function);
            if (meets_subnormal<T>(find(function.name.c_str()), row) && bad++ == 0)
                UNSCOPED_INFO(function.name << " at " << conformance::hex_row(function, row));
        }
        // Where a lobe is a thousand times as narrow one way as the other, some terms of the cone are next to nothing. Of two
        // corners of a polygon that are one, and of edges that the horizon leaves nothing of, the arc is nothing.
        const auto is = [&](const char* part) { return function.name.find(part) != std::string::npos; };
        const bool polygon = is("triangle_mass") || is("quad_mass"),
                   cone = is("conic2026") || is("tilted2026");
        CHECK(bad <= (polygon ? 400 : cone ? 4 : 0));
    }
}

}  // namespace

TEST_CASE("no number on the way to an ordinary result is subnormal") {
    check_functions<float>(runtime::find_unoptimised_function_float);
    check_functions<double>(runtime::find_unoptimised_function_double);
}

TEST_CASE("of arguments that are not ordinary the test of subnormal numbers sees operands and results") {
    const auto meets = [](const std::vector<double>& row) {
        return meets_subnormal<float>(runtime::find_unoptimised_function_float("vndf_reflect"), row);
    };
    CHECK(meets({1e-40, 0, 1, 0, 0, 1}));
    CHECK(meets({1e-25, 0, 1, 1e-25, 0, 1}));
    CHECK_FALSE(meets({0, 0, 1, 0, 0, 1}));
}
#endif
