// A walk on the Smith microsurface with its heights: Gaussian ones, the next facet by bisection of the optical depth, its normal
// by rejection. Where the rays end does not depend on the distribution of heights.
#pragma once

#include <cmath>

#include "reference/materials.h"

namespace vndf::reference {

struct Walked {
    Vec3<double> wi;
    int facets;
};

// Draw: gives numbers in [0, 1). Of a conductor that reflects everything, and of a dielectric with the index `eta` below over
// that above, 0 standing for the conductor.
template <class N, class Draw>
class HeightWalk {
  public:
    HeightWalk(double alpha_x, double alpha_y, double eta, Draw& draw)
        : alpha_x_(alpha_x), alpha_y_(alpha_y), eta_(eta), draw_(draw) {}

    Walked operator()(const Vec3<double>& wo) {
        Vec3<double> ray{-wo.x, -wo.y, -wo.z};
        double height = top;
        bool outside = true;
        for (int facets = 0;; ++facets) {
            // Below, height and directions are those of the surface turned upside down.
            const double sign = outside ? 1 : -1;
            height = sign * next(sign * height, scaled(ray, sign));
            if (std::abs(height) >= top) return {ray, facets};
            const Vec3<double> back = scaled(ray, -sign), m = scaled(normal(back), sign);
            const double cosine = dot(scaled(ray, -1.), m), eta = outside ? eta_ : 1 / eta_;
            const bool mirrored = eta_ == 0 || draw_() < fresnel_conductor<double>(cosine, eta, 0);
            if (!mirrored) outside = !outside;
            ray = mirrored ? reflect(scaled(ray, -1.), m) : refract(scaled(ray, -1.), m, eta);
            ray = normalised(ray);
        }
    }

  private:
    static constexpr double top = 7;  // standard deviations, above which lies nothing of the surface

    static double log_below(double height) { return std::log(std::erfc(-height / std::sqrt(2.)) / 2); }

    // The height of the next facet; the top where there is none.
    double next(double height, const Vec3<double>& ray) {
        const double wanted = -std::log(1 - draw_()), l = lambda<N>(view(ray, alpha_x_, alpha_y_));
        const auto depth = [&](double h) { return l * (log_below(h) - log_below(height)); };
        double near = height, far = ray.z > 0 ? top : -30;
        if (ray.z > 0 && depth(top) <= wanted) return top;
        for (int i = 0; i < 50; ++i) {
            const double middle = (near + far) / 2;
            (depth(middle) < wanted ? near : far) = middle;
        }
        return (near + far) / 2;
    }

    // Stretched, the facets of GGX are a hemisphere, and those of Beckmann have Gaussian slopes; each is seen by its area.
    Vec3<double> normal(const Vec3<double>& back) {
        const Vec3<double> v = normalised<double>({alpha_x_ * back.x, alpha_y_ * back.y, back.z});
        for (;;) {
            Vec3<double> m{0, 0, 1};
            double seen = 0;
            if constexpr (std::is_same_v<N, Ggx>) {
                const double z = draw_(), phi = 2 * pi<double>() * draw_(), r = std::sqrt(1 - z * z);
                m = {r * std::cos(phi), r * std::sin(phi), z};
                seen = dot(v, m);
            } else {
                const double r = std::sqrt(-std::log(1 - draw_())), phi = 2 * pi<double>() * draw_();
                m = {r * std::cos(phi), r * std::sin(phi), 1};
                seen = dot(v, m) / 6;  // no slope reaches 5 in 10^10
            }
            if (draw_() < seen) return normalised<double>({alpha_x_ * m.x, alpha_y_ * m.y, m.z});
        }
    }

    double alpha_x_, alpha_y_, eta_;
    Draw& draw_;
};

}  // namespace vndf::reference
