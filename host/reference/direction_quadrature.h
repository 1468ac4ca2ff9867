// The integral of D / 4 over regions of directions, by its definition: panels halved either way until they agree. For lobes that
// are wide enough for that, alpha from 0.05, wo not at grazing.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "reference/integrals.h"
#include "reference/terms.h"

namespace vndf::reference {

class Directions {
  public:
    Directions(const Vec3<double>& wo, double alpha_x, double alpha_y)
        : wo_(wo), alpha_x_(alpha_x), alpha_y_(alpha_y) {}

    // Above the normals z and ng: by longitude about the line where both horizons meet, from one to the other, and latitude.
    double lune(const Vec3<double>& ng) const {
        const double size = std::hypot(ng.x, ng.y), x = ng.x / size, y = ng.y / size;
        const double tilt = std::atan2(size, ng.z);
        const auto density = [&](double longitude, double latitude) {
            const double c = std::cos(latitude), out = c * std::sin(longitude), s = std::sin(latitude);
            return c * at({out * x - s * y, out * y + s * x, c * std::cos(longitude)});
        };
        return grid(density, tilt - pi_d / 2, pi_d / 2, -pi_d / 2, pi_d / 2, 4);
    }

    // Of a convex polygon within half of the sphere, above the horizon: triangles from its first vertex, along the planes through
    // their vertices.
    double polygon(const std::vector<Vec3<double>>& vertices) const {
        std::vector<Vec3<double>> above;
        for (std::size_t i = 0; i < vertices.size(); ++i) {
            const Vec3<double>&a = vertices[i], &b = vertices[(i + 1) % vertices.size()];
            if (a.z > 0) above.push_back(a);
            if ((a.z > 0) == (b.z > 0)) continue;
            const double s = a.z / (a.z - b.z);
            above.push_back(normalised<double>({a.x + s * (b.x - a.x), a.y + s * (b.y - a.y), 0}));
        }
        double sum = 0;
        for (std::size_t i = 1; i + 1 < above.size(); ++i) sum += triangle(above[0], above[i], above[i + 1]);
        return sum;
    }

    // Of a cap and normals above the surface: its circles, of each what is higher than -wo.z.
    double cap(const Vec3<double>& l, double one_minus_cos) const {
        const double across = std::hypot(l.x, l.y), beta = 2 * std::asin(std::sqrt(one_minus_cos / 2));
        const Vec3<double> top = across > 0 ? Vec3<double>{-l.z * l.x / across, -l.z * l.y / across, across}
                                            : Vec3<double>{1, 0, 0};
        const Vec3<double> side{l.y * top.z - l.z * top.y, l.z * top.x - l.x * top.z,
                                l.x * top.y - l.y * top.x};
        // From the top to the height, as a part of the way; circles that are cut or not in panels of their own.
        const auto density = [&](double theta, double part) {
            const double c = std::cos(theta), s = std::sin(theta);
            const double cosine = across > 0 ? (-wo_.z - c * l.z) / (s * across) : c * l.z > -wo_.z ? -1 : 1;
            const double reach = std::acos(std::clamp(cosine, -1., 1.)), phi = reach * part;
            const double x = s * std::cos(phi), y = s * std::sin(phi);
            return reach * s *
                   at({c * l.x + x * top.x + y * side.x, c * l.y + x * top.y + y * side.y,
                       c * l.z + x * top.z + y * side.z});
        };
        // Whose rim touches the height: theta_l -+ theta = the angle to it.
        const double tilt = std::atan2(across, l.z), level = std::acos(std::clamp(-wo_.z, -1., 1.));
        std::vector<double> edges{0, beta};
        for (const double touch : {level - tilt, tilt - level, level + tilt, 2 * pi_d - level - tilt})
            if (touch > 0 && touch < beta) edges.push_back(touch);
        std::sort(edges.begin(), edges.end());
        double sum = 0;
        for (std::size_t i = 0; i + 1 < edges.size(); ++i) {
            // The reach ends as a root: not so in the sine's argument.
            const double middle = (edges[i] + edges[i + 1]) / 2, half = (edges[i + 1] - edges[i]) / 2;
            sum += grid(
                [&](double t, double part) {
                    return half * std::cos(t) * density(middle + half * std::sin(t), part);
                },
                -pi_d / 2, pi_d / 2, -1, 1, 4);
        }
        return sum;
    }

  private:
    double at(const Vec3<double>& wi) const {
        const Vec3<double> h{wo_.x + wi.x, wo_.y + wi.y, wo_.z + wi.z};
        return h.z > 0 ? Ggx::ndf(normalised(h), alpha_x_, alpha_y_) / 4 : 0;
    }
    double triangle(const Vec3<double>& a, const Vec3<double>& b, const Vec3<double>& c) const {
        const Vec3<double> e{b.x - a.x, b.y - a.y, b.z - a.z}, f{c.x - b.x, c.y - b.y, c.z - b.z};
        const double volume = std::abs(a.x * (e.y * f.z - e.z * f.y) + a.y * (e.z * f.x - e.x * f.z) +
                                       a.z * (e.x * f.y - e.y * f.x));
        const auto density = [&](double s, double t) {
            const Vec3<double> p{a.x + s * (e.x + t * f.x), a.y + s * (e.y + t * f.y),
                                 a.z + s * (e.z + t * f.z)};
            const double r2 = dot(p, p);
            return s * volume / (r2 * std::sqrt(r2)) * at(normalised(p));
        };
        return grid(density, 0, 1, 0, 1, 2);
    }
    template <class F>
    double grid(const F& f, double a, double b, double c, double d, int parts) const {
        double sum = 0;
        for (int i = 0; i < parts; ++i)
            for (int j = 0; j < parts; ++j)
                sum += refined(f, a + (b - a) * i / parts, a + (b - a) * (i + 1) / parts,
                               c + (d - c) * j / parts, c + (d - c) * (j + 1) / parts, 1e-15, 0);
        return sum;
    }
    template <class F>
    static double panel(const F& f, double a, double b, double c, double d) {
        double sum = 0;
        gauss<15>(a, b, [&](double x, double w) {
            gauss<15>(c, d, [&](double y, double v) { sum += w * v * f(x, y); });
        });
        return sum;
    }
    template <class F>
    static double refined(const F& f, double a, double b, double c, double d, double tolerance, int depth) {
        const double whole = panel(f, a, b, c, d), x = (a + b) / 2, y = (c + d) / 2;
        const double parts =
            panel(f, a, x, c, y) + panel(f, x, b, c, y) + panel(f, a, x, y, d) + panel(f, x, b, y, d);
        if (std::abs(whole - parts) < tolerance + 1e-15 * whole || depth > 8) return parts;
        return refined(f, a, x, c, y, tolerance / 2, depth + 1) +
               refined(f, x, b, c, y, tolerance / 2, depth + 1) +
               refined(f, a, x, y, d, tolerance / 2, depth + 1) +
               refined(f, x, b, y, d, tolerance / 2, depth + 1);
    }

    Vec3<double> wo_;
    double alpha_x_, alpha_y_;
};

}  // namespace vndf::reference
