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
inline Direction reflect(const Direction& o, const Direction& m) {
    return 2 * dot(o, m) * m + -o;
}

// What is made of alpha, in samplers as in values.
struct AlphaMistake {
    const char* what;
    Alpha (*of)(const Alpha& alpha);
};
inline constexpr AlphaMistake alpha_mistakes[] = {
    {"alpha.x and alpha.y are exchanged",
     [](const Alpha& a) {
         return Alpha{a[1], a[0]};
     }},
    {"alpha is squared once more, as if it were a perceptual roughness",
     [](const Alpha& a) {
         return Alpha{a[0] * a[0], a[1] * a[1]};
     }},
    {"the square root of alpha is taken for it",
     [](const Alpha& a) {
         return Alpha{std::sqrt(a[0]), std::sqrt(a[1])};
     }},
    {"alpha.y is not used: judge it with --isotropic",
     [](const Alpha& a) {
         return Alpha{a[0], a[0]};
     }},
    {"alpha.x is not used: judge it with --isotropic", [](const Alpha& a) {
         return Alpha{a[1], a[1]};
     }}};

}  // namespace vndf::conformance::vectors
