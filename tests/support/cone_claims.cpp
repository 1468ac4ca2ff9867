#define VNDF_REAL double
#include "vndf/ggx_cone2026.h"

#include <tuple>
#include <utility>

#include "cone_claims.h"
#include "reference/integrals.h"

namespace vndf::claims {
namespace {

struct Vector {
    double x, y, z;
};
Vector unit(const Vector& v) {
    const double length = std::hypot(v.x, v.y, v.z);
    return {v.x / length, v.y / length, v.z / length};
}
// Two directions across l and each other.
std::pair<Vector, Vector> across(const Vector& l) {
    const Vector a = unit(std::abs(l.x) < 0.6 ? Vector{0, -l.z, l.y} : Vector{l.z, 0, -l.x});
    return {a, {l.y * a.z - l.z * a.y, l.z * a.x - l.x * a.z, l.x * a.y - l.y * a.x}};
}
Vector anywhere(Random& random) {
    const double z = 2 * random.uniform() - 1, phi = 2 * VNDF_PI * random.uniform(),
                 s = std::sqrt((1 - z) * (1 + z));
    return {s * std::cos(phi), s * std::sin(phi), z};
}

reference::Distribution distribution(const CapLobe& c) {
    return {"vndf_ggx_pdf_wi_cone2026",
            {.wo = {c.at.x, c.at.y, c.at.z},
             .alpha_x = c.at.alpha_x,
             .alpha_y = c.at.alpha_y,
             .l = {c.lx, c.ly, c.lz},
             .one_minus_cos = c.one_minus_cos},
            reference::Precision::f64};
}
vndf_ggx_cone2026 cone_of(const CapLobe& c) {
    return vndf_ggx_cone2026_lobe({c.at.x, c.at.y, c.at.z}, {c.lx, c.ly, c.lz}, c.one_minus_cos,
                                  {c.at.alpha_x, c.at.alpha_y});
}

}  // namespace

CapLobe random_cap(Random& random, double least_alpha, double most_alpha, bool contained) {
    CapLobe c;
    do c.at = random_lobe(random, least_alpha, most_alpha);
    while (contained && c.at.z < 1e-2);  // quadrature has not enough digits for less
    double beta = random.log_uniform(1e-3, 2);
    Vector l{0, 0, 1};
    const auto kind = random.bits() % 8;
    const Vector off = anywhere(random);
    const double by = kind < 2 ? 0 : random.log_uniform(1e-3, 1);
    if (kind < 4) l = unit({-c.at.x + by * off.x, -c.at.y + by * off.y, c.at.z + by * off.z});
    if (kind > 4) l = off;
    if (contained) {
        if (!(c.at.z + l.z > 0)) l = {0, 0, 1};
        beta = std::min(beta, 0.99 * (VNDF_PI - std::acos(c.at.z) - std::acos(std::min(1.0, l.z))));
    }
    const double half = std::sin(beta / 2);
    c.lx = l.x, c.ly = l.y, c.lz = l.z;
    c.one_minus_cos = kind == 4 ? 1 : 2 * half * half;
    return c;
}

Lost count_lost_in_caps(std::uint64_t directions) {
    std::atomic<std::uint64_t> outside{0};
    std::atomic<double> worst{0};
    for_blocks(directions / samples_of_lobe, [&](Random& random) {
        const CapLobe c = random_cap(random, 1e-3, 4, false);
        const vndf_ggx_cone2026 cone = cone_of(c);
        if (!cone.inside) return;
        const Vector l{c.lx, c.ly, c.lz};
        const auto [a, b] = across(l);
        std::uint64_t bad = 0;
        for (std::uint64_t i = 0; i < samples_of_lobe; ++i) {
            const double share = i % 2 ? random.uniform() : 1 - random.log_uniform(1e-9, 1);
            const double gap = c.one_minus_cos * share, s = std::sqrt(gap * (2 - gap)),
                         phi = 2 * VNDF_PI * random.uniform();
            const double x = s * std::cos(phi), y = s * std::sin(phi), z = 1 - gap;
            const vndf_double3 wi{x * a.x + y * b.x + z * l.x, x * a.y + y * b.y + z * l.y,
                                  x * a.z + y * b.z + z * l.z};
            const vndf_double2 u = vndf_ggx_invert_wi_cone2026_lobe(cone, wi);
            const vndf_double3 back = vndf_ggx_sample_wi_cone2026_lobe(cone, u);
            bad += is_lost(u, wi, back, vndf_ggx_pdf_wi_cone2026_lobe(cone, wi), worst);
        }
        outside += bad;
    });
    return {outside, worst};
}

namespace {

// The integral of D / 4 over the cap: in its polar coordinates, panels halved either way until they agree.
class CapQuadrature {
  public:
    explicit CapQuadrature(const CapLobe& c) : c_(c), l_{c.lx, c.ly, c.lz} { std::tie(a_, b_) = across(l_); }

    double operator()(double about) const {
        double sum = 0;
        for (int i = 0; i < 8; ++i)
            sum += refined(0, 1, i * VNDF_PI / 4, (i + 1) * VNDF_PI / 4, 1e-15 * about, 0);
        return sum;
    }

  private:
    // At a share r of the way to the rim: (r^2 omc is 1 - cos), times what the area has of dr dphi.
    double density(double r, double phi) const {
        const double gap = c_.one_minus_cos * r * r, s = r * std::sqrt(c_.one_minus_cos * (2 - gap));
        const double x = s * std::cos(phi), y = s * std::sin(phi);
        // wo + l + (wi - l), so that nothing is lost where wi is nearly opposite to wo.
        const double hx = c_.at.x + l_.x + (x * a_.x + y * b_.x - gap * l_.x),
                     hy = c_.at.y + l_.y + (x * a_.y + y * b_.y - gap * l_.y),
                     hz = c_.at.z + l_.z + (x * a_.z + y * b_.z - gap * l_.z);
        const double gx = hx / c_.at.alpha_x, gy = hy / c_.at.alpha_y, h2 = hx * hx + hy * hy + hz * hz;
        const double q = (gx * gx + gy * gy + hz * hz) / h2;
        return 2 * c_.one_minus_cos * r / (4 * VNDF_PI * c_.at.alpha_x * c_.at.alpha_y * q * q);
    }
    double panel(double r0, double r1, double p0, double p1) const {
        double sum = 0;
        reference::gauss<15>(r0, r1, [&](double r, double w) {
            reference::gauss<15>(p0, p1, [&](double p, double v) { sum += w * v * density(r, p); });
        });
        return sum;
    }
    double refined(double r0, double r1, double p0, double p1, double tolerance, int depth) const {
        const double whole = panel(r0, r1, p0, p1), r = (r0 + r1) / 2, p = (p0 + p1) / 2;
        const double parts =
            panel(r0, r, p0, p) + panel(r0, r, p, p1) + panel(r, r1, p0, p) + panel(r, r1, p, p1);
        if (std::abs(whole - parts) < tolerance + 1e-15 * whole || depth > 12) return parts;
        return refined(r0, r, p0, p, tolerance / 2, depth + 1) +
               refined(r0, r, p, p1, tolerance / 2, depth + 1) +
               refined(r, r1, p0, p, tolerance / 2, depth + 1) +
               refined(r, r1, p, p1, tolerance / 2, depth + 1);
    }

    const CapLobe& c_;
    Vector l_, a_, b_;
};

}  // namespace

double worst_sigma_cap(std::uint64_t caps) {
    std::atomic<double> worst{0};
    for_blocks(caps, [&](Random& random) {
        const CapLobe c = random_cap(random, 1e-2, 4, true);
        const double sigma = vndf_ggx_sigma_cap({c.at.x, c.at.y, c.at.z}, {c.lx, c.ly, c.lz}, c.one_minus_cos,
                                                {c.at.alpha_x, c.at.alpha_y});
        raise(worst, std::abs(sigma / CapQuadrature(c)(sigma) - 1));
    });
    return worst;
}

double worst_cap_integral(std::uint64_t caps) {
    std::atomic<double> worst{0};
    for_blocks(caps, [&](Random& random) {
        const CapLobe c = random_cap(random, 1e-2, 2, true);
        const vndf_ggx_cone2026 cone = cone_of(c);
        raise(worst, off_one(distribution(c).rule(2), [&](double x, double y, double z) {
                  return vndf_ggx_pdf_wi_cone2026_lobe(cone, {x, y, z});
              }));
    });
    return worst;
}

}  // namespace vndf::claims
