// A registered density for one lobe: pivots, moments, bins, quadrature.
//
// It knows no sampler: what one draws is judged by the density that it is registered with, the approximate fit of 2014
// too, so that its bias shows.
#pragma once

#include <array>
#include <cstddef>
#include <stdexcept>
#include <string_view>
#include <vector>

#include "reference/reference.h"

namespace vndf::reference {

struct Vec3d {
    double x, y, z;
};

// What a density is about. What it does not depend on is not read.
struct Lobe {
    Vec3d wo{0, 0, 1};                // of any length, in the frame that n is given in
    Vec3d n{0, 0, 1};                 // of the surface, for the densities in world space
    double alpha_x = 1, alpha_y = 1;  // below 1e-8 as 1e-8
    Vec3d l{0, 0, 1};                 // the centre of a cap, and its 1 - cos(beta)
    double one_minus_cos = 1;
    Vec3d ng{0, 0, 1};  // a geometric normal in the local frame, with wo above it
};

// First and second moments of a unit direction d, and the variances of the quantities averaged: the standard
// error of a mean of n samples is sqrt(variance / n).
struct Moments {
    // d_x, d_y, d_z; d_x d_x, d_y d_y, d_z d_z, d_x d_y, d_x d_z, d_y d_z; d . wo (d . n for plain normals).
    static constexpr int count = 10;
    static constexpr std::array<const char*, count> names = {"x",  "y",  "z",  "xx", "yy",
                                                             "zz", "xy", "xz", "yz", "wo"};
    std::array<double, count> mean{};
    std::array<double, count> variance{};
};

// Nodes d and weights so that  sum w f(d)  is the integral of f over the sphere (solid angle) for functions f
// shaped like the density, and  sum p f(d)  the expectation of f: p = w * density.
struct QuadratureRule {
    std::vector<double> x, y, z;      // unit directions, wm or wi
    std::vector<double> weight;       // solid angle
    std::vector<double> probability;  // weight * density; sums to 1
    std::size_t size() const { return x.size(); }
};

// Whether a sample is lost, a zero vector.
inline bool is_lost(const std::array<double, 3>& d) {
    return d[0] == 0 && d[1] == 0 && d[2] == 0;
}

// Edges of a histogram in theta (polar) and phi (azimuth), ascending; phi starts anywhere and spans 2 pi.
struct Bins {
    std::vector<double> theta, phi;
};

class Distribution {
  public:
    // Throws std::invalid_argument unless `density` is the name of one.
    Distribution(std::string_view density, const Lobe& lobe, Precision precision = Precision::f32);

    // Two numbers for each direction (wm or wi), independent and uniform in [0, 1] if the directions follow
    // the density. They are clipped to [0, 1]; a direction outside the support gives a number at its end.
    template <class T>  // float or double
    void pivots(std::size_t n, const T* x, const T* y, const T* z, double* p1, double* p2) const;

    // The variable of the histogram: polar angle and azimuth (in [0, 2 pi)) about the normal of the surface,
    // of the direction itself (wm) or of the half vector of direction and wo (wi); in world space about n.
    template <class T>
    void angles(std::size_t n, const T* x, const T* y, const T* z, double* theta, double* phi) const;

    // Bins of about equal marginal probability in either variable.
    Bins bins(std::size_t n_theta, std::size_t n_phi) const;

    // Probability of each bin, row by row: [i_theta * n_phi + i_phi]; absolute error below 1e-7.
    std::vector<double> bin_probabilities(const Bins& bins) const;

    // Relative error below 1e-8 of the largest moment of its order, for alpha in [1e-4, 2].
    Moments moments() const;

    // A rule that integrates the density of the directions to 1e-7; of fineness 1 to 1e-9, of fineness 2 (GGX) to 1e-12.
    QuadratureRule rule(int fineness = 0) const;

    // The largest change of a pivot that rounding one component of a typical direction by 2^-24 can make, an
    // estimate from the lobe alone: pivot tests of float samples make sense where it is below about 1e-3.
    double pivot_rounding() const;

    // sigma_C of a cone inside the hemisphere of normals, by quadrature over the azimuth.
    double sigma_cap() const { return length_ * cap_; }

    // The probability that a visible normal reflects wo above the horizon, by quadrature along the horizon's curve; for the
    // density of those reflections alone. 1 behind the surface.
    double reflection_probability() const { return kind_ == Kind::conic ? cap_ / sigma_ : 1; }

    // The part of a sampler's samples that are not lost, by quadrature over the azimuth: below 1 for reflections above a
    // geometric normal alone. All else here is of the samples that are not lost.
    double kept() const { return kept_; }

    // sigma of what is above both normals, likewise.
    double sigma_tilted() const { return length_ * cap_; }

  private:
    // GGX reflections from the front: bounded, on their own cap; conic, above the horizon. From anywhere: cone, in a cap of
    // directions whose cone of normals is above the surface; lune, above a geometric normal, too.
    enum class Kind { ggx, bounded, conic, cone, lune, beckmann };
    enum class Ndf { ggx, beckmann };
    static constexpr Ndf ndf_of(Kind kind) {
        switch (kind) {
            case Kind::ggx:
            case Kind::bounded:
            case Kind::conic:
            case Kind::cone:
            case Kind::lune:
                return Ndf::ggx;
            case Kind::beckmann:
                return Ndf::beckmann;
        }
        throw std::logic_error("no distribution of this kind");
    }
    struct Known;
    struct Range;
    struct Node;

    static const Known& known(std::string_view density);
    // A direction of this density by one of the maps that draw from it.
    std::array<double, 3> draw(double u1, double u2) const;
    Vec3d half(double x, double y, double z) const;
    double normaliser() const;
    double visible_area() const;
    void tabulate_azimuths();
    bool by_form() const { return kind_ == Kind::cone || kind_ == Kind::lune; }
    void find_cone(const Vec3d& axis, double one_minus_cos);
    void find_corners();
    Range cone_range(double c, double s, double slope, double turn) const;
    Range lune_range(double c, double s, double slope, double turn) const;
    double azimuth_of(double place) const;
    double place_of(double phi) const;
    double polar_mass(double slope, double from, double to) const;
    double share_below(double phi, double tangent) const;
    Range range(double phi) const;
    void cumulative(double phi, const std::vector<double>& tan_theta, double* mass) const;
    void add(const Node& node, QuadratureRule& rule) const;
    std::vector<double> edges() const;
    void add_polar_nodes(QuadratureRule& rule, int fineness) const;
    void add_slope_nodes(QuadratureRule& rule, bool fine) const;
    std::vector<double> azimuth_breaks() const;
    template <class T, Kind kind>
    void pivots_of(std::size_t n, const T* x, const T* y, const T* z, double* p1, double* p2) const;

    const Known& known_;
    Precision precision_;
    Lobe lobe_;  // wo and n of unit length, alpha raised
    Kind kind_;
    bool reflected_;              // directions are wi
    bool world_;                  // directions are not in the local frame
    std::array<Vec3d, 3> frame_;  // rows t1, t2, n: world to local
    Vec3d wo_;                    // unit, local
    double alpha_x_, alpha_y_;
    double ex_, ey_;     // azimuth of the stretched wo (stretched.h)
    double length_;      // of the stretched wo
    double sin_, cos_;   // of its polar angle
    double sigma_;       // (1 + cos) / 2
    double tan_half_;    // tan(theta / 2)
    double a_, weight_;  // Beckmann: cot(theta) and N(a)
    double k_, gap_;     // bounded: o_z > -k cos, 1 - k
    double
        cap_;  // bounded: (1 + k cos) / 2; conic: that of what is above the horizon; cone, lune: of what is in it
    // Conic, cone, lune: the distribution function of the stretched azimuth from azimuth_.front() to one turn on, and its slope.
    std::vector<double> azimuth_, mass_, slope_;
    // Cone, lune: its form q m_j m_k in slopes; its azimuths are middle_ + half_ sin(azimuth_), all of them where half_ is 0.
    std::array<std::array<double, 3>, 3> q_{};
    double middle_ = 0, half_ = 0;
    std::array<double, 2> corners_{};  // lune: the azimuths at which both horizons meet
    double kept_ = 1;
};

}  // namespace vndf::reference
