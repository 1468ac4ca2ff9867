// Vectors and affine maps in double.
#pragma once

#include <array>
#include <cmath>

#include "render/material.h"

namespace vndf::gltf {

using Vec3 = std::array<double, 3>;

inline Vec3 wide(const render::Vec& v) {
    return {v[0], v[1], v[2]};
}
inline render::Vec narrow(const Vec3& v) {
    return {static_cast<float>(v[0]), static_cast<float>(v[1]), static_cast<float>(v[2])};
}
inline Vec3 sum(const Vec3& a, double k, const Vec3& b) {  // a + k b
    return {a[0] + k * b[0], a[1] + k * b[1], a[2] + k * b[2]};
}
inline Vec3 difference(const Vec3& a, const Vec3& b) {
    return sum(a, -1, b);
}
inline double dot(const Vec3& a, const Vec3& b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
inline Vec3 cross(const Vec3& a, const Vec3& b) {
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
inline double length(const Vec3& a) {
    return std::sqrt(dot(a, a));
}
// Of length 1; of no or no finite length, all zeros.
inline Vec3 unit(const Vec3& a) {
    const double size = length(a);
    if (!(size > 0) || !std::isfinite(size)) return {};
    return {a[0] / size, a[1] / size, a[2] / size};
}
inline bool is_zero(const Vec3& a) {
    return a == Vec3{};
}
inline bool is_finite(const Vec3& a) {
    return std::isfinite(a[0]) && std::isfinite(a[1]) && std::isfinite(a[2]);
}
// What of it is orthogonal to a unit vector.
inline Vec3 across(const Vec3& a, const Vec3& normal) {
    return sum(a, -dot(normal, a), normal);
}

// Columns: where the axes go, and the origin.
struct Affine {
    std::array<Vec3, 4> columns{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, 0, 0}}};

    Vec3 direction(const Vec3& v) const {
        return sum(sum(sum({}, v[0], columns[0]), v[1], columns[1]), v[2], columns[2]);
    }
    Vec3 point(const Vec3& v) const { return sum(direction(v), 1, columns[3]); }
    // Where normals go, but for a positive factor.
    Affine of_normals() const {
        const double sign = determinant() < 0 ? -1 : 1;
        Affine result;
        for (int axis = 0; axis < 3; ++axis)
            result.columns[axis] = sum({}, sign, cross(columns[(axis + 1) % 3], columns[(axis + 2) % 3]));
        return result;
    }
    double determinant() const { return dot(columns[0], cross(columns[1], columns[2])); }
    Affine operator*(const Affine& inner) const {
        return {{direction(inner.columns[0]), direction(inner.columns[1]), direction(inner.columns[2]),
                 point(inner.columns[3])}};
    }
};

}  // namespace vndf::gltf
