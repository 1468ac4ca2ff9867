// Directions and alphas as what is done to them by mistake (mistakes.h).
#pragma once

#include <array>
#include <cmath>

#include "conformance/inputs/rows.h"

namespace vndf::conformance::vectors {

using Alpha = std::array<double, 2>;

inline Direction operator+(const Direction& a, const Direction& b) {
    return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
}
inline Direction operator*(double s, const Direction& a) {
    return {s * a[0], s * a[1], s * a[2]};
}
inline Direction operator-(const Direction& a) {
    return -1.0 * a;
}
inline Direction normalised(const Direction& a) {
    return 1 / length(a) * a;
}
inline Direction cross(const Direction& a, const Direction& b) {
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
inline Direction reflect(const Direction& o, const Direction& m) {
    return 2 * dot(o, m) * m + -o;
}

inline Alpha each(const Alpha& a, double (*f)(double)) {
    return {f(a[0]), f(a[1])};
}
inline double squared(double x) {
    return x * x;
}
inline double root(double x) {
    return std::sqrt(x);
}

}  // namespace vndf::conformance::vectors
