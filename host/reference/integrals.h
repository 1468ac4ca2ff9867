// What the parts of Distribution share.
#pragma once

#include <algorithm>
#include <boost/math/quadrature/gauss.hpp>
#include <cmath>

#include "reference/distribution.h"
#include "reference/stretched.h"

namespace vndf::reference {

constexpr double pi_d = boost::math::constants::pi<double>();
constexpr double root_pi = boost::math::constants::root_pi<double>();

// The Gaussian's tail (roots.h) to about 1e-9, for pivots.
inline GaussianTail<double> quick_tail(double y) {
    if (y < 2) {
        const double mass = std::exp(y * y) * std::erfc(y);
        return {mass, 1 / root_pi - y * mass};
    }
    int n = static_cast<int>(4 + 90 / (y * y));
    double k = (std::sqrt(y * y + 2 * n) - y) / 2;
    for (; n > 1; --n) k = 0.5 * n / (y + k);
    k = 0.5 / (y + k);
    const double mass = 1 / (root_pi * (y + k));
    return {mass, k * mass};
}

// n-point Gauss-Legendre on [a, b].
template <unsigned n, class F>
void gauss(double a, double b, F f) {
    using Rule = boost::math::quadrature::gauss<double, n>;
    const double middle = (a + b) / 2, half = (b - a) / 2;
    for (std::size_t i = 0; i < Rule::abscissa().size(); ++i) {
        const double x = Rule::abscissa()[i], w = Rule::weights()[i] * half;
        f(middle + half * x, w);
        if (x != 0) f(middle - half * x, w);
    }
}

// The same on equal panels no wider than `width`.
template <unsigned n, class F>
void panels(double a, double b, double width, F f) {
    const int count = std::max(1, static_cast<int>(std::ceil((b - a) / width)));
    for (int i = 0; i < count; ++i) gauss<n>(a + (b - a) * i / count, a + (b - a) * (i + 1) / count, f);
}

// Nodes x = a + (b - a) / (1 + e^-s) on equal steps of s. A layer of any width at an end is a singularity at
// the imaginary distance pi / 2 in s: the error falls as e^(-pi^2 / step), whatever the width.
template <class F>
void logistic(double a, double b, double step, double reach, F f) {
    const int count = static_cast<int>(reach / step);
    for (int i = -count; i <= count; ++i) {
        const double e = std::exp(-std::abs(i * step)), near = (b - a) * e / (1 + e);
        f(i < 0 ? a + near : b - near, step * near / (1 + e));
    }
}

// In stretched polar slopes: m ~ (r cos(phi), r sin(phi), 1), the density of (r, phi) is
// (sin r cos(phi - phi_e) + cos) r P22(r) / sigma where the bracket is positive: for lo < r < hi.
struct Distribution::Range {
    double lo, hi;
    double slope;  // sin cos(phi - phi_e)
    double turn;   // tan(phi - phi_e)
};

inline Vec3d rotate(const std::array<Vec3d, 3>& rows, double x, double y, double z) {
    const auto row = [&](const Vec3d& r) { return r.x * x + r.y * y + r.z * z; };
    return {row(rows[0]), row(rows[1]), row(rows[2])};
}

// The direction, or the half vector of a reflected one, in the local frame, of any length.
inline Vec3d Distribution::half(double x, double y, double z) const {
    const Vec3d w = world_ ? rotate(frame_, x, y, z) : Vec3d{x, y, z};
    if (!reflected_) return w;
    const double rcp = 1 / std::sqrt(w.x * w.x + w.y * w.y + w.z * w.z);  // of a rounded unit vector
    return {wo_.x + w.x * rcp, wo_.y + w.y * rcp, wo_.z + w.z * rcp};
}

}  // namespace vndf::reference
