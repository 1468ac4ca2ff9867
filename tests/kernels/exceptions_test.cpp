// Inside the domain no operation overflows, divides by 0 or is invalid: results do not hang on infinities and NaN that are
// repaired afterwards, which compilers may leave out that are told there are none. An unoptimised build of the headers
// (support/unoptimised_build.cpp) executes what the source says, and the processor's flags tell what happened.
#include <cfenv>
#include <cmath>
#include <limits>

#include "conformance/judge/errors.h"
#include "conformance/judge/samplers.h"
#include "runtime/host_build.h"
#include "support/catch.h"

namespace vndf::runtime {
HostFunction find_unoptimised_function_float(const char* name);
HostFunction find_unoptimised_function_double(const char* name);
}  // namespace vndf::runtime

using namespace vndf;
using namespace vndf::conformance;

namespace {

// The flags that one call raises.
template <class T>
int raised(runtime::HostFunction function, const std::vector<double>& row) {
    T in[32], out[4];
    const void* inputs[32];
    void* outputs[4];
    for (std::size_t i = 0; i < row.size(); ++i) in[i] = static_cast<T>(row[i]), inputs[i] = &in[i];
    for (std::size_t i = 0; i < 4; ++i) outputs[i] = &out[i];
    std::feclearexcept(FE_ALL_EXCEPT);
    function(inputs, outputs, 1);
    return std::fetestexcept(FE_OVERFLOW | FE_DIVBYZERO | FE_INVALID);
}

std::string describe(int flags) {
    return std::string(flags & FE_OVERFLOW ? "overflow " : "") +
           (flags & FE_DIVBYZERO ? "division by 0 " : "") + (flags & FE_INVALID ? "invalid " : "");
}

// The points of `clvndf check`; slopes are any real numbers.
Table domain(const Function& function, Real real) {
    PointwiseOptions options;
    options.random_points = 2000;
    options.hard_stride = 7;
    Table table = pointwise_table(function, real, options);
    const double largest =
        real == Real::f32 ? std::numeric_limits<float>::max() : std::numeric_limits<double>::max();
    for (std::size_t j = 0; j < table.columns.size(); ++j)
        if (const std::string& name = function.inputs[j]; name == "x" || name.rfind("slope_", 0) == 0)
            for (std::size_t i = 0; i < table.rows(); i += 3) {
                const double size = std::copysign(std::pow(largest, static_cast<double>(i % 10 + 1) / 10),
                                                  table.columns[j][i]);
                table.columns[j][i] = real == Real::f32 ? static_cast<float>(size) : size;
            }
    return table;
}

template <class T>
void check_domain(runtime::HostFunction (*find)(const char*)) {
    constexpr Real real = sizeof(T) == sizeof(float) ? Real::f32 : Real::f64;
    for (const Function& function : functions()) {
        const Table table = domain(function, real);
        std::size_t bad = 0;
        for (std::size_t i = 0; i < table.rows(); ++i) {
            const std::vector<double> row = table.row(i);
            const int flags = raised<T>(find(function.name.c_str()), row);
            if (flags != 0 && bad++ == 0)
                UNSCOPED_INFO(function.name << ", " << to_string(real) << ": " << describe(flags) << "at "
                                            << hex_row(function, row));
        }
        // Of a half-space whose rim wo lies on to within 1e-20, with alpha next to 1e-8, a cone is less than numbers get, and so are
        // the areas of its arcs; in float.
        const auto is = [&](const char* part) { return function.name.find(part) != std::string::npos; };
        const std::size_t allowed = is("tilted") ? 5 : is("cap_mass") ? 60 : 0;
        CHECK(bad <= (real == Real::f32 ? allowed : 0));
    }
}

}  // namespace

TEST_CASE("no operation overflows, divides by 0 or is invalid inside the domain") {
    check_domain<float>(runtime::find_unoptimised_function_float);
    check_domain<double>(runtime::find_unoptimised_function_double);
}

TEST_CASE("outside the domain the same build raises each flag, and the test sees it") {
    const auto flags = [](const char* name, const std::vector<double>& row) {
        return raised<float>(runtime::find_unoptimised_function_float(name), row);
    };
    CHECK(flags("vndf_reflect", {1e38, 1e38, 0, 1e38, 1e38, 0}) & FE_OVERFLOW);
    CHECK(flags("vndf_reflect", {1e38, 1e38, 0, 1e38, -1e38, 0}) & FE_INVALID);
    CHECK(flags("vndf_ggx_sample_wm_dupuy2023", {0, 0, 0, 1, 1, .5, .5}) & FE_DIVBYZERO);
}
