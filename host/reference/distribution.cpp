// One density's lobe, and its pivots (stretched.h has the formulas).
#include "reference/distribution.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "reference/cap_maps.h"
#include "reference/integrals.h"
#include "reference/terms.h"
#include "reference/tilted_maps.h"

namespace vndf::reference {
namespace {

Vec3d plain(const Vec3<double>& v) {
    return {v.x, v.y, v.z};
}

double clip(double p) {
    return p > 0 ? p < 1 ? p : 1 : 0;  // NaN: 0
}

Vec3<double> vec3(const Vec3d& v) {
    return {v.x, v.y, v.z};
}

// The mirror image of wo about a visible normal.
Sample<double> ggx_reflection(const Arguments<double>& in) {
    return {reflect(in.wo, ggx_dupuy2023(in).direction), 0};
}
Sample<double> beckmann_reflection(const Arguments<double>& in) {
    return {reflect(in.wo, beckmann_jakob2014(in).direction), 0};
}

Sample<double> ggx_reflection_about_n(const Arguments<double>& in) {
    return {reflect(in.wo, ggx_benyoub2024(in).direction), 0};
}
// In a frame of n.
Sample<double> beckmann_about_n(const Arguments<double>& in) {
    const Frame<double> f = frame(in.n);
    Arguments<double> local = in;
    local.wo = to_local(f, in.wo);
    return {to_world(f, beckmann_jakob2014(local).direction), 0};
}
Sample<double> beckmann_reflection_about_n(const Arguments<double>& in) {
    return {reflect(in.wo, beckmann_about_n(in).direction), 0};
}

}  // namespace

struct Distribution::Known {
    std::string_view density;
    Kind kind;  // in front of the surface
    enum class Variable { wm, wm_world, wm_plain, wi, wi_world } variable;
    Sample<double> (*map)(const Arguments<double>&);  // draws from it
    bool polygon = false;                             // the bound of the cap
};

const Distribution::Known& Distribution::known(std::string_view density) {
    using enum Known::Variable;
    static const Known all[] = {
        {"vndf_ggx_pdf_wm", Kind::ggx, wm, ggx_dupuy2023<double>},
        {"vndf_ggx_pdf_wm_lobe", Kind::ggx, wm, ggx_dupuy2023<double>},
        {"vndf_ggx_pdf_wi", Kind::ggx, wi, ggx_reflection},
        {"vndf_ggx_pdf_wi_lobe", Kind::ggx, wi, ggx_reflection},
        {"vndf_ggx_pdf_wm_benyoub2024", Kind::ggx, wm_world, ggx_benyoub2024<double>},
        {"vndf_ggx_pdf_wi_eto2023", Kind::bounded, wi, ggx_eto2023<double>},
        {"vndf_ggx_pdf_wi_eto2023_lobe", Kind::bounded, wi, ggx_eto2023<double>},
        {"vndf_ggx_pdf_wi_eto2023_polygon", Kind::bounded, wi, ggx_eto2023_polygon<double>, true},
        {"vndf_ggx_pdf_wi_eto2023_polygon_lobe", Kind::bounded, wi, ggx_eto2023_polygon<double>, true},
        {"vndf_ggx_pdf_wi_conic2026", Kind::conic, wi, ggx_conic2026<double>},
        {"vndf_ggx_pdf_wi_conic2026_lobe", Kind::conic, wi, ggx_conic2026<double>},
        {"vndf_ggx_pdf_wi_cone2026", Kind::cone, wi, ggx_cone2026<double>},
        {"vndf_ggx_pdf_wi_cone2026_lobe", Kind::cone, wi, ggx_cone2026<double>},
        {"vndf_ggx_pdf_wi_tilted2026", Kind::lune, wi, ggx_tilted2026<double>},
        {"vndf_ggx_pdf_wi_tilted2026_lobe", Kind::lune, wi, ggx_tilted2026<double>},
        {"vndf_ggx_pdf_wm_walter2007", Kind::ggx, wm_plain, ggx_walter2007<double>},
        {"vndf_beckmann_pdf_wm", Kind::beckmann, wm, beckmann_jakob2014<double>},
        {"vndf_beckmann_pdf_wm_lobe", Kind::beckmann, wm, beckmann_jakob2014<double>},
        {"vndf_beckmann_pdf_wi", Kind::beckmann, wi, beckmann_reflection},
        {"vndf_beckmann_pdf_wi_lobe", Kind::beckmann, wi, beckmann_reflection},
        {"vndf_ggx_pdf_wm_world", Kind::ggx, wm_world, ggx_benyoub2024<double>},
        {"vndf_ggx_pdf_wi_world", Kind::ggx, wi_world, ggx_reflection_about_n},
        // By cosines the normals stand for the reflections.
        {"vndf_ggx_pdf_wm_cosines", Kind::ggx, wm, ggx_dupuy2023<double>},
        {"vndf_ggx_pdf_wi_cosines", Kind::ggx, wm, ggx_dupuy2023<double>},
        {"vndf_beckmann_pdf_wm_world", Kind::beckmann, wm_world, beckmann_about_n},
        {"vndf_beckmann_pdf_wi_world", Kind::beckmann, wi_world, beckmann_reflection_about_n},
        {"vndf_beckmann_pdf_wm_cosines", Kind::beckmann, wm, beckmann_jakob2014<double>},
        {"vndf_beckmann_pdf_wi_cosines", Kind::beckmann, wm, beckmann_jakob2014<double>},
        {"vndf_beckmann_pdf_wm_walter2007", Kind::beckmann, wm_plain, beckmann_walter2007<double>},
    };
    const auto at =
        std::find_if(std::begin(all), std::end(all), [&](const Known& k) { return k.density == density; });
    if (at == std::end(all)) throw std::invalid_argument("no distribution for " + std::string(density));
    return *at;
}

Distribution::Distribution(std::string_view density, const Lobe& lobe, Precision precision)
    : known_(known(density)), precision_(precision), lobe_(lobe) {
    using enum Known::Variable;
    reflected_ = known_.variable == wi || known_.variable == wi_world;
    world_ = known_.variable == wm_world || known_.variable == wi_world;
    const auto raised = [&](double a) {
        return std::max(a, precision == Precision::f32 ? double(1e-8f) : 1e-8);
    };
    lobe_.alpha_x = alpha_x_ = raised(lobe.alpha_x);
    lobe_.alpha_y = alpha_y_ = raised(lobe.alpha_y);

    // The plain NDF times the cosine is what a view along the normal sees.
    Vec3<double> wo = known_.variable == wm_plain ? Vec3<double>{0, 0, 1} : normalised<double>(vec3(lobe.wo));
    lobe_.wo = plain(wo);
    Frame<double> f{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    if (world_) {
        f = frame(normalised<double>(vec3(lobe.n)));
        wo = to_local(f, wo);
    }
    frame_ = {plain(f.t1), plain(f.t2), plain(f.n)};
    lobe_.n = frame_[2];
    wo_ = plain(wo);

    const View<double> v = view(wo, alpha_x_, alpha_y_);
    ex_ = v.ex, ey_ = v.ey, length_ = v.length, sin_ = v.sin_theta, cos_ = v.cos_theta;
    sigma_ = std::pow(std::sin(v.nu / 2), 2);
    tan_half_ = std::sin(v.theta / 2) / std::sin(v.nu / 2);
    const bool behind = !(wo.z > 0);  // where every reflection is that of the plain cap
    kind_ = known_.kind;
    if (behind && ndf_of(kind_) == Ndf::ggx && !by_form()) kind_ = Kind::ggx;
    const Slopes<double> s = beckmann_slopes(v.sin_theta, v.cos_theta);
    a_ = s.a, weight_ = s.weight;
    const Bound<double> b = known_.polygon ? polygon_bound(v, wo) : bound(v, wo);
    k_ = b.k, gap_ = b.gap, cap_ = b.up / 2;
    if (kind_ == Kind::conic) {
        k_ = 0, cap_ = visible_area();
        tabulate_azimuths();
    }
    if (by_form()) {
        if (kind_ == Kind::cone)
            find_cone(lobe_.l, lobe_.one_minus_cos);
        else
            find_cone(lobe_.ng, 1), find_corners();
        cap_ = 1;
        tabulate_azimuths();
        cap_ = mass_.back();
        for (std::size_t i = 0; i < mass_.size(); ++i) mass_[i] /= cap_, slope_[i] /= cap_;
    }
    if (kind_ == Kind::lune)
        kept_ = sigma_tilted() / tilted(wo, normalised<double>(vec3(lobe_.ng)), alpha_x_, alpha_y_).sigma();
}

// The form of the cone in the slopes (x, y, 1), and its range of azimuths: all if it holds the normal of the surface.
void Distribution::find_cone(const Vec3d& axis, double one_minus_cos) {
    const Light<double> cap = light_of<double>(vec3(axis), one_minus_cos, precision_);
    double q[3][3];
    cap_matrix(light_view<double>(vec3(wo_), cap, alpha_x_, alpha_y_), q);
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) q_[i][j] = q[i][j];
    if (q[2][2] > 0) return;
    // The discriminant of the form along an azimuth is a form of its cosine and sine.
    const double xx = q[0][2] * q[0][2] - q[0][0] * q[2][2], yy = q[1][2] * q[1][2] - q[1][1] * q[2][2],
                 xy = q[0][2] * q[1][2] - q[0][1] * q[2][2];
    const double swing = std::hypot(xx - yy, 2 * xy);
    if (xx + yy > swing) return;  // it holds the opposite of that normal
    middle_ = std::atan2(2 * xy, xx - yy) / 2;
    half_ = std::acos(std::clamp(-(xx + yy) / swing, -1., 1.)) / 2;
    if (q[0][2] * std::cos(middle_) + q[1][2] * std::sin(middle_) < 0) middle_ += middle_ > 0 ? -pi_d : pi_d;
}

// The normals that reflect along both horizons.
void Distribution::find_corners() {
    const Vec3d& g = lobe_.ng;
    const double size = std::hypot(g.x, g.y);
    for (int i = 0; i < 2 && size > 0; ++i) {
        const double side = i == 0 ? 1 / size : -1 / size;
        corners_[i] = std::atan2((wo_.y + side * g.x) / alpha_y_, (wo_.x - side * g.y) / alpha_x_);
    }
    // A cone that is in part below the horizon: of both nappes the one that faces wo.
    if (half_ > 0 && std::cos(corners_[0] - middle_) < 0) middle_ += middle_ > 0 ? -pi_d : pi_d;
}

// Of a cone that does not hold the normal of the surface the density ends as a root: not so in the sine's argument.
double Distribution::azimuth_of(double place) const {
    return half_ > 0 ? middle_ + half_ * std::sin(place) : place;
}
double Distribution::place_of(double phi) const {
    if (!(half_ > 0)) return phi;
    const double off = phi - middle_;
    return std::asin(std::clamp((off - 2 * pi_d * std::round(off / (2 * pi_d))) / half_, -1., 1.));
}

// The area inside the horizon's curve, seen along the stretched wo, in units of pi. The normals that reflect to the horizon
// are the half vectors g of v and (cos phi, sin phi, 0), stretched back:
//     length area = 1 / (2 pi) * integral of v . (g x g') / |g|^2 dphi.
// |g| has its least values, as narrow as alpha z, near -wo: azimuths are counted from there, and panels graded towards
// them.
double Distribution::visible_area() const {
    const double x = wo_.x, y = wo_.y, z = wo_.z, x2 = alpha_x_ * alpha_x_, y2 = alpha_y_ * alpha_y_;
    const double sine = std::sqrt(x * x + y * y), less = z * z / (1 + sine), opposite = std::atan2(-y, -x);
    struct Half {
        double c, s;  // of the azimuth
        double x, y;  // wo + (c, s, 0)
    };
    const auto half_at = [&](double turn) {
        const double middle = opposite + turn / 2, chord = 2 * std::sin(turn / 2);
        return Half{std::cos(opposite + turn), std::sin(opposite + turn),
                    less * std::cos(opposite) - chord * std::sin(middle),
                    less * std::sin(opposite) + chord * std::cos(middle)};
    };
    // A least value is where the derivative changes its sign, between points graded towards -wo and the axes, where two
    // can be close together.
    const auto rising = [&](double turn) {
        const Half h = half_at(turn);
        return h.y / y2 * h.c - h.x / x2 * h.s > 0;
    };
    const auto once = [](double turn) { return turn - 2 * pi_d * std::round(turn / (2 * pi_d)); };
    const auto grade = [&](std::vector<double>& into, double at) {
        into.push_back(once(at));
        for (double d = pi_d / 2; d > 1e-17; d /= 2) into.insert(into.end(), {once(at - d), once(at + d)});
    };
    std::vector<double> points{-pi_d, pi_d};
    grade(points, 0);
    for (int i = 0; i < 4; ++i) grade(points, i * pi_d / 2 - opposite);
    std::sort(points.begin(), points.end());
    std::vector<double> breaks = points;
    for (std::size_t i = 0; i + 1 < points.size(); ++i) {
        double low = points[i], high = points[i + 1];
        if (rising(low) || !rising(high)) continue;
        for (int step = 0; step < 60; ++step) (rising((low + high) / 2) ? high : low) = (low + high) / 2;
        grade(breaks, low);
    }
    std::sort(breaks.begin(), breaks.end());
    double area = 0;
    for (std::size_t i = 0; i + 1 < breaks.size(); ++i) {
        if (!(breaks[i] < breaks[i + 1])) continue;
        gauss<10>(breaks[i], breaks[i + 1], [&](double turn, double weight) {
            const Half h = half_at(turn);
            const double gx = h.x / alpha_x_, gy = h.y / alpha_y_, half_sine = std::sin(turn / 2);
            const double along = less + 2 * sine * half_sine * half_sine - x2 * x * h.c - y2 * y * h.s;
            area += weight * along / (alpha_x_ * alpha_y_ * (gx * gx + gy * gy + z * z));
        });
    }
    return z * area / (2 * pi_d) / length_;
}

// The distribution function of the stretched azimuth, from the closed integral over the polar angle.
void Distribution::tabulate_azimuths() {
    const double start = half_ > 0 ? -pi_d / 2 : -pi_d, end = half_ > 0 ? pi_d / 2 : pi_d;
    std::vector<double> edges{start, end};
    for (const double at : azimuth_breaks()) {
        const double place = place_of(at);
        if (place > start && place < end) edges.push_back(place);
    }
    std::sort(edges.begin(), edges.end());
    const std::vector<double> whole{std::numeric_limits<double>::infinity()};
    const auto density = [&](double place) {
        double mass;
        cumulative(azimuth_of(place), whole, &mass);
        return half_ > 0 ? mass * half_ * std::cos(place) : mass;
    };
    azimuth_ = {start}, mass_ = {0}, slope_ = {density(start)};
    for (std::size_t i = 0; i + 1 < edges.size(); ++i) {
        constexpr int parts = 8;
        for (int j = 0; j < parts && edges[i] < edges[i + 1]; ++j) {
            const double a = edges[i] + (edges[i + 1] - edges[i]) * j / parts,
                         b = edges[i] + (edges[i + 1] - edges[i]) * (j + 1) / parts;
            double sum = mass_.back();
            gauss<10>(a, b, [&](double phi, double weight) { sum += weight * density(phi); });
            azimuth_.push_back(b), mass_.push_back(sum), slope_.push_back(density(b));
        }
    }
}

// --- Pivots ---

// GGX: F(beta) and the semicircle's distribution function of t. Beckmann: the distribution functions of the two
// slopes. Bounded: azimuth and height of the stretched reflection, uniform on its cap. Conic: the distribution functions
// of the stretched azimuth and, given it, of the polar angle.
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
        } else if constexpr (kind == Kind::conic || kind == Kind::cone || kind == Kind::lune) {
            const double azimuth = std::atan2(gy, gx), phi = place_of(azimuth);
            const auto above = std::upper_bound(azimuth_.begin() + 1, azimuth_.end() - 1, phi);
            const std::size_t j = static_cast<std::size_t>(above - azimuth_.begin()) - 1;
            const double h = azimuth_[j + 1] - azimuth_[j], t = (phi - azimuth_[j]) / h, r = 1 - t;
            p1[i] = clip(mass_[j] * r * r * (1 + 2 * t) + mass_[j + 1] * t * t * (1 + 2 * r) +
                         h * t * r * (slope_[j] * r - slope_[j + 1] * t));
            p2[i] = clip(share_below(azimuth, std::sqrt(gx * gx + gy * gy) / gz));
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
        case Kind::conic:
            return pivots_of<T, Kind::conic>(n, x, y, z, p1, p2);
        case Kind::cone:
            return pivots_of<T, Kind::cone>(n, x, y, z, p1, p2);
        case Kind::lune:
            return pivots_of<T, Kind::lune>(n, x, y, z, p1, p2);
        case Kind::beckmann:
            return pivots_of<T, Kind::beckmann>(n, x, y, z, p1, p2);
    }
}
template void Distribution::pivots(std::size_t, const float*, const float*, const float*, double*,
                                   double*) const;
template void Distribution::pivots(std::size_t, const double*, const double*, const double*, double*,
                                   double*) const;

std::array<double, 3> Distribution::draw(double u1, double u2) const {
    Arguments<double> in;
    in.wo = vec3(lobe_.wo), in.n = vec3(lobe_.n);
    in.alpha_x = alpha_x_, in.alpha_y = alpha_y_;
    in.u1 = u1, in.u2 = u2, in.v1 = 1 - u1, in.v2 = 1 - u2;
    in.least_u = precision_ == Precision::f32 ? 0x1p-33 : 0x1p-65;
    in.rotation = 0;
    const Light<double> cap = light_of<double>(vec3(lobe_.l), lobe_.one_minus_cos, precision_);
    in.l = cap.l, in.one_minus_cos = cap.one_minus_cos, in.cap_part = cap.part;
    in.ng = normalised<double>(vec3(lobe_.ng));
    const Vec3<double> d = known_.map(in).direction;
    return {d.x, d.y, d.z};
}

double Distribution::pivot_rounding() const {
    double worst = 0;
    for (const double u1 : {0.2, 0.5, 0.8})
        for (const double u2 : {0.2, 0.5, 0.8}) {
            std::array<double, 3> d = draw(u1, u2);
            if (is_lost(d)) continue;
            double p[2] = {}, q[2] = {};
            pivots(1, &d[0], &d[1], &d[2], &p[0], &p[1]);
            for (int i = 0; i < 3; ++i) {
                const double exact = d[i];
                d[i] += exact * 0x1p-24;
                pivots(1, &d[0], &d[1], &d[2], &q[0], &q[1]);
                d[i] = exact;
                for (int j = 0; j < 2; ++j) {
                    const double change = std::abs(p[j] - q[j]);
                    worst = std::max(worst,
                                     (kind_ == Kind::bounded || kind_ == Kind::conic || by_form()) && j == 0
                                         ? std::min(change, 1 - change)
                                         : change);
                }
            }
        }
    return worst;
}

}  // namespace vndf::reference
