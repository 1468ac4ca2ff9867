// Inverting the integrated densities: bracketed root finding, exact for dual numbers too.
#pragma once

#include <algorithm>
#include <boost/math/constants/constants.hpp>
#include <boost/math/special_functions/erf.hpp>
#include <boost/math/tools/toms748_solve.hpp>
#include <cmath>
#include <cstdint>
#include <limits>

#include "reference/dual.h"

namespace vndf::reference {

template <class R>
Real<R> pi() {
    return boost::math::constants::pi<Real<R>>();
}
template <class R>
Real<R> rcp_sqrt_pi() {
    return boost::math::constants::one_div_root_pi<Real<R>>();
}

// The root in x of f(x, p...), increasing in x on [lo, hi] with derivative df(x, p...).
// The bracket is narrowed on values alone; two Newton steps then take the root to the accuracy of f, and the
// implicit function theorem, dx = -(df/dp) / (df/dx) dp, gives the derivatives by the parameters.
template <class R, class F, class D, class... P>
R solve(F f, D df, Real<R> lo, Real<R> hi, const P&... p) {
    using T = Real<R>;
    const auto on_values = [&](T x) { return T(f(x, value_of(p)...)); };
    const T f_lo = on_values(lo), f_hi = on_values(hi);
    T x = f_lo < 0 ? hi : lo;  // a root at an end, up to rounding
    if (f_lo < 0 && f_hi > 0) {
        std::uintmax_t steps = 200;
        const auto narrow = boost::math::tools::eps_tolerance<T>(std::numeric_limits<T>::digits * 2 / 3);
        const auto bracket = boost::math::tools::toms748_solve(on_values, lo, hi, f_lo, f_hi, narrow, steps);
        x = bracket.first + (bracket.second - bracket.first) / 2;
        for (int i = 0; i < 2; ++i) {
            const T step = on_values(x) / df(x, value_of(p)...);
            if (std::abs(step) < std::abs(bracket.second - bracket.first) * 2) x -= step;
        }
    }
    if constexpr (std::is_same_v<R, T>) {
        return x;
    } else {
        const T slope = df(x, value_of(p)...);
        R root = f(R(x), p...) / -slope;
        root.value = x;
        return root;
    }
}

// erfc_inv(q) for q in (0, 2): the slope beyond which a Gaussian has the mass q / 2.
template <class R>
R erfc_inv(const R& q) {
    using T = Real<R>;
    const T clamped =
        std::clamp(value_of(q), std::numeric_limits<T>::min(), 2 - std::numeric_limits<T>::epsilon());
    const T x = boost::math::erfc_inv(clamped);
    if constexpr (std::is_same_v<R, T>) {
        return x;
    } else {
        return chain(x, T(-std::exp(x * x) / (2 * rcp_sqrt_pi<R>())), q);
    }
}

// The Gaussian's tail beyond y >= 0 with its exponential taken out:
//   mass = e^(y^2) erfc(y),  first = e^(y^2) * (2 / sqrt(pi)) integral of (s - y) e^(-s^2) over s > y
//        = 1 / sqrt(pi) - y mass.
template <class R>
struct GaussianTail {
    R mass, first;
};

// Without exponentials for y >= 2: Laplace's continued fraction K_n = (n / 2) / (y + K_(n+1)) has
// mass = 1 / (sqrt(pi) (y + K_1)) and first = K_1 mass, free of the cancellation of the definition.
template <class T>
GaussianTail<T> gaussian_tail_value(T y, T& d_first) {
    const T scale = rcp_sqrt_pi<T>();
    if (y < 2) {
        const T mass = std::exp(y * y) * std::erfc(y), first = scale - y * mass;
        d_first = 2 * y * first - mass;
        return {mass, first};
    }
    // The error falls like exp(-2 y sqrt(2 n)); the start value is the fixed point of the recurrence.
    const T digits = std::numeric_limits<T>::digits * T(0.70);
    int n = static_cast<int>(8 + digits * digits / (8 * y * y));
    T k = (std::sqrt(y * y + 2 * n) - y) / 2;
    for (; n > 2; --n) k = (T(n) / 2) / (y + k);
    const T k2 = 1 / (y + k), k1 = T(0.5) / (y + k2), mass = scale / (y + k1);
    d_first = -mass * k2 / (y + k2);
    return {mass, k1 * mass};
}

template <class R>
GaussianTail<R> gaussian_tail(const R& y) {
    Real<R> d_first;
    const auto tail = gaussian_tail_value<Real<R>>(value_of(y), d_first);
    if constexpr (std::is_same_v<R, Real<R>>) {
        return tail;
    } else {
        return {chain(tail.mass, -2 * tail.first, y), chain(tail.first, d_first, y)};
    }
}

// x - sin x without cancellation.
template <class T>
T x_minus_sin(T x) {
    if (x > 1) return x - std::sin(x);
    T term = x * x * x / 6, sum = term;
    for (int k = 4; std::abs(term) > sum * std::numeric_limits<T>::epsilon() / 4; k += 2) {
        term *= -x * x / (k * (k + 1));
        sum += term;
    }
    return sum;
}

}  // namespace vndf::reference
