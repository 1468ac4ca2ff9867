// The accuracy of kernels/vndf/impl/math.h (strict), as stated at each function, for the VNDF_REAL of the including test.
#pragma once

#include <boost/math/special_functions/erf.hpp>
#include <boost/multiprecision/cpp_bin_float.hpp>
#include <cmath>
#include <cstdio>
#include <limits>
#include <string>
#include <type_traits>

#include "../../kernels/vndf/impl/math.h"
#include "catch.h"

namespace {

using Number = VNDF_REAL;
constexpr bool is_float = std::is_same_v<Number, float>;
// What the claims are judged in: 11 (float) or more (double) bits beyond the error that is measured.
using Exact = std::conditional_t<is_float, long double, boost::multiprecision::cpp_bin_float_50>;
using Bits = VNDF_INT;

const Exact pi = boost::math::constants::pi<Exact>();
const Exact root_pi = boost::math::constants::root_pi<Exact>();

// --- The functions themselves, from their definitions, in Exact and in double (for floats alone: their squares are exact) ---

template <class R>
R exact_erfc(const R& x) {
    if constexpr (std::is_same_v<R, double>) return std::erfc(x);
    return boost::math::erfc(x);
}
template <class R>
R exact_erf(const R& x) {
    if constexpr (std::is_same_v<R, double>) return std::erf(x);
    return boost::math::erf(x);
}
// x + (1/2) / (x + 1 / (x + (3/2) / ...)) = x + rest, where sqrt(pi) erfcx(x) = 1 / (x + rest). For x >= 4 the error
// after n terms is below e^(-8 sqrt(2 n)).
template <class R>
R fraction_rest(const R& x) {
    R f = x;
    for (int k = std::is_same_v<R, double> ? 24 : 300; k >= 2; --k) f = x + R(k) / 2 / f;
    return R(1) / 2 / f;
}
template <class R>
R exact_erfcx(const R& x) {
    using std::exp;
    return x < 4 ? R(exp(R(x * x)) * exact_erfc(x)) : R(1 / ((x + fraction_rest(x)) * R(root_pi)));
}
template <class R>
R exact_ierfcx(const R& x) {
    if (x < 4) return (1 / R(root_pi) - x * exact_erfcx(x)) / 2;
    const R rest = fraction_rest(x);
    return rest / (x + rest) / R(root_pi) / 2;
}
// eta / 2 of eta - sin(eta) = k^3 / 6: its series in k, then Newton's method.
template <class R>
R kepler_half(const R& k) {
    using std::abs, std::sin;
    const R z = k * k;
    R eta = k * (1 + z * (R(1) / 60 + z * (R(1) / 1400 + z * (R(1) / 25200 + z * (R(43) / 17248000)))));
    if (std::is_same_v<R, double> && k < 0.1) return eta / 2;  // the next term is below 2^-60
    for (int i = 0; i < 60; ++i) {
        R value = eta - sin(eta);
        if (eta < 1) {  // its series
            R term = eta;
            value = 0;
            for (int j = 1; j < 25; ++j) value -= term *= -eta * eta / (2 * j * (2 * j + 1));
        }
        const R sine = sin(R(eta / 2)), step = (value - k * k * k / 6) / (2 * sine * sine);
        eta -= step;
        if (!(abs(step) > eta * std::numeric_limits<R>::epsilon() * 16)) break;
    }
    return eta / 2;
}
template <class R>
R exact_kepler_sin_half(const R& k) {
    using std::sin;
    return sin(kepler_half(k));
}
template <class R>
R exact_kepler_cos_half(const R& k) {
    using std::cos;
    return cos(kepler_half(k));
}
// Turns within a quarter of a turn, exactly.
template <class R>
R exact_circle_sin(const R& u) {
    using std::sin;
    const R b = u > R(0.5) ? R(1 - u) : u, m = b > R(0.25) ? R(R(0.5) - b) : b, sine = sin(R(2 * R(pi) * m));
    return u > R(0.5) ? R(-sine) : sine;
}
template <class R>
R exact_circle_cos(const R& u) {
    using std::sin;
    return sin(R(2 * R(pi) * (R(0.25) - (u > R(0.5) ? R(1 - u) : u))));
}
template <class R>
R exact_log(const R& x) {
    using std::log;
    return log(x);
}
template <class R>
R exact_exp(const R& x) {
    using std::exp;
    return exp(x);
}
template <class R>
R exact_expx2(const R& x) {
    using std::exp;
    return exp(R(-x * x));
}
template <class R>
R exact_cbrt(const R& x) {
    using std::cbrt;
    return cbrt(x);
}

// The relative error of x as erfcinv(q), 1 - q = p: no other inverse is needed to judge it.
template <class R>
R error_of_inverse(const R& x, const R& p, const R& q) {
    using std::abs, std::exp;
    const R miss = abs(x) < R(0.5) ? R(p - exact_erf(x)) : R(exact_erfc(x) - q);
    return miss * R(root_pi) / 2 * exp(R(x * x)) / x;
}

template <class R>
R exact_log_of_share(const R& x) {
    return exact_log(x);
}
template <class R>
R exact_moderate_exp(const R& x) {
    return exact_exp(x);
}
Number vndf_impl_erfcx(Number x) {
    return vndf_impl_scaled_erfc_of(x).erfcx;
}
Number vndf_impl_ierfcx(Number x) {
    return vndf_impl_scaled_erfc_of(x).ierfcx;
}

// --- Errors in eps = 2^-24 or 2^-53 ---

enum class Error { relative, absolute };

struct Claim {
    std::string name;
    Number (*function)(Number);
    Exact (*exact)(const Exact&);
    double (*in_double)(const double&);
    Number low, high;
    double bound_float, bound_double;
    double
        exhausted;  // float: the largest error over every number from low to high, in ulps (absolute: eps), rounded up
    Error error = Error::relative;

    double bound() const { return is_float ? bound_float : bound_double; }
};

const Number smallest = std::numeric_limits<Number>::min(), largest = std::numeric_limits<Number>::max();
constexpr Number exp_low = is_float ? -87 : -708, gauss_high = is_float ? 9.3 : 26.6;
// Of a share the kernels take the logarithm and its number the quantile of: e^-42; in double any.
const Number share_low = is_float ? 6e-19f : smallest;
constexpr Number kepler_high = 2.66;

#define VNDF_CLAIM(name) #name, vndf_impl_##name, exact_##name < Exact>, exact_##name < double>
// clang-format off
const Claim claims[] = {
    {VNDF_CLAIM(circle_sin), 0, 1, 1.43, 2, 1.43, Error::absolute},
    {VNDF_CLAIM(circle_sin), 1e-12f, 0.499999f, 1.8, 3, 1.43},
    {VNDF_CLAIM(circle_cos), 0, 1, 1.59, 2, 1.59, Error::absolute},
    {VNDF_CLAIM(log), smallest, largest, 1.4, 2, 0.85},
    {VNDF_CLAIM(exp), exp_low, 0, 1.5, 2, 1.02},
    {VNDF_CLAIM(exp), 0, -exp_low, 1.5, 2, 1.02},
    {VNDF_CLAIM(expx2), 0, gauss_high, 1.7, 2.5, 1.16},
    {VNDF_CLAIM(erfcx), 0, 1e18f, 5.2, 5.2, 4.72},
    {VNDF_CLAIM(ierfcx), 0, 1e18f, 6, 6, 6},
    {VNDF_CLAIM(log_of_share), share_low, 1, 2, 2, 2},
    {VNDF_CLAIM(moderate_exp), -80, 0, 1.5, 2, 1.5},
    {VNDF_CLAIM(moderate_exp), 0, 80, 1.5, 2, 1.5},
    {VNDF_CLAIM(cbrt), smallest, largest, 1.5, 2, 0.82},
    {VNDF_CLAIM(kepler_sin_half), 1e-6f, kepler_high, 2, 5, 1.97},
    {VNDF_CLAIM(kepler_cos_half), 1e-6f, kepler_high, 1.81, 3, 1.81, Error::absolute},
};
// clang-format on
#undef VNDF_CLAIM

const double eps = is_float ? 0x1p-24 : 0x1p-53;
constexpr long points = is_float ? 60000 : 6000;  // 6000 in 50 digits take as long

// Calls use(x) for evenly spaced representations from low to high >= low >= 0, or high <= 0: each binade counts alike.
template <class Use>
void for_numbers(Number low, Number high, Use use) {
    const bool negative = low < 0;
    const Number first = negative ? -high : low, last = negative ? -low : high;
    // From 0 on nearly all points would be tiny numbers.
    const Number least = first > 0 ? first : static_cast<Number>(1e-20);
    const double from = static_cast<double>(VNDF_AS_INT(least)), to = static_cast<double>(VNDF_AS_INT(last));
    for (long i = 0; i <= points; ++i) {
        const auto bits = static_cast<Bits>(from + (to - from) * (static_cast<double>(i) / points));
        const Number x = std::min(std::max(VNDF_AS_REAL(bits), least), last);
        use(negative ? -x : x);
    }
    use(negative ? -first : first);
}

// The distance between adjacent floats next to a normal x.
double ulp(double x) {
    return std::ldexp(1.0, std::ilogb(x) - 23);
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
        Worst worst, worst_ulps;
        for_numbers(claim.low, claim.high, [&](Number x) {
            const Exact exact = claim.exact(Exact(x)), difference = Exact(claim.function(x)) - exact;
            const bool absolute = claim.error == Error::absolute || exact == 0;
            worst.add(absolute ? difference : Exact(difference / exact), x);
            worst_ulps.add(difference * eps / (absolute ? eps : ulp(static_cast<double>(exact))), x);
        });
        CAPTURE(claim.name, claim.low, claim.high, worst.error, hex(worst.at));
        CHECK(worst.error <= claim.bound());
        if (is_float) CHECK(worst_ulps.error <= claim.exhausted);
    }
}

VNDF_CASE("erfcinv is relatively accurate from the smallest share to 2, and at 1") {
    Worst worst;
    const auto add = [&](Number q) {
        if (q != 1)
            worst.add(error_of_inverse(Exact(vndf_impl_erfcinv(q)), Exact(1 - Exact(q)), Exact(q)), q);
    };
    for_numbers(share_low, 1, add);
    for_numbers(1, std::nextafter(Number(2), Number(0)), add);
    for (Number d = eps * 4; d < 0.25; d *= Number(1.37)) add(1 - d), add(1 + d);
    CAPTURE(worst.error, hex(worst.at));
    CHECK(worst.error <= (is_float ? 4.1 : 10));
    CHECK(vndf_impl_erfcinv(1) == 0);
}

VNDF_CASE("erfinv's ratio is accurate from the smallest share to 1") {
    using std::sqrt;
    Worst worst;
    for_numbers(share_low, std::nextafter(Number(1), Number(0)), [&](Number r) {
        const Exact p = sqrt(1 - Exact(r)), x = Exact(vndf_impl_erfinv_ratio(r)) * p;
        worst.add(error_of_inverse(x, p, Exact(r / (1 + p))), r);
    });
    CAPTURE(worst.error, hex(worst.at));
    CHECK(worst.error <= (is_float ? 3.5 : 8));
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
}

VNDF_CASE("NaN in gives NaN out") {
    const Number nan = std::numeric_limits<Number>::quiet_NaN();
    for (const Claim& claim : claims) {
        CAPTURE(claim.name);
        CHECK(std::isnan(claim.function(nan)));
    }
    CHECK(std::isnan(vndf_impl_erfcinv(nan)));
}

VNDF_CASE("turn is the azimuth in turns, absolutely accurate, relatively near the positive x axis") {
    using std::abs, std::atan2;
    Worst absolute, relative;
    for (long i = 0; i < points; ++i) {
        // The golden section's steps about the circle, every third point drawn towards the x axis.
        const double angle = 6.283185307179586 * 0.6180339887498949 * static_cast<double>(i);
        const auto x = static_cast<Number>(cos(angle));
        const auto y =
            static_cast<Number>(sin(angle) * (i % 3 ? 1 : exp(-20. * static_cast<double>(i) / points)));
        Exact exact = Exact(atan2(Exact(y), Exact(x))) / (2 * pi);
        if (exact < 0) exact += 1;
        const Exact difference = Exact(vndf_impl_turn(x, y)) - exact;
        absolute.add(difference, x);
        if (x > 0 && y > 0) relative.add(Exact(difference / exact), x);
    }
    CAPTURE(absolute.error, relative.error);
    CHECK(absolute.error <= 2);
    CHECK(relative.error <= 4);
    CHECK(vndf_impl_turn(0, 0) == 0);
    CHECK(std::isnan(vndf_impl_turn(std::numeric_limits<Number>::quiet_NaN(), 1)));
}
