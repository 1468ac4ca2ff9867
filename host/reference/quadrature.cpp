// Quadrature by the density, in the variables in which it is smooth; moments.
#include <limits>

#include "reference/integrals.h"

namespace vndf::reference {

// A normal of slopes, its share of the stretched solid angle and of the probability.
struct Distribution::Node {
    double x, y;  // stretched slopes of the normal (x, y, 1)
    double area;  // dx dy
    double probability;
};

// dm = dx dy m_z^3 in stretched space; unstretching and reflecting bring their Jacobians.
void Distribution::add(const Node& node, QuadratureRule& rule) const {
    double x = alpha_x_ * node.x, y = alpha_y_ * node.y;
    const double length = std::sqrt(1 + x * x + y * y);
    x /= length, y /= length;
    double z = 1 / length, weight = node.area * alpha_x_ * alpha_y_ * z * z * z;
    if (reflected_) {
        const double cosine = wo_.x * x + wo_.y * y + wo_.z * z;
        weight *= 4 * std::abs(cosine);
        x = 2 * cosine * x - wo_.x, y = 2 * cosine * y - wo_.y, z = 2 * cosine * z - wo_.z;
    }
    const std::array<Vec3d, 3>& f = frame_;
    rule.x.push_back(world_ ? f[0].x * x + f[1].x * y + f[2].x * z : x);
    rule.y.push_back(world_ ? f[0].y * x + f[1].y * y + f[2].y * z : y);
    rule.z.push_back(world_ ? f[0].z * x + f[1].z * y + f[2].z * z : z);
    rule.weight.push_back(weight);
    rule.probability.push_back(node.probability);
}

// The azimuths at which there begins or ceases to be something, found between such as are half a degree apart.
std::vector<double> Distribution::edges() const {
    const auto something = [&](double phi) {
        const Range in = range(phi);
        return in.lo < in.hi;
    };
    constexpr int parts = 720;
    std::vector<double> found;
    for (int i = 0; i < parts; ++i) {
        double a = 2 * pi_d * i / parts, b = 2 * pi_d * (i + 1) / parts;
        const bool first = something(a);
        if (first == something(b)) continue;
        for (int k = 0; k < 60; ++k) {
            const double middle = (a + b) / 2;
            (something(middle) == first ? a : b) = middle;
        }
        found.push_back(b);
    }
    return found;
}

// GGX: polar slopes, the length by its logarithm, in which both the density and unstretching vary over a distance
// of order 1; the azimuth between its breaks.
void Distribution::add_polar_nodes(QuadratureRule& rule, int fineness) const {
    const bool fine = fineness > 0;
    const double tail = fine ? 26 : 20, head = fine ? 13 : 10, width = fineness > 1 ? 1.2 : fine ? 2 : 3;
    const double step = fineness > 1 ? 0.3 : fine ? 0.42 : 0.55, reach = fineness > 1 ? 30 : fine ? 23 : 18;
    const double scale = 1 / (pi_d * normaliser());
    std::vector<double> breaks;
    const double e = std::atan2(ey_, ex_);
    for (int i = -4; i <= 8; ++i)
        for (const double x : {i * pi_d / 2, e + i * pi_d / 2})
            if (x >= -1e-12 && x <= 2 * pi_d + 1e-12) breaks.push_back(x);
    if (by_form())
        for (int i = -4; i <= 8; ++i)
            if (const double x = middle_ + i * pi_d / 2; x >= 0 && x <= 2 * pi_d && !(half_ > 0))
                breaks.push_back(x);
    if (half_ > 0) {
        std::erase_if(breaks, [&](double x) { return !(std::abs(x - middle_) < half_ * (1 - 1e-9)); });
        breaks.insert(breaks.end(), {middle_ - half_, middle_, middle_ + half_});
    }
    if (kind_ == Kind::lune) {
        std::vector<double> corners = edges();
        corners.insert(corners.end(), corners_.begin(), corners_.end());
        for (const double corner : corners)
            for (const double x : {corner - 2 * pi_d, corner, corner + 2 * pi_d})
                if (half_ > 0 ? std::abs(x - middle_) < half_ : x > 0 && x < 2 * pi_d) breaks.push_back(x);
    }
    std::sort(breaks.begin(), breaks.end());
    for (std::size_t i = 0; i + 1 < breaks.size(); ++i) {
        if (!(breaks[i + 1] - breaks[i] > 1e-13)) continue;
        logistic(breaks[i], breaks[i + 1], step, reach, [&](double phi, double weight) {
            const Range in = range(phi);
            if (!(weight > 0) || !(in.lo < in.hi) || !(in.lo < 1e100)) return;
            const double c = std::cos(phi), s = std::sin(phi);
            const double lo = in.lo > 0 ? std::log(in.lo) : std::min(0., std::log(in.hi)) - head;
            const double hi = std::min(std::log(in.hi), std::max(0., lo) + tail);
            const auto add_node = [&](double log_r, double w) {
                const double r = std::exp(log_r), q = 1 + r * r;
                const double area = weight * w * r * r;
                const double cosine = in.lo > 0 && !by_form() ? in.slope * (r - in.lo) : in.slope * r + cos_;
                add({r * c, r * s, area, area * scale * std::max(0., cosine) / (q * q)}, rule);
            };
            panels<10>(lo, hi, width, add_node);
        });
    }
}

// Beckmann: the slopes along and across e, a product.
void Distribution::add_slope_nodes(QuadratureRule& rule, bool fine) const {
    const double reach = fine ? 6.2 : 5, square = reach * reach, alpha = std::max({alpha_x_, alpha_y_, 1.});
    const double width = std::max((fine ? 1.2 : 1.6) / alpha, 2 * reach / 80);
    const double from = a_ < 0 ? square / (std::sqrt(a_ * a_ + square) - a_) : std::min(a_, reach) + reach;
    const Slopes<double> s{a_, weight_};
    panels<10>(0, from, a_ < 0 ? from / 6 : width, [&](double down, double weight_x) {
        const double top = std::min(a_, reach);
        const Slope<double> at =
            a_ < reach ? Slope<double>{a_ - down, down} : Slope<double>{top - down, a_ - top + down};
        const double p_x = beckmann_slope_pdf(s, at) * weight_x;
        panels<10>(-reach, reach, width, [&](double y, double weight_y) {
            const double p = p_x * weight_y * std::exp(-y * y) / root_pi;
            add({-(at.x * ex_ - y * ey_), -(at.x * ey_ + y * ex_), weight_x * weight_y, p}, rule);
        });
    });
}

QuadratureRule Distribution::rule(int fineness) const {
    QuadratureRule rule;
    switch (ndf_of(kind_)) {
        case Ndf::ggx:
            add_polar_nodes(rule, fineness);
            break;
        case Ndf::beckmann:
            add_slope_nodes(rule, fineness > 0);
            break;
    }
    return rule;
}

Moments Distribution::moments() const {
    const QuadratureRule nodes = rule(1);
    const Vec3d& seen = lobe_.wo;
    const auto quantities = [&](std::size_t i) {
        const double x = nodes.x[i], y = nodes.y[i], z = nodes.z[i];
        return std::array<double, Moments::count>{
            x, y, z, x * x, y * y, z * z, x * y, x * z, y * z, x * seen.x + y * seen.y + z * seen.z};
    };
    Moments m;
    for (std::size_t i = 0; i < nodes.size(); ++i) {
        const auto q = quantities(i);
        for (int k = 0; k < Moments::count; ++k) m.mean[k] += nodes.probability[i] * q[k];
    }
    for (std::size_t i = 0; i < nodes.size(); ++i) {
        const auto q = quantities(i);
        for (int k = 0; k < Moments::count; ++k)
            m.variance[k] += nodes.probability[i] * (q[k] - m.mean[k]) * (q[k] - m.mean[k]);
    }
    return m;
}

}  // namespace vndf::reference
