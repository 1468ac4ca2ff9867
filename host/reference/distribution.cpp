// One sampler's lobe, and its pivots (stretched.h has the formulas).
#include "reference/distribution.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "reference/integrals.h"
#include "reference/terms.h"

namespace vndf::reference {
namespace {

struct Known {
    std::string_view sampler;
    bool beckmann, walter, world, reflected;
};
constexpr Known known[] = {
    {"vndf_ggx_sample_wm_heitz_deon2014", false, false, false, false},
    {"vndf_ggx_sample_wm_heitz_deon2014_exact", false, false, false, false},
    {"vndf_ggx_sample_wm_heitz2017", false, false, false, false},
    {"vndf_ggx_sample_wm_heitz2018", false, false, false, false},
    {"vndf_ggx_sample_wm_dupuy2023", false, false, false, false},
    {"vndf_ggx_sample_wm_benyoub2024", false, false, true, false},
    {"vndf_ggx_sample_wi_eto2023", false, false, false, true},
    {"vndf_ggx_sample_wm_walter2007", false, true, false, false},
    {"vndf_beckmann_sample_wm_heitz_deon2014", true, false, false, false},
    {"vndf_beckmann_sample_wm_jakob2014", true, false, false, false},
    {"vndf_beckmann_sample_wm_walter2007", true, true, false, false},
};

Vec3d plain(const Vec3<double>& v) {
    return {v.x, v.y, v.z};
}

double clip(double p) {
    return p > 0 ? p < 1 ? p : 1 : 0;  // NaN: 0
}

}  // namespace

Distribution::Distribution(std::string_view sampler, const double* in, Precision precision)
    : precision_(precision) {
    constexpr std::string_view suffix = "_with_pdf";
    if (sampler.size() > suffix.size() && sampler.substr(sampler.size() - suffix.size()) == suffix)
        sampler.remove_suffix(suffix.size());
    const auto at = std::find_if(std::begin(known), std::end(known),
                                 [&](const Known& k) { return k.sampler == sampler; });
    if (at == std::end(known)) throw std::invalid_argument("no distribution for " + std::string(sampler));
    sampler_ = at->sampler;
    in_.assign(in, in + (at->walter ? 4 : at->world ? 9 : 7));
    reflected_ = at->reflected;
    world_ = at->world;

    const double* alpha = in + (at->walter ? 0 : at->world ? 6 : 3);
    const auto raised = [&](double a) {
        return std::max(a, precision == Precision::f32 ? double(1e-8f) : 1e-8);
    };
    alpha_x_ = raised(alpha[0]);
    alpha_y_ = raised(alpha[at->world ? 0 : 1]);

    // The plain NDF times the cosine is what a view along the normal sees.
    Vec3<double> wo = at->walter ? Vec3<double>{0, 0, 1} : normalised<double>({in[0], in[1], in[2]});
    Frame<double> f{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    if (world_) {
        f = frame(normalised<double>({in[3], in[4], in[5]}));
        wo = to_local(f, wo);
    }
    frame_ = {plain(f.t1), plain(f.t2), plain(f.n)};
    wo_ = plain(wo);

    const View<double> v = view(wo, alpha_x_, alpha_y_);
    ex_ = v.ex, ey_ = v.ey, length_ = v.length, sin_ = v.sin_theta, cos_ = v.cos_theta;
    sigma_ = std::pow(std::sin(v.nu / 2), 2);
    tan_half_ = std::sin(v.theta / 2) / std::sin(v.nu / 2);
    kind_ = at->beckmann ? Kind::beckmann : reflected_ && wo.z > 0 ? Kind::bounded : Kind::ggx;
    const Slopes<double> s = beckmann_slopes(v.sin_theta, v.cos_theta);
    a_ = s.a, weight_ = s.weight;
    const Bound<double> b = bound(alpha_x_, alpha_y_, hypotenuse(wo.x, wo.y), wo.z);
    k_ = b.k, gap_ = b.gap, cap_ = (1 + k_ * cos_) / 2;
}

// --- Pivots ---

// GGX: F(beta) and the semicircle's distribution function of t. Beckmann: the distribution functions of the two
// slopes. Bounded: azimuth and height of the stretched reflection, uniform on its cap.
template <class T, Distribution::Kind kind>
void Distribution::pivots_of(std::size_t n, const T* x, const T* y, const T* z, double* p1,
                             double* p2) const {
    const double rcp_x = 1 / alpha_x_, rcp_y = 1 / alpha_y_;
    for (std::size_t i = 0; i < n; ++i) {
        const Vec3d m = half(x[i], y[i], z[i]);
        const double gx = m.x * rcp_x, gy = m.y * rcp_y, gz = m.z;
        if constexpr (kind == Kind::bounded) {
            // o = 2 (m . v) m - v with v the stretched wo, wo . h = |h|^2 / 2
            const double s = (m.x * m.x + m.y * m.y + m.z * m.z) / ((gx * gx + gy * gy + gz * gz) * length_);
            const double ox = s * gx - sin_ * ex_, oy = s * gy - sin_ * ey_;
            const double turn = std::atan2(oy, ox) / (2 * pi_d);
            p1[i] = clip(turn < 0 ? turn + 1 : turn);
            p2[i] = clip((1 + cos_ - s * gz) / (2 * cap_));
        } else {
            const double ge = gx * ex_ + gy * ey_, gp = gy * ex_ - gx * ey_;
            if constexpr (kind == Kind::ggx) {
                const double slice = std::sqrt(ge * ge + gz * gz), square = slice * slice + gp * gp;
                const double cosine = slice > 0 ? ge / slice : 1, sine = slice > 0 ? gz / slice : 0;
                // Half of beta; F = 1 - (cos(beta / 2) - tan(theta / 2) sin(beta / 2))^2.
                const double large = std::sqrt(0.5 * (1 + std::abs(cosine))), small = 0.5 * sine / large;
                const double c = cosine > 0 ? large : std::abs(small),
                             s = cosine > 0 ? small : std::copysign(large, sine);
                const double rest = c - tan_half_ * s;
                p1[i] = clip(rest > 0 ? 1 - rest * rest : 1);
                p2[i] = clip(0.5 + (std::atan2(gp, slice) + gp * slice / square) / pi_d);
            } else {
                const bool up = gz > 0;
                const double sx = up ? -ge / gz : std::copysign(1e300, -ge),
                             sy = up ? -gp / gz : std::copysign(1e300, -gp);
                p2[i] = clip(0.5 * std::erfc(-sy));
                if (sx >= a_) {
                    p1[i] = 1;
                } else if (a_ < 0) {
                    const auto tail = quick_tail(-sx);
                    const double d = a_ - sx;
                    p1[i] = clip(std::exp(-d * (d - 2 * a_)) * (d * tail.mass + tail.first) / weight_);
                } else {
                    p1[i] = clip((a_ * std::erfc(-sx) + std::exp(-sx * sx) / root_pi) / weight_);
                }
            }
        }
    }
}

template <class T>
void Distribution::pivots(std::size_t n, const T* x, const T* y, const T* z, double* p1, double* p2) const {
    switch (kind_) {
        case Kind::ggx:
            return pivots_of<T, Kind::ggx>(n, x, y, z, p1, p2);
        case Kind::bounded:
            return pivots_of<T, Kind::bounded>(n, x, y, z, p1, p2);
        case Kind::beckmann:
            return pivots_of<T, Kind::beckmann>(n, x, y, z, p1, p2);
    }
}
template void Distribution::pivots(std::size_t, const float*, const float*, const float*, double*,
                                   double*) const;
template void Distribution::pivots(std::size_t, const double*, const double*, const double*, double*,
                                   double*) const;

double Distribution::pivot_rounding() const {
    const auto evaluate = find_evaluation<double>(sampler_);
    double worst = 0;
    for (const double u1 : {0.2, 0.5, 0.8})
        for (const double u2 : {0.2, 0.5, 0.8}) {
            std::vector<double> in = in_;
            in[in.size() - 2] = u1, in[in.size() - 1] = u2;
            double d[3], p[2] = {}, q[2] = {};
            evaluate(in.data(), d, precision_);
            pivots(1, &d[0], &d[1], &d[2], &p[0], &p[1]);
            for (int i = 0; i < 3; ++i) {
                const double exact = d[i];
                d[i] += exact * 0x1p-24;
                pivots(1, &d[0], &d[1], &d[2], &q[0], &q[1]);
                d[i] = exact;
                for (int j = 0; j < 2; ++j) {
                    const double change = std::abs(p[j] - q[j]);
                    worst = std::max(
                        worst, kind_ == Kind::bounded && j == 0 ? std::min(change, 1 - change) : change);
                }
            }
        }
    return worst;
}

}  // namespace vndf::reference
