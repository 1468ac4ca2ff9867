// Reflectances and the materials made of them, from their definitions.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <utility>

#include "reference/terms.h"
#include "reference/tilted_maps.h"

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
    if (!(c > 0) || (n < 1 && !(ct > 0))) return R(1);
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

// Beer's law.
template <class R>
R transmittance(const R& distance, const R& sigma) {
    return std::exp(-std::max<R>(distance, 0) * std::max<R>(sigma, 0));
}

// Two terms of Cauchy's formula, a + b / wavelength^2: through eta at the line d, with Abbe's number 20 / dispersion.
template <class R>
R eta_dispersed(const R& eta, const R& dispersion, const R& wavelength) {
    const auto over_square = [](const R& nanometres) { return 1 / (nanometres * nanometres); };
    const R n = within<R>(eta, R(1e-3), 1000), spread = (n - 1) * within<R>(dispersion, 0, 100) / 20,
            f = over_square(R(48613) / 100), c = over_square(R(65627) / 100), d = over_square(R(58756) / 100);
    const R b = spread / (f - c), a = n - b * d;
    return within<R>(a + b * over_square(within<R>(wavelength, 300, 1000)), R(1e-3), 1000);
}

// --- A whole material ---

struct MaterialModel {
    enum class Ndf { ggx, beckmann } ndf = Ndf::ggx;
    enum class Sampling { plain, bounded, conic, tilted } sampling = Sampling::bounded;
    enum class Fresnel { none, conductor, schlick, f82 } fresnel = Fresnel::schlick;
    enum class Masking { correlated, separable } masking = Masking::correlated;
    enum class Energy { none, turquin, kulla_conty } energy = Energy::none;
    enum class Transport { radiance, importance } transport = Transport::radiance;
};

template <class R>
using Rgb = std::array<R, 3>;

template <class R>
struct MaterialParameters {
    R alpha_x, alpha_y;
    Rgb<R> first, second;  // eta and k; f0 and f90, the first channel for all; f0 and f82
    Rgb<R> tint, albedo;
    R metal, ior, transmission;
    Rgb<R> transmittance;
    R diffuse_roughness, coat, coat_alpha;
    Vec3<R> ng;
    R specular = 1;
    Rgb<R> specular_colour{1, 1, 1};
    bool thin_walled = false;
};

// What single scattering loses along wo and wi, both above the surface, and in the mean; and what makes up for it on what glass
// reflects and refracts: given, not derived here.
template <class R>
struct Losses {
    R o = 0, i = 0, average = 0, reflected = 1, refracted = 1;
};

// The mean 2 integral of f(c) c dc by the Gaussian rule of four nodes: the roots of the polynomial of degree 4 that the weight c
// makes orthogonal to all lesser ones, and the integrals of Lagrange's polynomials.
template <class R, class F>
R cosine_mean(F f) {
    const auto polynomial = [](const R& x) { return (((126 * x - 280) * x + 210) * x - 60) * x + 5; };
    const R brackets[5] = {0, R(.25), R(.55), R(.85), 1};
    R node[4], mean = 0;
    for (int i = 0; i < 4; ++i) {
        R low = brackets[i], high = brackets[i + 1];
        for (int step = 0; step < 70; ++step) {
            const R middle = (low + high) / 2;
            (polynomial(middle) * polynomial(low) > 0 ? low : high) = middle;
        }
        node[i] = (low + high) / 2;
    }
    for (int i = 0; i < 4; ++i) {
        // Integrated by Gauss and Legendre's rule of three nodes, exact to the fifth power.
        R share = 0;
        for (int k = -1; k <= 1; ++k) {
            const R x = (1 + k * std::sqrt(R(3) / 5)) / 2;
            R lagrange = 2 * x * (k == 0 ? R(4) / 9 : R(5) / 18);
            for (int j = 0; j < 4; ++j)
                if (j != i) lagrange *= (x - node[j]) / (node[i] - node[j]);
            share += lagrange;
        }
        mean += share * f(node[i]);
    }
    return mean;
}

// f: BSDF times |cos(theta_i)|. Exponent: q of D, and of sigma behind the surface.
template <class R>
struct MaterialValue {
    Rgb<R> f{};
    R pdf = 0, exponent = 0;
    // What a relative change of 1 in the arguments of the reflectance, in the cosines with a refracting facet, in an index that
    // was turned over and in a height makes of f and of the density.
    Rgb<R> slope{};
    R pdf_slope = 0;
    bool settled = true;  // no rounding decides between the sides of a horizon or of a cap
};

// What facets between two media do, for light that is known on the side with index `here` and drawn with another on either.
template <class R>
struct Interface {
    R here, there;
    bool body = false;
    R specular = 1;
    Rgb<R> colour{1, 1, 1};

    R by_index(const R& cosine) const { return fresnel_dielectric<R>(cosine, there / here); }
    R upright() const { return squared((there - here) / (there + here)); }
    // KHR_materials_specular: from specular min(F0 colour, 1) to specular, by the rise of f from F0 to 1.
    R strengthened(const R& f, const R& tint) const {
        const R f0 = std::min<R>(upright() * tint, 1), rise = (f - upright()) / (1 - upright());
        return specular * std::max<R>(f0 + (1 - f0) * rise, 0);
    }
    R reflectance(const R& cosine, const R& tint) const {
        const R f = by_index(cosine);
        // All of it, from inside: nothing can leave.
        return body && there < here && f >= 1 ? R(1) : strengthened(f, tint);
    }
    R brightest() const { return std::max({colour[0], colour[1], colour[2]}); }
    // What does not get in; what is made a probability of, where it is of one facet for all.
    R reflectance(const R& cosine) const { return reflectance(cosine, brightest()); }
    R chance(const R& cosine) const { return reflectance(cosine, std::max<R>(brightest(), 1)); }
    // What the rounding of F and of (colour - 1) F0 / (1 - F0) make of a reflectance.
    R rounding(const R& cosine, const R& tint) const {
        const R moved = std::min<R>(std::abs(tint - 1) * upright() / (1 - upright()), 1);
        return moved == 0 ? R(0) : R(specular * (by_index(cosine) + moved));
    }
    R rounding(const R& cosine) const { return rounding(cosine, brightest()); }

    // Of the normal that refracts wo to wi: -(here wo + there wi), on wo's side.
    Vec3<R> normal(const Vec3<R>& wo, const Vec3<R>& wi) const {
        const Vec3<R> h = normalised<R>(
            {here * wo.x + there * wi.x, here * wo.y + there * wi.y, here * wo.z + there * wi.z});
        return there > here ? Vec3<R>{-h.x, -h.y, -h.z} : h;
    }
    // Walter et al., Equation 17: |d wm / d wi|.
    R jacobian(const R& cos_o, const R& cos_i) const {
        return there * there * cos_i / squared(here * cos_o - there * cos_i);
    }

    // The cosine of the mean visible normal, that of the mean half vector of the cap, whose height is (1 - cos theta) / 2 in the
    // mean.
    static R mean_cosine(const Vec3<R>& wo, const R& ax, const R& ay) {
        if (!(wo.z > 0)) return mean_cosine({wo.x, wo.y, R(0x1p-80)}, ax, ay);
        const Vec3<R> s = normalised<R>({ax * wo.x, ay * wo.y, wo.z});
        const Vec3<R> m = normalised<R>({ax * s.x, ay * s.y, (1 - s.z) / 2 + s.z});
        return dot(wo, m);
    }
    // The probability with which a lobe that is chosen before its normal is a reflection.
    R expected(const R& mean_cosine, const R& ax, const R& ay) const {
        const R rough = ax < ay ? ay : ax;
        return strengthened(by_index(mean_cosine) * (R(63) / 64 - rough / (1 + rough) / 2),
                            std::max<R>(brightest(), 1));
    }
};

// What a smooth interface makes of a diffuse albedo: light that is reflected inwards meets the surface again. Of white paint
// everything leaves that gets in.
template <class R>
struct DiffuseUnder {
    R dense, kept_in, lets_in;  // of diffuse light, from inside and from outside
    DiffuseUnder(const Interface<R>& media, const R& ior) {
        dense = ior < 1 ? 1 / ior : ior;
        const R x = dense - 1;
        const R q = R(2.267723) * x + R(1.27565832) * x * x + R(.22263203) * x * x * x, inwards = q / (1 + q);
        kept_in = media.strengthened(inwards, media.brightest());
        lets_in = 1 - media.strengthened(1 - dense * dense * (1 - inwards), media.brightest());
    }
    R once() const { return lets_in > 0 ? R((1 - kept_in) / lets_in) : R(0); }
    R operator()(const R& albedo) const { return albedo * once() / (1 - albedo * kept_in); }
};

// Oren and Nayar's surface as Fujii improved it, with what it loses between its facets given back as Kulla and Conty do: BSDF times
// pi. Portsmouth, Kutz & Hill 2025.
template <class R>
struct RoughDiffuse {
    R roughness;

    static R c1() { return R(1) / 2 - 2 / (3 * pi<R>()); }
    static R c2() { return R(2) / 3 - 28 / (15 * pi<R>()); }
    R first() const { return 1 / (1 + c1() * roughness); }
    // What one reflection loses along a cosine, over roughness times first(): a fit, and what it fits.
    static R loss(const R& z) {
        if (!(z > 0)) return 0;
        const R s = std::sqrt(1 - z * z),
                s_part = R(-.25498611) + R(.41361677) * z - R(.23334412) * z * z + R(.07417089) * z * z * z;
        return z * (R(.57447239) - R(.28665327) * z + s * s_part);
    }
    static R exact_loss(const R& z) {
        const R s = std::sqrt(1 - z * z),
                g = s * (std::acos(z) - s * z) + 2 * s / 3 * ((1 - s * s * s) / z - 1);
        return c1() - g / pi<R>();
    }
    // cosines, and s = wo . wi less their product. more: to s / t or s, for the single reflection.
    R operator()(const R& albedo, const R& z_o, const R& z_i, const R& s, const R& more = 0) const {
        const R a = first(), single = albedo * a * (1 + roughness * (ratio(z_o, z_i, s) + more));
        return single + again(albedo) * roughness * a * loss(z_o) * loss(z_i) / (c1() - c2());
    }
    // The sum of its terms' sizes, by which rounding counts; products: the size of those that s is the sum of.
    R size(const R& albedo, const R& z_o, const R& z_i, const R& products, const R& more = 0) const {
        const R terms = albedo * (ratio(z_o, z_i, products) + c1() + std::abs(more)) + again(albedo);
        return albedo + 2 * roughness * first() * terms;
    }

  private:
    static R ratio(const R& z_o, const R& z_i, const R& s) { return s > 0 ? s / std::max(z_o, z_i) : s; }
    R again(const R& albedo) const {
        const R mean = first() * (1 + c2() * roughness);
        return albedo * albedo * mean / (1 - albedo * (1 - mean));
    }
};

// The part of a direction's light that a smooth interface keeps inside of a rough surface's single reflection, less than of
// Lambert's: a fit, for the cosine behind the interface.
template <class R>
R kept_inside(const R& z, const R& dense) {
    const R m = std::sqrt(1 - 1 / (dense * dense));
    return m * (R(-.294558) - R(.579601) * m - R(.064052) * m * m + z * (R(1.03267) + R(.725367) * m) -
                R(.737286) * z * z);
}

// The part of the light that a rough layer of index 1.5 reflects along a cosine: a fit.
template <class R>
R coat_albedo(MaterialModel::Ndf ndf, const R& cosine, const R& alpha) {
    const bool ggx = ndf == MaterialModel::Ndf::ggx;
    const R c = within<R>(cosine, 0, 1), a2 = alpha * alpha;
    const R spread = ggx ? R(.3) + R(.7) * alpha + R(5.25) * a2 : R(1.75) - alpha + R(5.6) * a2;
    const R bend = ggx ? 1 + R(.19) * c : 1 - R(.49) * c,
            hidden = ggx ? R(.62) - R(.27) * a2 : R(.36) * a2 - R(.2);
    const R seen = fresnel_dielectric<R>(std::sqrt(c * c + a2 / spread * (1 - c) * bend), R(1.5));
    return within<R>(seen * (1 - a2 * hidden), 0, 1);
}

// A material seen from wo: a conductor by F D G2 / (4 cos(theta_o)), a dielectric by Walter's Equations 20 and 21, Lambert's
// albedo / pi under it, and the rule about sides, each as its definition says it. Surfaces have two sides.
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
        p_.metal = within<R>(p.metal, 0, 1), p_.transmission = within<R>(p.transmission, 0, 1);
        p_.ior = within<R>(p.ior, R(1e-3), 1000);
        const bool body = transmits() && !p.thin_walled;
        inside_ = behind_ && body;
        const R strength = within<R>(p.specular, 0, 1);
        media_ = inside_ ? Interface<R>{p_.ior, 1, body, strength, p.specular_colour}
                         : Interface<R>{1, p_.ior, body, strength, p.specular_colour};
        mean_cosine_ = Interface<R>::mean_cosine(wo_, p_.alpha_x, p_.alpha_y);
        p_.diffuse_roughness = within<R>(p.diffuse_roughness, 0, 1);
        p_.coat = within<R>(p.coat, 0, 1), p_.coat_alpha = within<R>(p.coat_alpha, least, 1);
        // From the denser side of a body all sampling is plain.
        const bool denser = body && media_.there < media_.here;
        // Through a thin wall tilted sampling is conic.
        const bool wall = transmits() && p.thin_walled && model.sampling == MaterialModel::Sampling::tilted;
        base_ = facets(p_.alpha_x, p_.alpha_y,
                       denser ? MaterialModel::Sampling::plain
                       : wall ? MaterialModel::Sampling::conic
                              : model.sampling);
        coat_ = facets(p_.coat_alpha, p_.coat_alpha, model.sampling);
        if (model.energy == MaterialModel::Energy::kulla_conty)
            for (int c = 0; c < 3; ++c) {
                average_[c] = p.tint[c] * cosine_mean<R>([&](const R& x) { return reflectance(c, x); });
                average_slope_[c] =
                    p.tint[c] * cosine_mean<R>([&](const R& x) { return reflectance_slope(c, x); });
            }
    }

    // The density alone, for a fraction of the work.
    R density(const Vec3<R>& direction, const Losses<R>& losses = {}) const {
        MaterialView alone = *this;
        alone.density_alone_ = true;
        return alone(direction, losses).pdf;
    }

    MaterialValue<R> operator()(const Vec3<R>& direction, const Losses<R>& losses = {}) const {
        const Vec3<R> wi = behind_ ? Vec3<R>{direction.x, direction.y, -direction.z} : direction;
        MaterialValue<R> value = !crosses(wi)  ? reflected(wi, losses)
                                 : media_.body ? refracted(wi, losses)
                                               : straight(wi, losses);
        if (inside_ && !moved_ && !density_alone_) add_index_slope(direction, losses, value);
        return moved_ ? value : coated(wi, value);
    }

  private:
    struct Facets {
        R alpha_x, alpha_y;
        View<R> view;
        Bound<R> bound;
        R drawn;        // the area of the cone, where there is one
        R drawn_slope;  // what the rounding of all that it is made of does to it
        MaterialModel::Sampling sampling;
    };
    Facets facets(const R& alpha_x, const R& alpha_y, MaterialModel::Sampling sampling) const {
        const View<R> seen = view(wo_, alpha_x, alpha_y);
        R drawn = 0, slope = 0;
        if (wo_.z > 0 && sampling == MaterialModel::Sampling::conic) drawn = ggx_sigma_visible(seen);
        if (wo_.z > 0 && sampling == MaterialModel::Sampling::tilted) {
            const Tilted<R> cones = tilted(wo_, ng_, alpha_x, alpha_y);
            drawn = cones.sigma();
            if (cones.about_ng()) slope = tilted_slope(alpha_x, alpha_y, drawn);
        }
        return {alpha_x, alpha_y, seen, reference::bound(seen, wo_), drawn, slope, sampling};
    }
    // The sum of |x d(sigma) / dx| / sigma, by differences.
    R tilted_slope(const R& alpha_x, const R& alpha_y, const R& sigma) const {
        const R step = R(1e-7);
        R sum = 0;
        for (int k = 0; k < 8; ++k) {
            const auto moved = [&](const R& factor) {
                Vec3<R> wo = wo_, ng = ng_;
                R x = alpha_x, y = alpha_y;
                R* all[8] = {&wo.x, &wo.y, &wo.z, &ng.x, &ng.y, &ng.z, &x, &y};
                *all[k] *= factor;
                return tilted(wo, ng, x, y).sigma();
            };
            sum += std::abs(moved(1 + step) - moved(1 - step)) / (2 * step * sigma);
        }
        return sum;
    }
    bool crosses(const Vec3<R>& wi) const { return transmits() && wi.z < 0; }

    // --- Under a coat, which lies outside of a body ---

    MaterialValue<R> coated(const Vec3<R>& wi, MaterialValue<R> value) const {
        if (p_.coat == 0) return value;
        const auto kept = [&](const R& cosine) {
            return p_.coat * coat_albedo<R>(model_.ndf, cosine, p_.coat_alpha);
        };
        // Of a part that is let through: what rounding makes of it, its arguments' too.
        const auto slope = [&](const R& cosine) {
            const R z = within<R>(cosine, 0, 1);
            return kept(z) + by_cosine(kept, z) * z + kept_by_alpha(z);
        };
        const bool through = crosses(wi);
        const R chance = inside_ ? R(0) : kept(wo_.z), own = inside_ ? R(0) : slope(wo_.z),
                z = std::abs(wi.z);
        R lets_through = 1 - chance, lets_slope = own;
        if ((through && media_.body) == inside_ && 1 - kept(z) < lets_through)
            lets_through = 1 - kept(z), lets_slope = slope(z);
        for (int c = 0; c < 3; ++c) {
            value.slope[c] = value.slope[c] * lets_through + value.f[c] * lets_slope;
            value.f[c] *= lets_through;
        }
        value.pdf_slope = value.pdf_slope * (1 - chance) + value.pdf * own;
        value.pdf *= 1 - chance;
        if (through || inside_) return value;
        const Vec3<R> h = half(wi);
        const R exponent = this->exponent(h, coat_), pdf = facets_pdf(coat_, wi);
        value.pdf += chance * pdf;
        if (density_alone_) return value;
        value.pdf_slope += (own + chance * (2 * exponent + coat_.drawn_slope)) * pdf;
        const R height_o = dot(wo_, ng_), height_i = dot(wi, ng_);
        value.settled = value.settled && settled(coat_, wi, height_o, height_i);
        if (!(wo_.z > 0) || !(wi.z > 0) || !(height_o > 0) || !(height_i > 0)) return value;
        const R mirror = p_.coat * part(wi, height_i) * mirrored(coat_, h, wi);
        const auto light = [&](const R& cosine) { return mirror * fresnel_dielectric<R>(cosine, R(1.5)); };
        const R cosine = (dot(wo_, h) + dot(wi, h)) / 2, f = light(cosine);
        for (int c = 0; c < 3; ++c) {
            value.f[c] += f;
            value.slope[c] += by_cosine(light, cosine) * cosine + f * (1 / height_i + 2 * exponent);
        }
        return value;
    }
    R kept_by_alpha(const R& cosine) const {
        const R step = R(1e-6);
        const R low = coat_albedo<R>(model_.ndf, cosine, p_.coat_alpha * (1 - step)),
                high = coat_albedo<R>(model_.ndf, cosine, p_.coat_alpha * (1 + step));
        return p_.coat * std::abs(high - low) / (2 * step);
    }

    // --- What a rough diffuse surface has beyond Lambert's, BSDF times pi, under an interface that bends both directions, before it
    // lets them through; and the size of its terms ---

    std::pair<R, R> beyond_lambert(const R& albedo, const Vec3<R>& wi) const {
        if (p_.diffuse_roughness == 0) return {R(0), R(0)};
        // A weaker interface is one that bends less.
        const DiffuseUnder<R> under(media_, p_.ior);
        const R dense = 1 + media_.specular * (under.dense - 1), square = dense * dense;
        const auto bent = [&](const R& z) { return std::sqrt(1 - (1 - z * z) / square); };
        const R o = bent(wo_.z), i = bent(wi.z), x = wo_.x * wi.x / square, y = wo_.y * wi.y / square;
        const R back = dense == 1 ? R(0) : -(kept_inside(o, dense) + kept_inside(i, dense));
        const RoughDiffuse<R> rough{p_.diffuse_roughness};
        const R size = rough.size(albedo, o, i, std::abs(x) + std::abs(y), R(4));
        return {(rough(albedo, o, i, x + y, back) - albedo) * under.once(), size * under.once()};
    }

    // Through a thin wall by the normals of reflections.
    bool by_normal() const {
        return base_.sampling == MaterialModel::Sampling::plain || (transmits() && !media_.body);
    }
    bool transmits() const { return p_.transmission > 0 && p_.metal < 1; }

    // --- Above the surface ---

    MaterialValue<R> reflected(const Vec3<R>& wi, const Losses<R>& losses) const {
        MaterialValue<R> value;
        const Vec3<R> h = half(wi);
        value.exponent = exponent(h);
        // For directions that are unit vectors but for rounding: with either the same.
        const R cosine = (dot(wo_, h) + dot(wi, h)) / 2, mirror_pdf = facets_pdf(base_, wi),
                multiple = p_.metal * multiple_share(losses),
                diffuse_pdf = (diffuse_share() + multiple) * lambert_pdf(wi);
        const auto pdf = [&](const R& c) {
            return (p_.metal - multiple + odds(c, losses).first) * mirror_pdf + diffuse_pdf;
        };
        value.pdf = pdf(cosine);
        if (density_alone_) return value;
        // Of what a smooth interface lets in rounding leaves a part of 1.
        const R unlit =
            (1 - p_.metal) * (1 - p_.transmission) * (lambert_pdf(wi) + mirror_pdf) * smooth_slope(wo_.z);
        value.pdf_slope = by_cosine(pdf, cosine) * cosine + unlit + value.pdf * choice_condition() +
                          (value.pdf - diffuse_pdf) * base_.drawn_slope +
                          (by_normal() ? (1 - p_.metal) * mirror_pdf * odds_rounding(cosine, losses) : R(0));
        const R height_o = dot(wo_, ng_), height_i = dot(wi, ng_);
        value.settled = settled(base_, wi, height_o, height_i) && !opposite(wi);
        if (!(wo_.z > 0) || !(wi.z > 0) || !(height_o > 0) || !(height_i > 0)) return value;
        const R passing = part(wi, height_i);
        const R mirror = mirrored(base_, h, wi);
        const R lets_in = 1 - media_.reflectance(wo_.z), lets_out = 1 - media_.reflectance(wi.z);
        const DiffuseUnder<R> paint(media_, p_.ior);
        for (int c = 0; c < 3; ++c) {
            R scale = passing * p_.metal * p_.tint[c] * mirror;
            const R rest = passing * (1 - p_.metal);
            if (model_.energy == MaterialModel::Energy::turquin)
                scale *= 1 + p_.tint[c] * reflectance(c, R(1)) * losses.o / (1 - losses.o);
            const R colour = media_.colour[c];
            const auto dielectric = [&](const R& x) { return rest * mirror * returned(x, colour, losses); };
            const R white = rest * (1 - p_.transmission) * wi.z / pi<R>();
            const auto [beyond, size] = beyond_lambert(p_.albedo[c], wi);
            const R under = white * (paint(p_.albedo[c]) + beyond);
            const R diffuse = under * lets_in * lets_out;
            value.f[c] = scale * reflectance(c, cosine) + dielectric(cosine) + diffuse;
            value.slope[c] = scale * reflectance_slope(c, cosine) + by_cosine(dielectric, cosine) * cosine +
                             value.f[c] / height_i +
                             under * (lets_in * smooth_slope(wi.z) + lets_out * smooth_slope(wo_.z)) +
                             white * size * lets_in * lets_out +
                             rest * mirror * returned_rounding(cosine, colour, losses) +
                             diffuse * colour_slope();
            if (model_.energy == MaterialModel::Energy::turquin)
                value.slope[c] += scale * reflectance(c, cosine) * losses.o * reflectance_slope(c, R(1));
            if (model_.energy != MaterialModel::Energy::kulla_conty) continue;
            const R lobe = passing * p_.metal * kulla_conty(c, losses) * losses.o * losses.i /
                           kulla_conty_average(losses) * wi.z / pi<R>();
            value.f[c] += lobe;
            value.slope[c] += lobe / height_i + 4 * lobe * average_slope_[c] / average_[c];
        }
        return value;
    }

    // --- Below it ---

    // Through a wall without thickness: a reflection turned to the other side.
    MaterialValue<R> straight(const Vec3<R>& wi, const Losses<R>& losses) const {
        MaterialValue<R> value;
        const Vec3<R> raised{wi.x, wi.y, -wi.z}, h = half(raised);
        value.exponent = exponent(h);
        const R cosine = (dot(wo_, h) + dot(raised, h)) / 2, seen = facets_pdf(base_, raised);
        const auto pdf = [&](const R& c) { return odds(c, losses).second * seen; };
        value.pdf = pdf(cosine);
        if (density_alone_) return value;
        const R unlit = smooth_slope(wo_.z) * (1 - p_.transmission) / p_.transmission;
        // Next to a facet that is seen from its edge 1 - F has few digits.
        const R edge = 1 / cosine;
        value.pdf_slope = by_cosine(pdf, cosine) * cosine + value.pdf * (1 + edge + unlit) +
                          seen * odds_rounding(cosine, losses);
        const R height_o = dot(wo_, ng_), height_i = -dot(wi, ng_);
        value.settled = settled(base_, raised, height_o, height_i) && !opposite(raised);
        if (!(wo_.z > 0) || !(height_o > 0) || !(height_i > 0)) return value;
        const R whole = factors(losses).second * part(raised, height_i) * (1 - p_.metal) * p_.transmission *
                        mirrored(base_, h, raised);
        const auto light = [&](const R& c) { return whole * (1 - media_.reflectance(c)); };
        for (int c = 0; c < 3; ++c) {
            value.f[c] = p_.transmittance[c] * light(cosine);
            value.slope[c] =
                p_.transmittance[c] * (by_cosine(light, cosine) * cosine + whole * media_.rounding(cosine)) +
                value.f[c] * (1 + edge + 1 / height_i);
        }
        return value;
    }

    // Where only a refraction leads.

    MaterialValue<R> refracted(const Vec3<R>& wi, const Losses<R>& losses) const {
        MaterialValue<R> value;
        const R height_o = dot(wo_, ng_), height_i = -dot(wi, ng_);
        value.settled = !level(height_o) && !level(height_i);
        if (p_.ior == 1) return value;  // a delta
        const Vec3<R> h = media_.normal(wo_, wi);
        const R cos_o = dot(wo_, h), cos_i = -dot(wi, h);
        // Next to a facet that is seen from its edge rounding decides.
        if (std::abs(cos_o) < 256 * unit() || std::abs(cos_i) < 256 * unit()) value.settled = false;
        if (!(cos_o > 0) || !(cos_i > 0) || !(h.z > 0)) return value;
        value.exponent = exponent(h);
        const bool ggx = model_.ndf == MaterialModel::Ndf::ggx;
        const R seen = ggx ? pdf_wm<Ggx, R>(wo_, h, p_.alpha_x, p_.alpha_y)
                           : pdf_wm<Beckmann, R>(wo_, h, p_.alpha_x, p_.alpha_y);
        const R jacobian = media_.jacobian(cos_o, cos_i);
        const auto pdf = [&](const R& c) { return odds(c, losses).second * seen * jacobian; };
        value.pdf = pdf(cos_o);
        if (density_alone_) return value;
        // Twice the roundings of a reflection: of its density, and of the cosines with the facet.
        const R edge = 1 / cos_o + 1 / cos_i;
        const R unlit = smooth_slope(wo_.z) * (1 - p_.transmission) / p_.transmission;
        value.pdf_slope = by_cosine(pdf, cos_o) + value.pdf * (1 + edge + choice_condition() + unlit) +
                          (by_normal() ? seen * jacobian * odds_rounding(cos_o, losses) : R(0));
        if (!(wo_.z > 0) || !(height_o > 0) || !(height_i > 0)) return value;
        const Vec3<R> raised{wi.x, wi.y, -wi.z};
        const R facets = ggx ? crossed<Ggx>(h, raised) : crossed<Beckmann>(h, raised);
        // Equation 21, of light from wi (radiance) or to it, times |cos(theta_i)|.
        const R index = model_.transport == MaterialModel::Transport::radiance ? media_.here : media_.there;
        const R bent = cos_o * cos_i / wo_.z * squared(index / (media_.here * cos_o - media_.there * cos_i));
        const R whole = factors(losses).second * part({-wi.x, -wi.y, -wi.z}, height_i) * (1 - p_.metal) *
                        p_.transmission * bent * facets;
        const auto light = [&](const R& c) { return whole * (1 - media_.reflectance(c)); };
        for (int c = 0; c < 3; ++c) {
            value.f[c] = p_.transmittance[c] * light(cos_o);
            value.slope[c] =
                p_.transmittance[c] * (by_cosine(light, cos_o) + whole * media_.rounding(cos_o)) +
                value.f[c] * (1 + edge + 1 / height_i);
        }
        return value;
    }

    // --- Which lobe ---

    R diffuse_share() const { return (1 - p_.metal) * (1 - p_.transmission) * (1 - media_.chance(wo_.z)); }
    // Of a reflection by the dielectric and of a refraction, for facets of this cosine.
    std::pair<R, R> odds(const R& cosine, const Losses<R>& losses) const {
        const auto [back, in] = by_normal() ? std::pair<R, R>{returned(cosine, media_.brightest(), losses),
                                                              1 - media_.reflectance(cosine)}
                                            : expected(losses);
        const R through = in * factors(losses).second * p_.transmission, sum = back + through,
                whole = 1 - p_.metal - diffuse_share();
        return sum > 0 ? std::pair<R, R>{whole * back / sum, whole * through / sum} : std::pair<R, R>{};
    }
    // The same before the normal, with the expected reflectance.
    std::pair<R, R> expected(const Losses<R>& losses) const {
        const R f = media_.expected(mean_cosine_, p_.alpha_x, p_.alpha_y),
                more = media_.specular * f * (factors(losses).first - 1);
        return {f + more, 1 - f};
    }

    // What the rounding of the reflectance makes of that: a b / (a f + b (1 - f))^2 of it.
    R odds_rounding(const R& cosine, const Losses<R>& losses) const {
        const R f = media_.reflectance(cosine);
        const auto [a, b] = factors(losses);
        return media_.rounding(cosine) * a * b / squared(a * f + b * (1 - f));
    }

    // --- What glass gets back ---

    // On what it reflects by its index, and on what it lets through; of a thin wall what makes up for the loss of a mirror. A brighter
    // interface gets back less, and of a weaker one more goes through at once.
    std::pair<R, R> factors(const Losses<R>& losses) const {
        if (model_.energy != MaterialModel::Energy::turquin) return {1, 1};
        if (!media_.body) {
            const R mirrors = 1 / (1 - losses.o);
            return {1 + p_.transmission * (mirrors - 1), mirrors};
        }
        const R upright = media_.upright(), brightest = media_.brightest(),
                moved = within<R>((brightest - 1) * upright / (1 - upright), 0, 1),
                in = 1 - media_.strengthened(upright, brightest),
                weaker = in > 1 - upright ? (1 - upright) / in : R(1);
        return {1 + p_.transmission * (1 - moved) * (losses.reflected - 1), losses.refracted * weaker};
    }
    // Of one facet and of those that follow: by the index, and what a brighter colour reflects beyond that, once.
    R returned(const R& cosine, const R& tint, const Losses<R>& losses) const {
        const R all = media_.reflectance(cosine, tint), by_index = media_.reflectance(cosine, R(1));
        const R own = media_.body ? std::min(all, by_index) : all;
        return all - own + factors(losses).first * own;
    }
    R returned_rounding(const R& cosine, const R& tint, const Losses<R>& losses) const {
        return factors(losses).first * media_.rounding(cosine, tint);
    }

    // --- Conditions ---

    // Of the probability of a lobe that is chosen before its normal, in the cosine by which it is.
    R choice_condition() const {
        if (by_normal()) return R(0);
        const auto chosen = [&](const R& c) { return media_.expected(c, p_.alpha_x, p_.alpha_y); };
        const R f = chosen(mean_cosine_);
        const R moved = by_cosine(chosen, mean_cosine_) * mean_cosine_ + f;
        return (f > 0 ? moved / f : R(0)) + (f < 1 ? moved / (1 - f) : R(0));
    }
    template <class F>
    static R by_cosine(const F& value, const R& cosine) {
        const R step = R(1e-6) * cosine;
        if (step == 0) return 0;
        return std::abs(value(cosine + step) - value(cosine - step)) / (2 * step);
    }
    // Behind the surface 1 / ior is rounded.
    void add_index_slope(const Vec3<R>& direction, const Losses<R>& losses, MaterialValue<R>& value) const {
        const R step = R(1e-7);
        MaterialView low = *this, high = *this;
        low.media_.here *= 1 - step, high.media_.here *= 1 + step;
        low.moved_ = high.moved_ = true;
        const MaterialValue<R> below = low(direction, losses), above = high(direction, losses);
        for (int c = 0; c < 3; ++c) value.slope[c] += std::abs(above.f[c] - below.f[c]) / (2 * step);
        value.pdf_slope += std::abs(above.pdf - below.pdf) / (2 * step);
    }

    // Of what a smooth interface lets through: its own rounding, and what that of the cosine and the index makes of it, which is
    // alike next to total reflection.
    R smooth_slope(const R& cosine) const {
        const auto reflectance = [&](const R& c) { return media_.reflectance(c); };
        const R own = 1 + media_.rounding(cosine);
        return cosine > 0 ? R(own + 2 * by_cosine(reflectance, cosine) * cosine) : own;
    }
    // Of what is not reflected of diffuse light, in (colour - 1) F0 / (1 - F0).
    R colour_slope() const {
        const R upright = media_.upright(), colour = media_.brightest(),
                moved = std::min<R>((colour - 1) * upright / (1 - upright), 1);
        return moved < 1 ? R(std::abs(moved) / (1 - moved)) : R(0);
    }

    R exponent(const Vec3<R>& h) const { return exponent(h, base_); }
    R exponent(const Vec3<R>& h, const Facets& f) const {
        return model_.ndf == MaterialModel::Ndf::beckmann && h.z > 0
                   ? Beckmann::exponent(h, f.alpha_x, f.alpha_y)
                   : R(0);
    }
    // Near the geometric horizon light fades.
    R part(const Vec3<R>& wi, const R& height_i) const {
        const R fade = ng_.z > 0 ? height_i / (wi.z * ng_.z) : R(1);
        return fade < 1 ? fade + fade * fade - fade * fade * fade : R(1);
    }
    // A height is a sum of rounded products, and next to the edge of the bounded cap its density is any of two.
    bool settled(const Facets& f, const Vec3<R>& wi, const R& height_o, const R& height_i) const {
        if (level(height_o) || level(height_i)) return false;
        // Of a wo across ng the cone is either of two.
        if (f.sampling == MaterialModel::Sampling::tilted && std::abs(height_o) < 64 * unit()) return false;
        if (f.sampling != MaterialModel::Sampling::bounded || !(wo_.z > 0)) return true;
        const Margin<R> margin = eto_margin(wo_, wi, f.view, f.bound);
        return std::abs(margin.inside) > 64 * unit() * margin.per_unit;
    }
    // Between opposite directions no facet is told from another.
    bool opposite(const Vec3<R>& wi) const {
        const Vec3<R> sum = sum_with(wi);
        return dot(sum, sum) < squared(256 * unit());
    }
    Vec3<R> sum_with(const Vec3<R>& wi) const { return {wo_.x + wi.x, wo_.y + wi.y, wo_.z + wi.z}; }
    Vec3<R> half(const Vec3<R>& wi) const { return normalised<R>(sum_with(wi)); }
    bool level(const R& height) const { return std::abs(height) < 8 * unit(); }
    R unit() const { return precision_ == Precision::f32 ? R(0x1p-24) : R(0x1p-53); }
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
    // Kulla and Conty's colour, and the average loss that their lobe is divided by: not less than 2^-9.
    R kulla_conty(int c, const Losses<R>& losses) const {
        const R f = average_[c];
        return f * f * (1 - losses.average) / (1 - f * losses.average);
    }
    static R kulla_conty_average(const Losses<R>& losses) {
        return losses.average < R(0x1p-9) ? R(0x1p-9) : losses.average;
    }
    // The share of the brightest channel's light.
    R multiple_share(const Losses<R>& losses) const {
        if (model_.energy != MaterialModel::Energy::kulla_conty) return 0;
        R f = 0, colour = 0;
        for (int c = 0; c < 3; ++c) {
            f = std::max(f, average_[c]);
            colour = std::max(colour, kulla_conty(c, losses));
        }
        const R own = losses.o * colour, whole = own + f * (1 - losses.o);
        return whole > 0 ? own / whole : R(0);
    }
    // D G2 / (4 cos(theta_o))
    R mirrored(const Facets& f, const Vec3<R>& h, const Vec3<R>& wi) const {
        return model_.ndf == MaterialModel::Ndf::ggx ? mirrored<Ggx>(f, h, wi) : mirrored<Beckmann>(f, h, wi);
    }
    template <class N>
    R mirrored(const Facets& f, const Vec3<R>& h, const Vec3<R>& wi) const {
        const View<R> i = view(wi, f.alpha_x, f.alpha_y);
        const R masked = model_.masking == MaterialModel::Masking::correlated ? g2<N>(f.view, i)
                                                                              : R(g1<N>(f.view) * g1<N>(i));
        return N::template ndf<R>(h, f.alpha_x, f.alpha_y) * masked / (4 * wo_.z);
    }
    // D G1 G1
    template <class N>
    R crossed(const Vec3<R>& h, const Vec3<R>& raised) const {
        return N::template ndf<R>(h, p_.alpha_x, p_.alpha_y) * g1<N>(base_.view) *
               g1<N>(view(raised, p_.alpha_x, p_.alpha_y));
    }
    R facets_pdf(const Facets& f, const Vec3<R>& wi) const {
        if (model_.ndf == MaterialModel::Ndf::beckmann)
            return pdf_wi<Beckmann, R>(wo_, wi, f.alpha_x, f.alpha_y);
        const bool front = wo_.z > 0;
        if (front && f.sampling == MaterialModel::Sampling::bounded)
            return ggx_pdf_wi_bounded(wo_, wi, f.view, f.bound, precision_);
        const bool tilted = f.sampling == MaterialModel::Sampling::tilted;
        if (front && (tilted || f.sampling == MaterialModel::Sampling::conic)) {
            const bool above = wi.z > 0 && (!tilted || dot(wi, ng_) > 0);
            return above ? R(Ggx::ndf(half(wi), f.alpha_x, f.alpha_y) / (4 * f.drawn)) : R(0);
        }
        return pdf_wi<Ggx, R>(wo_, wi, f.alpha_x, f.alpha_y);
    }

    MaterialModel model_;
    MaterialParameters<R> p_;
    Precision precision_;
    bool behind_, inside_ = false, moved_ = false, density_alone_ = false;
    Vec3<R> wo_, ng_;
    Interface<R> media_{};
    Facets base_{}, coat_{};
    Rgb<R> average_{}, average_slope_{};  // reflectances, by the cosine law
    R mean_cosine_ = 1;
};

}  // namespace vndf::reference
