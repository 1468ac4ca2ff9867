// What every sampler takes and gives.
#pragma once

#include "reference/reference.h"
#include "reference/stretched.h"

namespace vndf::reference {

// The arguments of any sampler; wo and n are normalised, alpha and u clamped.
template <class R>
struct Arguments {
    Vec3<R> wo, n;
    R alpha_x, alpha_y;
    R u1, v1, u2, v2;  // v = 1 - u, exact
    Real<R> least_u;   // the lower clamp of u
    R rotation;        // of e, 0
    Vec3<R> l;         // the axis of a cap, and its 1 - cos(beta), in parts: cap_maps.h
    R one_minus_cos, cap_part;
    Vec3<R> ng;  // a geometric normal in the local frame
};

template <class R>
struct Sample {
    Vec3<R> direction;
    R pdf;
};

template <class R>
View<R> view(const Arguments<R>& in) {
    View<R> v = view(in.wo, in.alpha_x, in.alpha_y);
    rotate(v, in.rotation);
    return v;
}

template <class R>
Sample<R> undefined(const Vec3<R>& direction) {
    return {direction, R(0)};
}

// wo = -z: no normal faces it but those of the horizon, which have no area.
template <class R>
bool nothing_visible(const View<R>& v) {
    return !(v.across > 0) && v.up < 0;
}

}  // namespace vndf::reference
