// The accuracy of kernels/vndf/math.h (strict), as stated at each function, for the VNDF_REAL of the including test.
#pragma once

#include <boost/math/special_functions/erf.hpp>
#include <boost/multiprecision/cpp_bin_float.hpp>
#include <cmath>
#include <cstdio>
#include <limits>
#include <string>
#include <type_traits>

#include "../../kernels/vndf/math.h"
#include "catch.h"

namespace {

using Number = VNDF_REAL;
constexpr bool is_float = std::is_same_v<Number, float>;
// What the claims are judged in: 11 (float) or more (double) bits beyond the error that is measured.
using Exact = std::conditional_t<is_float, long double, boost::multiprecision::cpp_bin_float_50>;
using Bits = VNDF_INT;

const Exact pi = boost::math::constants::pi<Exact>();
const Exact root_pi = boost::math::constants::root_pi<Exact>();

// --- The functions themselves, from their definitions ---

// x + (1/2) / (x + 1 / (x + (3/2) / ...)) = x + rest, where sqrt(pi) erfcx(x) = 1 / (x + rest)
Exact fraction_rest(const Exact& x) {
    Exact f = x;
    for (int k = 300; k >= 2; --k) f = x + Exact(k) / 2 / f;
    return Exact(1) / 2 / f;
}
Exact erfcx(const Exact& x) {
    using std::exp;
    return x < 4 ? Exact(exp(x * x) * boost::math::erfc(x)) : Exact(1 / ((x + fraction_rest(x)) * root_pi));
}
Exact ierfcx(const Exact& x) {
    if (x < 4) return (1 / root_pi - x * erfcx(x)) / 2;
    const Exact rest = fraction_rest(x);
    return rest / (x + rest) / root_pi / 2;
}
// eta / 2 of eta - sin(eta) = k^3 / 6, by Newton's method on the cube root.
Exact kepler_half(const Exact& k) {
    using std::abs, std::cos, std::pow, std::sin, std::cbrt;
    Exact eta = k * (1 + k * k / 60);
    for (int i = 0; i < 60; ++i) {
        Exact value = eta - sin(eta);
        if (eta < 1) {  // its series
            Exact term = eta;
            value = 0;
            for (int j = 1; j < 25; ++j) value -= term *= -eta * eta / (2 * j * (2 * j + 1));
        }
        const Exact step = (value - k * k * k / 6) / (1 - cos(eta));
        eta -= step;
        if (!(abs(step) > eta * std::numeric_limits<Exact>::epsilon() * 16)) break;
    }
    return eta / 2;
}

// --- Errors in eps = 2^-24 or 2^-53 ---

enum class Error { relative, absolute };

struct Claim {
    std::string name;
    Number (*function)(Number);
    Exact (*exact)(const Exact&);
    Number low, high;
    double bound_float, bound_double;
    Error error = Error::relative;

    double bound() const { return is_float ? bound_float : bound_double; }
};

const Number smallest = std::numeric_limits<Number>::min(), largest = std::numeric_limits<Number>::max();
constexpr Number exp_low = is_float ? -87 : -708, gauss_high = is_float ? 9.3 : 26.6,
                 erfc_high = is_float ? 9.1 : 26.4;
constexpr Number kepler_high = 2.66;

using std::cos, std::erf, std::exp, std::log, std::sin, std::sqrt;
// clang-format off
const Claim claims[] = {
    {"rcp_sqrt", vndf_impl_rcp_sqrt, [](const Exact& x) { return Exact(1 / sqrt(x)); }, smallest, largest, 2, 2},
    {"circle_sin", vndf_impl_circle_sin, [](const Exact& u) { return Exact(sin(2 * pi * u)); }, 0, 1, 2, 2, Error::absolute},
    {"circle_sin", vndf_impl_circle_sin, [](const Exact& u) { return Exact(sin(2 * pi * u)); }, 1e-12f, 0.25f, 3, 3},
    {"circle_cos", vndf_impl_circle_cos, [](const Exact& u) { return Exact(cos(2 * pi * u)); }, 0, 1, 2, 2, Error::absolute},
    {"log", vndf_impl_log, [](const Exact& x) { return Exact(log(x)); }, smallest, largest, 2, 2},
    {"exp", vndf_impl_exp, [](const Exact& x) { return Exact(exp(x)); }, exp_low, 0, 2, 2},
    {"exp", vndf_impl_exp, [](const Exact& x) { return Exact(exp(x)); }, 0, -exp_low, 2, 2},
    {"expx2", vndf_impl_expx2, [](const Exact& x) { return Exact(exp(-x * x)); }, 0, gauss_high, 2.5, 2.5},
    {"erfcx", vndf_impl_erfcx, erfcx, 0, 1e18f, 5, 5},
    {"ierfcx", vndf_impl_ierfcx, ierfcx, 0, 1e18f, 4.5, 4.5},
    {"erfc", vndf_impl_erfc, [](const Exact& x) { return Exact(boost::math::erfc(x)); }, 0, erfc_high, 6, 6},
    {"erfc", vndf_impl_erfc, [](const Exact& x) { return Exact(boost::math::erfc(x)); }, -9, 0, 6, 6},
    {"erf", vndf_impl_erf, [](const Exact& x) { return Exact(boost::math::erf(x)); }, smallest, 9, 5, 5},
    {"cbrt", vndf_impl_cbrt, [](const Exact& x) { return Exact(cbrt(x)); }, smallest, largest, 2, 2},
    {"kepler_sin_half", vndf_impl_kepler_sin_half, [](const Exact& k) { return Exact(sin(kepler_half(k))); }, 1e-6f, kepler_high, 3, 5},
    {"kepler_cos_half", vndf_impl_kepler_cos_half, [](const Exact& k) { return Exact(cos(kepler_half(k))); }, 1e-6f, kepler_high, 2, 3, Error::absolute},
};
// clang-format on

const double eps = is_float ? 0x1p-24 : 0x1p-53;
constexpr long points = is_float ? 60000 : 6000;  // 6000 in 50 digits take as long

// Calls use(x) for evenly spaced representations from low to high >= low >= 0, or high <= 0: each binade counts alike.
template <class Use>
void for_numbers(Number low, Number high, Use use) {
    const bool negative = low < 0;
    const Number first = negative ? -high : low, last = negative ? -low : high;
    // A subnormal or zero start would spend nearly all points on tiny numbers.
    const Number least = std::max<Number>(first, static_cast<Number>(1e-20));
    const double from = static_cast<double>(VNDF_AS_INT(least)), to = static_cast<double>(VNDF_AS_INT(last));
    for (long i = 0; i <= points; ++i) {
        const auto bits = static_cast<Bits>(from + (to - from) * (static_cast<double>(i) / points));
        const Number x = std::min(std::max(VNDF_AS_REAL(bits), least), last);
        use(negative ? -x : x);
    }
    use(negative ? -first : first);
}

struct Worst {
    double error = 0;
    Number at = 0;

    void add(const Exact& relative, Number x) {
        using std::abs;
        const auto e = static_cast<double>(Exact(abs(relative))) / eps;
        if (!(e <= error)) error = e, at = x;  // NaN is the worst
    }
};

std::string hex(Number x) {
    char text[64];
    std::snprintf(text, sizeof text, "%a", static_cast<double>(x));
    return text;
}

}  // namespace

#define VNDF_TEXT_(x) #x
#define VNDF_TEXT(x) VNDF_TEXT_(x)
#define VNDF_CASE(claim) TEST_CASE(VNDF_TEXT(VNDF_REAL) ": " claim, "[math]")

VNDF_CASE("elementary functions keep the accuracy stated at them") {
    for (const Claim& claim : claims) {
        Worst worst;
        for_numbers(claim.low, claim.high, [&](Number x) {
            const Exact exact = claim.exact(Exact(x)), difference = Exact(claim.function(x)) - exact;
            worst.add(claim.error == Error::absolute || exact == 0 ? difference : Exact(difference / exact),
                      x);
        });
        CAPTURE(claim.name, claim.low, claim.high, worst.error, hex(worst.at));
        CHECK(worst.error <= claim.bound());
    }
}

// The error of x = erfcinv(q) is (q - erfc(x)) / erfc'(x): no other inverse is needed to judge this one.
VNDF_CASE("erfcinv is relatively accurate from the smallest number to 2, and at 1") {
    using std::exp;
    Worst worst;
    const auto add = [&](Number q) {
        const Exact x = vndf_impl_erfcinv(q), miss = x < Exact(1) / 2 && x > Exact(-1) / 2
                                                         ? Exact(1 - Exact(q) - boost::math::erf(x))
                                                         : Exact(boost::math::erfc(x) - Exact(q));
        if (q != 1) worst.add(miss * root_pi / 2 * exp(x * x) / x, q);
    };
    for_numbers(smallest, 1, add);
    for_numbers(1, std::nextafter(Number(2), Number(0)), add);
    for (Number d = eps * 4; d < 0.25; d *= Number(1.37)) add(1 - d), add(1 + d);
    CAPTURE(worst.error, hex(worst.at));
    CHECK(worst.error <= (is_float ? 8 : 10));
    CHECK(vndf_impl_erfcinv(1) == 0);
}

VNDF_CASE("erfcinv is antisymmetric about 1") {
    for (Number q = 1; q > eps * 8; q *= Number(0.75)) {
        const Number rounded = 2 - (2 - q);  // both are numbers
        CHECK(vndf_impl_erfcinv(2 - rounded) == -vndf_impl_erfcinv(rounded));
    }
}

VNDF_CASE("a scaled exponential neither under- nor overflows on the way") {
    using std::exp;
    const Number scale = is_float ? 1e30f : Number(1e300), x = is_float ? -100 : Number(-900);
    const Exact expected = exp(Exact(x)) * Exact(scale);
    CHECK(std::abs(static_cast<double>(Exact(Exact(vndf_impl_scaled_exp(x, 0, scale)) / expected - 1))) <=
          2.5 * eps);
    CHECK(vndf_impl_exp(-1e30f) == 0);
    CHECK(vndf_impl_exp(-std::numeric_limits<Number>::infinity()) == 0);
    CHECK(vndf_impl_expx2(1e30f) == 0);
    CHECK(vndf_impl_erfc(1e30f) == 0);
    CHECK(vndf_impl_erfc(-1e30f) == 2);
}

VNDF_CASE("NaN in gives NaN out") {
    const Number nan = std::numeric_limits<Number>::quiet_NaN();
    for (const Claim& claim : claims) {
        CAPTURE(claim.name);
        CHECK(std::isnan(claim.function(nan)));
    }
    CHECK(std::isnan(vndf_impl_erfcinv(nan)));
}
