// The two distributions of visible normals in stretched space, where both alphas are 1.
//
// Frame: e is the azimuth of the stretched wo, p = z x e the direction across it, theta the polar angle of
// the stretched wo and nu = pi - theta.
//
// GGX. The microsurface is the unit hemisphere, and the visible normals are distributed as its projection
// along wo. A normal is written by its component t along p and an angle beta in the plane of e and z,
//     m = t p + sqrt(1 - t^2) (cos(beta) e + sin(beta) z),    -1 < t < 1,  0 < beta < nu,
// beta = 0 being the horizon and beta = nu the silhouette. Then m . wo = sqrt(1 - t^2) sin(nu - beta), the
// solid angle is sqrt(1 - t^2) dt dbeta / sqrt(1 - t^2), and the density factors:
//     (2 / pi) sqrt(1 - t^2) dt  *  sin(nu - beta) / (1 + cos theta) dbeta.
// So t and beta are independent; t is distributed as a semicircle, and beta has the distribution function
//     F(beta) = 1 - sin^2((nu - beta) / 2) / sin^2(nu / 2).
//
// Beckmann. The slopes are Gaussian; in the plane of incidence the slope x (normal (-x, ., 1)) has the
// density 2 (a - x) e^(-x^2) / (sqrt(pi) N(a)) for x < a = cot(theta), with
//     N(x; a) = (2 / sqrt(pi)) integral of (a - s) e^(-s^2) over s < x,  N(a) = N(a; a);
// the slope y across is an independent Gaussian.
#pragma once

#include <boost/math/quadrature/gauss.hpp>

#include "reference/roots.h"

namespace vndf::reference {

template <class R>
struct Vec3 {
    R x, y, z;
};
template <class R>
R dot(const Vec3<R>& a, const Vec3<R>& b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}
template <class R>
Vec3<R> scaled(const Vec3<R>& a, const R& s) {
    return {a.x * s, a.y * s, a.z * s};
}
template <class R>
R squared(const R& x) {
    return x * x;
}

// Length of (x, y) without underflow; 0, with derivative 0, at the origin: +0 whatever the signs of x and y, since atan2
// tells the zeros apart.
template <class R>
R hypotenuse(const R& x, const R& y) {
    using std::abs, std::sqrt;
    const R scale = abs(x) < abs(y) ? R(abs(y)) : R(abs(x));
    if (!(scale > 0)) return R(abs(value_of(x)) + abs(value_of(y)));  // +0, or NaN
    return scale * sqrt(squared(R(x / scale)) + squared(R(y / scale)));
}
template <class R>
Vec3<R> normalised(const Vec3<R>& v) {
    const R length = hypotenuse(hypotenuse(v.x, v.y), v.z);
    return {v.x / length, v.y / length, v.z / length};
}

// wo after stretching.
template <class R>
struct View {
    R alpha_x, alpha_y;
    R across, up;  // |(alpha_x wo.x, alpha_y wo.y)| and wo.z
    R length;      // of the stretched vector
    R ex, ey;      // e; (1, 0) where nothing is across
    R theta, nu;   // polar angle and pi - theta, each with its own relative accuracy
    R sin_theta, cos_theta;
};

template <class R>
View<R> view(const Vec3<R>& wo, const R& alpha_x, const R& alpha_y) {
    using std::atan2;
    View<R> v;
    v.alpha_x = alpha_x;
    v.alpha_y = alpha_y;
    const R x = alpha_x * wo.x, y = alpha_y * wo.y;
    v.across = hypotenuse(x, y);
    v.up = wo.z;
    v.length = hypotenuse(v.across, v.up);
    const bool level = v.across > 0;
    v.ex = level ? R(x / v.across) : R(1);
    v.ey = level ? R(y / v.across) : R(0);
    v.theta = atan2(v.across, v.up);
    v.nu = atan2(v.across, R(-v.up));
    v.sin_theta = v.across / v.length;
    v.cos_theta = v.up / v.length;
    return v;
}

// The rotation of e by a small angle, whose derivative is a part of the condition number.
template <class R>
void rotate(View<R>& v, const R& angle) {
    const R x = v.ex - v.ey * angle;
    v.ey = v.ey + v.ex * angle;
    v.ex = x;
}

// An angle x in [0, half] with sin^2(x) = u sin^2(half), 0 < half <= pi / 2, and what is left of half; v = 1
// - u and co_half = pi / 2 - half are given, so that neither loses its relative accuracy. It is the
// distribution function of beta (u = 1 - F, x = (nu - beta) / 2, half = nu / 2) and that of the polar angle 2
// x of directions uniform on a cap of opening 2 half.
template <class R>
struct CapAngle {
    R x, rest;
};
template <class R>
CapAngle<R> cap_angle(const R& u, const R& v, const R& half, const R& co_half) {
    using std::sin, std::sqrt;
    using T = Real<R>;
    const T h = value_of(half), root_u = std::sqrt(value_of(u)), root_v = std::sqrt(value_of(v));
    if (u < T(0.5)) {
        // The sine is concave: sin(root_u h) >= root_u sin(h).
        const auto f = [](auto x, auto u, auto half) { return sin(decltype(half)(x)) / sin(half) - sqrt(u); };
        const auto df = [](T x, T, T half) { return std::cos(x) / std::sin(half); };
        const R x = solve<R>(f, df, root_u * std::sin(h), root_u * h, u, half);
        return {x, half - x};
    }
    // 1 - sin^2(x) / sin^2(half) = sin(y) sin(2 half - y) / sin^2(half) in y = half - x.
    const auto sine = [](auto y, auto half, auto co_half) {  // of 2 half - y
        using S = decltype(half);
        return sin(half < co_half ? S(2 * half - y) : S(2 * co_half + y));
    };
    const auto f = [sine](auto y, auto v, auto half, auto co_half) {
        using S = decltype(half);
        return sin(S(y)) * sine(S(y), half, co_half) / squared(S(sin(half))) - v;
    };
    const auto df = [sine](T y, T, T half, T co_half) {
        return sine(2 * y, half, co_half) / squared(std::sin(half));
    };
    const T least = h * value_of(v) / (1 + std::sqrt(std::max(T(0), 1 - value_of(v))));
    const R y = solve<R>(f, df, least, h * root_v, v, half, co_half);
    return {half - y, y};
}

// beta with F(beta) = u, given v = 1 - u, and sin(nu - beta).
template <class R>
struct Beta {
    R beta, facing;
};
template <class R>
Beta<R> ggx_beta(const R& u, const R& v, const R& theta, const R& nu) {
    using std::sin;
    const CapAngle<R> half = cap_angle<R>(v, u, nu / 2, theta / 2);
    const R beta = 2 * half.rest, rest = 2 * half.x;
    return {beta, sin(beta < rest && theta < nu ? R(theta + beta) : rest)};
}

// F(beta) and its density.
template <class R>
R ggx_beta_cdf(const R& beta, const R& theta, const R& nu) {
    using std::sin;
    const R other = theta < nu ? R(theta + beta / 2) : R(nu - beta / 2);
    return beta < nu ? R(sin(beta / 2) * sin(other) / squared(R(sin(nu / 2)))) : R(1);
}
template <class R>
R ggx_beta_pdf(const R& beta, const R& theta, const R& nu) {
    using std::sin;
    const R rest = nu - beta;
    return rest > 0 ? R(sin(theta < beta ? rest : R(theta + beta)) / (2 * squared(R(sin(nu / 2))))) : R(0);
}

// t, distributed as a semicircle, with the mass u below it; root = sqrt(1 - t^2). With t = cos(tau) the mass
// of the end beyond t is (2 tau - sin 2 tau) / (2 pi).
template <class R>
struct Semicircle {
    R t, root;
};
template <class R>
Semicircle<R> semicircle(const R& u, const R& v) {
    using std::cbrt, std::cos, std::sin;
    using T = Real<R>;
    const bool low = u < v;
    const R mass = low ? u : v;
    // In x = 2 tau and by cube roots, since x - sin x ~ x^3 / 6.
    const auto f = [](auto x, auto mass) {
        return std::cbrt(x_minus_sin<T>(value_of(x))) - cbrt(decltype(mass)(2 * pi<R>() * mass));
    };
    const auto df = [](T x, T) { return (1 - std::cos(x)) / (3 * squared(std::cbrt(x_minus_sin<T>(x)))); };
    const T least = std::cbrt(12 * pi<R>() * value_of(mass));
    const R x = solve<R>(f, df, least, T(1.2) * least, mass);
    const R tau = x / 2, t = cos(tau);
    return {low ? R(-t) : t, sin(tau)};
}

// The Beckmann terms of a view: a = cot(theta), and N(a) as weight * e^(-max(0, -a)^2).
template <class R>
struct Slopes {
    R a, weight;
};
template <class R>
Slopes<R> beckmann_slopes(const R& sin_theta, const R& cos_theta) {
    using std::erfc, std::exp;
    using T = Real<R>;
    // Beyond 1e100 the Gaussian is cut nowhere and 1 / a is no longer felt; products stay finite.
    const T huge = T(1e100);
    const bool steep = !(std::abs(value_of(cos_theta)) < huge * value_of(sin_theta));
    Slopes<R> s;
    s.a = steep ? R(cos_theta < 0 ? -huge : huge) : R(cos_theta / sin_theta);
    s.weight =
        s.a < 0 ? gaussian_tail<R>(-s.a).first : R(s.a * erfc(-s.a) + rcp_sqrt_pi<R>() * exp(-s.a * s.a));
    return s;
}

// A slope x in the plane of incidence and d = a - x, each accurate.
template <class R>
struct Slope {
    R x, d;
};

// Density of x: 2 d e^(-x^2) / (sqrt(pi) N(a)), with the two exponents taken together where a < 0.
template <class R>
R beckmann_slope_pdf(const Slopes<R>& s, const Slope<R>& at) {
    using std::exp;
    if (!(at.d > 0)) return R(0);
    const R exponent = s.a < 0 ? R(at.d * (at.d - 2 * s.a)) : R(at.x * at.x);
    return 2 * rcp_sqrt_pi<R>() * (at.d / s.weight) * exp(-exponent);
}

// The logarithm of its distribution function.
template <class R>
R beckmann_slope_log_cdf(const Slopes<R>& s, const Slope<R>& at) {
    using std::erfc, std::exp, std::log;
    const R &x = at.x, &d = at.d;
    if (!(d > 0)) return R(0);
    if (s.a < 0) {
        const GaussianTail<R> tail = gaussian_tail<R>(-x);
        return log((d * tail.mass + tail.first) / s.weight) - d * (d - 2 * s.a);
    }
    if (x < -2) {  // e^(-x^2) apart, against underflow
        const GaussianTail<R> tail = gaussian_tail<R>(-x);
        return log((s.a * tail.mass + rcp_sqrt_pi<R>()) / s.weight) - x * x;
    }
    return log((s.a * erfc(-x) + rcp_sqrt_pi<R>() * exp(-x * x)) / s.weight);
}

// The slope `down` below the top of its range: a, or 8 where a is beyond, above which no mass of 2^-53 lies.
template <class R>
Slope<R> slope_below_top(const R& a, const R& down) {
    using T = Real<R>;
    const T top = 8;
    return a < top ? Slope<R>{a - down, down} : Slope<R>{top - down, a - top + down};
}

// The mass above a slope x in [-1, 7], where a >= 8: the parts of x and of a do not cancel.
template <class R>
R beckmann_slope_upper(const R& x, const R& a, const R& weight) {
    using std::erfc, std::exp;
    return (a * (erfc(x) - erfc(a)) - rcp_sqrt_pi<R>() * (exp(-x * x) - exp(-a * a))) / weight;
}

// The mass between the slope `down` below the top a < 8 of the range and that top, by quadrature of the density.
template <class R>
R beckmann_slope_next_to_top(const R& down, const R& a, const R& weight) {
    using Rule = boost::math::quadrature::gauss<Real<R>, 30>;
    R sum(0);
    for (std::size_t i = 0; i < Rule::abscissa().size(); ++i)
        for (const int sign : {-1, 1}) {
            const R d = down * ((1 + sign * Rule::abscissa()[i]) / 2);
            sum = sum + Rule::weights()[i] / 2 * beckmann_slope_pdf<R>({a, weight}, {a - d, d});
        }
    return down * sum;
}

// The slope below which the mass 1 - v lies, for small v, which 1 - v hides.
template <class R>
Slope<R> beckmann_slope_upper_inverse(const Slopes<R>& s, const R& v, const Real<R>& far) {
    using std::log, std::sqrt;
    using T = Real<R>;
    if (s.a >= 8) {
        const auto f = [](auto x, auto v, auto a, auto weight) {
            using S = decltype(a);
            return log(v) - log(beckmann_slope_upper<S>(S(x), a, weight));
        };
        const auto df = [](T x, T, T a, T weight) {
            return beckmann_slope_pdf<T>({a, weight}, {x, a - x}) / beckmann_slope_upper<T>(x, a, weight);
        };
        const R x = solve<R>(f, df, T(-1), T(7), v, s.a, s.weight);
        return {x, s.a - x};
    }
    // By roots, since the mass is nearly a square.
    const auto f = [](auto down, auto v, auto a, auto weight) {
        using S = decltype(a);
        if (!(down > 0)) return S(-sqrt(v));
        return S(sqrt(beckmann_slope_next_to_top<S>(S(down), a, weight)) - sqrt(v));
    };
    const auto df = [](T down, T, T a, T weight) {
        return beckmann_slope_pdf<T>({a, weight}, {a - down, down}) /
               (2 * std::sqrt(beckmann_slope_next_to_top<T>(down, a, weight)));
    };
    return slope_below_top<R>(s.a, solve<R>(f, df, T(0), far, v, s.a, s.weight));
}

// The slope below which the mass u = 1 - v lies.
template <class R>
Slope<R> beckmann_slope_inverse(const Slopes<R>& s, const R& u, const R& v) {
    using std::log;
    using T = Real<R>;
    // Less than 2^-65 of the mass lies below x = -8, or, behind the surface, where the exponent exceeds 60.
    const T a = value_of(s.a);
    const T far = a < 0 ? 60 / (std::sqrt(a * a + 60) - a) : std::min(a, T(8)) + 8;
    if (v < T(0x1p-20)) return beckmann_slope_upper_inverse(s, v, far);
    const auto f = [](auto down, auto u, auto a, auto weight) {
        using S = decltype(a);
        return log(u) - beckmann_slope_log_cdf<S>({a, weight}, slope_below_top<S>(a, S(down)));
    };
    const auto df = [](T down, T, T a, T weight) {
        const Slope<T> at = slope_below_top<T>(a, down);
        return beckmann_slope_pdf<T>({a, weight}, at) / std::exp(beckmann_slope_log_cdf<T>({a, weight}, at));
    };
    return slope_below_top<R>(s.a, solve<R>(f, df, T(0), far, u, s.a, s.weight));
}

}  // namespace vndf::reference
