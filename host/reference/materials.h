// Reflectances and the materials made of them, from their definitions.
#pragma once

#include <array>
#include <cmath>
#include <complex>

#include "reference/terms.h"

namespace vndf::reference {

template <class R>
R within(const R& x, const R& low, const R& high) {
    return x < low ? low : x > high ? high : x;
}

// Fresnel's amplitudes with a complex index n, by Snell's law for complex angles: rs = (c - n t) / (c + n t), rp = (n c - t) /
// (n c + t), t the cosine behind the surface.
template <class R>
R fresnel_conductor(const R& cos_theta, const R& eta, const R& k) {
    using C = std::complex<R>;
    const R c = within<R>(cos_theta, 0, 1), absorbed = within<R>(k, 0, R(1e3));
    const C n(within<R>(eta, R(1e-3), R(1e3)), absorbed > R(1e-8) ? absorbed : R(0));
    const C t = std::sqrt(C(1) - C((1 - c) * (1 + c)) / (n * n));
    const C s = (c - n * t) / (c + n * t), p = (n * c - t) / (n * c + t);
    return (std::norm(s) + std::norm(p)) / 2;
}

// Snell's law in angles, sin(theta) = eta sin(theta_t), and Fresnel's formulas in their sum and difference: Rs = (sin(theta -
// theta_t) / sin(theta + theta_t))^2, Rp the same with tangents. The difference by its tangent's half: it vanishes with eta - 1.
template <class R>
R transmitted_cosine(const R& cos_theta, const R& eta) {
    using std::sqrt;
    const R c = within<R>(cos_theta, 0, 1), n = within<R>(eta, R(1e-3), R(1e3));
    const R square = (n - 1) * (n + 1) + c * c;
    return square > 0 ? R(sqrt(square) / n) : R(0);
}
template <class R>
R fresnel_dielectric(const R& cos_theta, const R& eta) {
    using std::sqrt;
    const R c = within<R>(cos_theta, 0, 1), n = within<R>(eta, R(1e-3), R(1e3));
    if (n == 1) return R(0);
    const R ct = transmitted_cosine(c, n);
    if (n < 1 && !(ct > 0)) return R(1);
    const R s = sqrt((1 - c) * (1 + c)), st = s / n;
    if (!(s > 0)) return squared((n - 1) / (n + 1));
    // sin and cos of theta - theta_t and of theta + theta_t.
    const R together = s * ct + c * st, apart = s * (n - 1) * (n + 1) * s / (n * n) / together;
    const R cos_apart = c * ct + s * st, cos_together = c * ct - s * st;
    const R rs = apart / together, rp = rs * cos_together / cos_apart;
    return (squared(rs) + squared(rp)) / 2;
}

template <class R>
R fresnel_schlick(const R& cos_theta, const R& f0, const R& f90) {
    const R c = within<R>(cos_theta, 0, 1), low = within<R>(f0, 0, 1), high = within<R>(f90, 0, 1);
    // 1 - (1 - c)^5, which keeps its digits for small c.
    const R fall = -std::expm1(5 * std::log1p(-c));
    return low * fall + high * std::pow(1 - c, R(5));
}

// Schlick's reflectance less the multiple of c (1 - c)^6 that makes it `tint` times itself at c = 1/7.
template <class R>
R fresnel_f82(const R& cos_theta, const R& f0, const R& tint) {
    const R c = within<R>(cos_theta, 0, 1), edge = R(1) / 7;
    const auto bump = [](const R& x) { return x * std::pow(1 - x, R(6)); };
    const R missing = (1 - within<R>(tint, 0, 1)) * fresnel_schlick<R>(edge, f0, 1);
    return within<R>(fresnel_schlick<R>(c, f0, 1) - missing / bump(edge) * bump(c), 0, 1);
}

template <class R>
R lambert_pdf(const Vec3<R>& wi) {
    return wi.z > 0 ? R(wi.z / pi<R>()) : R(0);
}

// The polar angle whose share of the cosine-weighted hemisphere, sin^2, is u2.
template <class R>
Vec3<R> lambert_direction(const R& u1, const R& u2) {
    const R phi = 2 * pi<R>() * u1, theta = std::atan2(std::sqrt(u2), std::sqrt(1 - u2));
    return {std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)};
}

// --- A whole material ---

struct MaterialModel {
    enum class Ndf { ggx, beckmann } ndf = Ndf::ggx;
    enum class Sampling { plain, bounded, conic } sampling = Sampling::bounded;
    enum class Fresnel { none, conductor, schlick, f82 } fresnel = Fresnel::schlick;
    enum class Masking { correlated, separable } masking = Masking::correlated;
};

template <class R>
using Rgb = std::array<R, 3>;

template <class R>
struct MaterialParameters {
    R alpha_x, alpha_y;
    Rgb<R> first, second;  // eta and k; f0 and f90, the first channel for all; f0 and f82
    Rgb<R> tint, albedo;
    R metal;
    Vec3<R> ng;
};

// f: BSDF times |cos(theta_i)|. Exponent: q of D, and of sigma behind the surface.
template <class R>
struct MaterialValue {
    Rgb<R> f{};
    R pdf = 0, exponent = 0;
    Rgb<R>
        slope{};  // what a relative change of 1 in the cosine of the reflectance, and in a height, makes of f
    bool settled = true;  // no rounding decides between the sides of a horizon or of a cap
};

// A material seen from wo: a conductor by F D G2 / (4 cos(theta_o)), Lambert's albedo / pi, and the rule about sides, each as
// its definition says it. Surfaces have two sides.
template <class R>
class MaterialView {
  public:
    MaterialView(const MaterialModel& model, const MaterialParameters<R>& p, const Vec3<R>& wo,
                 Precision precision)
        : model_(model), p_(p), precision_(precision), behind_(dot(wo, p.ng) < 0) {
        wo_ = behind_ ? Vec3<R>{wo.x, wo.y, -wo.z} : wo;
        ng_ = behind_ ? Vec3<R>{-p.ng.x, -p.ng.y, p.ng.z} : p.ng;
        const R least = precision == Precision::f32 ? R(1e-8f) : R(1e-8);
        p_.alpha_x = within<R>(p.alpha_x, least, 1000), p_.alpha_y = within<R>(p.alpha_y, least, 1000);
        p_.metal = within<R>(p.metal, 0, 1);
        view_ = view(wo_, p_.alpha_x, p_.alpha_y);
        bound_ = reference::bound(view_, wo_);
        if (wo_.z > 0 && model.sampling == MaterialModel::Sampling::conic)
            visible_ = ggx_sigma_visible(view_);
    }

    MaterialValue<R> operator()(const Vec3<R>& direction) const {
        const Vec3<R> wi = behind_ ? Vec3<R>{direction.x, direction.y, -direction.z} : direction;
        MaterialValue<R> value;
        const Vec3<R> h = normalised<R>({wo_.x + wi.x, wo_.y + wi.y, wo_.z + wi.z});
        value.exponent = model_.ndf == MaterialModel::Ndf::beckmann && h.z > 0
                             ? Beckmann::exponent(h, p_.alpha_x, p_.alpha_y)
                             : R(0);
        value.pdf = p_.metal * conductor_pdf(wi) + (1 - p_.metal) * lambert_pdf(wi);
        const R height_o = dot(wo_, ng_), height_i = dot(wi, ng_);
        value.settled = settled(wi, height_o, height_i);
        if (!(wo_.z > 0) || !(wi.z > 0) || !(height_o > 0) || !(height_i > 0)) return value;
        const R fade = ng_.z > 0 ? height_i / (wi.z * ng_.z) : R(1);
        const R passing = fade < 1 ? fade + fade * fade - fade * fade * fade : R(1);
        const R mirror =
            model_.ndf == MaterialModel::Ndf::ggx ? mirrored<Ggx>(h, wi) : mirrored<Beckmann>(h, wi);
        const R cosine = dot(wo_, h);
        for (int c = 0; c < 3; ++c) {
            const R scale = passing * p_.metal * p_.tint[c] * mirror;
            value.f[c] =
                scale * reflectance(c, cosine) + passing * (1 - p_.metal) * p_.albedo[c] * wi.z / pi<R>();
            value.slope[c] = scale * reflectance_slope(c, cosine) + value.f[c] / height_i;
        }
        return value;
    }

  private:
    // A height is a sum of rounded products, and next to the edge of the bounded cap its density is any of two.
    bool settled(const Vec3<R>& wi, const R& height_o, const R& height_i) const {
        const R unit = precision_ == Precision::f32 ? R(0x1p-24) : R(0x1p-53);
        if (std::abs(height_o) < 8 * unit || std::abs(height_i) < 8 * unit) return false;
        if (model_.sampling != MaterialModel::Sampling::bounded || !(wo_.z > 0)) return true;
        const Margin<R> margin = eto_margin(wo_, wi, view_, bound_);
        return std::abs(margin.inside) > 64 * unit * margin.per_unit;
    }
    R reflectance(int c, const R& cosine) const {
        return reflectance(cosine, p_.first[c],
                           p_.second[model_.fresnel == MaterialModel::Fresnel::schlick ? 0 : c]);
    }
    R reflectance(const R& cosine, const R& first, const R& second) const {
        switch (model_.fresnel) {
            case MaterialModel::Fresnel::none:
                return 1;
            case MaterialModel::Fresnel::conductor:
                return fresnel_conductor<R>(cosine, first, second);
            case MaterialModel::Fresnel::schlick:
                return fresnel_schlick<R>(cosine, first, second);
            case MaterialModel::Fresnel::f82:
                return fresnel_f82<R>(cosine, first, second);
        }
        return 0;
    }
    // The sum of |x dF / dx| over its arguments, by differences.
    R reflectance_slope(int c, const R& cosine) const {
        const R step = R(1e-6), x[3] = {cosine, p_.first[c],
                                        p_.second[model_.fresnel == MaterialModel::Fresnel::schlick ? 0 : c]};
        R sum = 0;
        for (int k = 0; k < 3; ++k) {
            R low[3] = {x[0], x[1], x[2]}, high[3] = {x[0], x[1], x[2]};
            low[k] *= 1 - step, high[k] *= 1 + step;
            sum += std::abs(reflectance(high[0], high[1], high[2]) - reflectance(low[0], low[1], low[2]));
        }
        return sum / (2 * step);
    }
    // D G2 / (4 cos(theta_o))
    template <class N>
    R mirrored(const Vec3<R>& h, const Vec3<R>& wi) const {
        const View<R> i = view(wi, p_.alpha_x, p_.alpha_y);
        const R masked = model_.masking == MaterialModel::Masking::correlated ? g2<N>(view_, i)
                                                                              : R(g1<N>(view_) * g1<N>(i));
        return N::template ndf<R>(h, p_.alpha_x, p_.alpha_y) * masked / (4 * wo_.z);
    }
    R conductor_pdf(const Vec3<R>& wi) const {
        if (model_.ndf == MaterialModel::Ndf::beckmann)
            return pdf_wi<Beckmann, R>(wo_, wi, p_.alpha_x, p_.alpha_y);
        const bool front = wo_.z > 0;
        if (front && model_.sampling == MaterialModel::Sampling::bounded)
            return ggx_pdf_wi_bounded(wo_, wi, view_, bound_, precision_);
        if (front && model_.sampling == MaterialModel::Sampling::conic) {
            const Vec3<R> h = normalised<R>({wo_.x + wi.x, wo_.y + wi.y, wo_.z + wi.z});
            return wi.z > 0 ? R(Ggx::ndf(h, p_.alpha_x, p_.alpha_y) / (4 * visible_)) : R(0);
        }
        return pdf_wi<Ggx, R>(wo_, wi, p_.alpha_x, p_.alpha_y);
    }

    MaterialModel model_;
    MaterialParameters<R> p_;
    Precision precision_;
    bool behind_;
    Vec3<R> wo_, ng_;
    View<R> view_;
    Bound<R> bound_{};
    R visible_ = 0;
};

}  // namespace vndf::reference
