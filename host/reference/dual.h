// Forward-mode dual numbers: a value and its partial derivatives by N inputs.
//
// Comparisons look at values alone, so that the derivative is that of the branch taken.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <type_traits>

namespace vndf::reference {

template <class T, std::size_t N>
struct Dual {
    T value{};
    std::array<T, N> partial{};

    Dual() = default;
    Dual(T v) : value(v) {}  // implicit: a constant

    static Dual variable(T v, std::size_t index) {
        Dual x(v);
        x.partial[index] = 1;
        return x;
    }
};

// The number type behind R: T for Dual<T, N>, R itself otherwise; and the value in it.
template <class R>
struct Underlying {
    using type = R;
    static const R& value(const R& x) { return x; }
};
template <class T, std::size_t N>
struct Underlying<Dual<T, N>> {
    using type = T;
    static const T& value(const Dual<T, N>& x) { return x.value; }
};
template <class R>
using Real = typename Underlying<R>::type;
template <class R>
const Real<R>& value_of(const R& x) {
    return Underlying<R>::value(x);
}

// f(a) for a function with value f and derivative df at a; f(a, b) likewise.
template <class T, std::size_t N>
Dual<T, N> chain(T f, T df, const Dual<T, N>& a) {
    Dual<T, N> r(f);
    for (std::size_t i = 0; i < N; ++i) r.partial[i] = df * a.partial[i];
    return r;
}
template <class T, std::size_t N>
Dual<T, N> chain(T f, T da, const Dual<T, N>& a, T db, const Dual<T, N>& b) {
    Dual<T, N> r(f);
    for (std::size_t i = 0; i < N; ++i) r.partial[i] = da * a.partial[i] + db * b.partial[i];
    return r;
}

template <class T, std::size_t N>
Dual<T, N> operator-(const Dual<T, N>& a) {
    return chain(-a.value, T(-1), a);
}

#define VNDF_DUAL_OPERATOR(op, f, da, db)                                           \
    template <class T, std::size_t N>                                               \
    Dual<T, N> operator op(const Dual<T, N>& a, const Dual<T, N>& b) {              \
        const T x = a.value, y = b.value;                                           \
        return chain(T(f), T(da), a, T(db), b);                                     \
    }                                                                               \
    template <class T, std::size_t N>                                               \
    Dual<T, N> operator op(const Dual<T, N>& a, const std::type_identity_t<T>& y) { \
        const T x = a.value;                                                        \
        return chain(T(f), T(da), a);                                               \
    }                                                                               \
    template <class T, std::size_t N>                                               \
    Dual<T, N> operator op(const std::type_identity_t<T>& x, const Dual<T, N>& b) { \
        const T y = b.value;                                                        \
        return chain(T(f), T(db), b);                                               \
    }
VNDF_DUAL_OPERATOR(+, x + y, 1, 1)
VNDF_DUAL_OPERATOR(-, x - y, 1, -1)
VNDF_DUAL_OPERATOR(*, x* y, y, x)
VNDF_DUAL_OPERATOR(/, x / y, 1 / y, -x / (y * y))
#undef VNDF_DUAL_OPERATOR

#define VNDF_DUAL_COMPARISON(op)                                              \
    template <class T, std::size_t N>                                         \
    bool operator op(const Dual<T, N>& a, const Dual<T, N>& b) {              \
        return a.value op b.value;                                            \
    }                                                                         \
    template <class T, std::size_t N>                                         \
    bool operator op(const Dual<T, N>& a, const std::type_identity_t<T>& b) { \
        return a.value op b;                                                  \
    }                                                                         \
    template <class T, std::size_t N>                                         \
    bool operator op(const std::type_identity_t<T>& a, const Dual<T, N>& b) { \
        return a op b.value;                                                  \
    }
VNDF_DUAL_COMPARISON(<)
VNDF_DUAL_COMPARISON(<=)
VNDF_DUAL_COMPARISON(>)
VNDF_DUAL_COMPARISON(>=)
#undef VNDF_DUAL_COMPARISON

#define VNDF_DUAL_FUNCTION(name, df)       \
    template <class T, std::size_t N>      \
    Dual<T, N> name(const Dual<T, N>& a) { \
        using std::name;                   \
        const T x = a.value;               \
        const T f = name(x);               \
        return chain(f, T(df), a);         \
    }
VNDF_DUAL_FUNCTION(sqrt, 1 / (2 * f))
VNDF_DUAL_FUNCTION(cbrt, 1 / (3 * f * f))
VNDF_DUAL_FUNCTION(sin, std::cos(x))
VNDF_DUAL_FUNCTION(cos, -std::sin(x))
VNDF_DUAL_FUNCTION(exp, f)
VNDF_DUAL_FUNCTION(log, 1 / x)
VNDF_DUAL_FUNCTION(log1p, 1 / (1 + x))
VNDF_DUAL_FUNCTION(erf, T(1.12837916709551257389615890312154517L) * std::exp(-x * x))
VNDF_DUAL_FUNCTION(erfc, T(-1.12837916709551257389615890312154517L) * std::exp(-x * x))
#undef VNDF_DUAL_FUNCTION

template <class T, std::size_t N>
Dual<T, N> abs(const Dual<T, N>& a) {
    return std::signbit(a.value) ? -a : a;  // |-0| = +0, as of numbers
}

template <class T, std::size_t N>
Dual<T, N> atan2(const Dual<T, N>& y, const Dual<T, N>& x) {
    const T r2 = x.value * x.value + y.value * y.value;
    return chain(T(std::atan2(y.value, x.value)), T(x.value / r2), y, T(-y.value / r2), x);
}

}  // namespace vndf::reference
