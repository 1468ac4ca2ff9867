// Where functions are checked: lobes for the statistics, points for the pointwise comparison. Everything is
// made from the names of a function's scalars, so a newly registered function needs nothing here unless it
// brings a new kind of argument.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>
#include <vector>

#include "registry.h"
#include "runtime/evaluator.h"

namespace vndf::conformance {

using Direction = std::array<double, 3>;

struct AlphaRange {
    double low = 1e-3, high = 1;
};

// The directions agree with each other: wm
// is a normal of the lobe (alpha), wi the reflection of wo about it, slope and x the slopes of wm, w = wo,
// cos_theta = wo.z; with a world-space n all directions are turned into its frame, whose x axis is t. Cosines are those of the
// exact directions. k and distance are sizes of x, sigma
// is alpha; f0 and f90 or tint are the two u, and so are dispersion and wavelength, to scale.
struct Point {
    Direction wo{0, 0, 1}, n{0, 0, 1}, wm{0, 0, 1}, wi{0, 0, 1}, t{1, 0, 0};
    double cos_theta = 1, cos_theta_i = 1, cos_theta_m = 1;  // about n
    double wo_dot_wm = 1;
    std::array<double, 2> alpha{1, 1}, slope{0, 0}, u{0.5, 0.5};
    Direction l{0, 0, 1};  // a cap, of any size, at or about wi, the mirror image of wo, z, -wo or anywhere
    double one_minus_cos = 1;
    Direction ng{
        0, 0, 1};  // a geometric normal: z or -z, tilted by any angle, across z or wo, about -wo or anywhere
    // A convex polygon of directions, in turn, of any size, about wi, on the horizon, seen edge-on or anywhere; or none, all in one
    // point or on one great circle.
    std::array<Direction, 4> polygon{};
    double x = 0, eta = 1.5;

    // The scalar of this column name ("wo_x", "alpha", ...). Throws std::invalid_argument if there is none.
    double scalar(std::string_view column) const;
};

// A position in a lobe: a direction of the stretched hemisphere, where every lobe is wide.
struct Stretched {
    double cos_theta;
    double phi;
};

// The unit vector with this cosine and azimuth. |cos| near 1 and near 0 keep their relative precision.
Direction direction(double cos_theta, double phi);

Direction cross(const Direction& a, const Direction& b);

// A cap for the point, drawn by its other numbers. Contained: one whose cone of normals is above the surface.
void place_cap(Point& point, bool contained);

// A geometric normal for the point, likewise. Contained: with wo and some of the reflections above it.
void place_tilt(Point& point, bool contained);

// A polygon for the point, likewise.
void place_polygon(Point& point);

// wo and normal are given in the frame of n.
Point make_point(const Direction& wo, std::array<double, 2> alpha, Stretched normal, const Direction& n,
                 std::array<double, 2> u, double eta);

// A table of input rows, column by column, each value exactly representable in the tested real type.
struct Table {
    std::vector<std::vector<double>> columns;  // [input][row]
    std::size_t rows() const { return columns.empty() ? 0 : columns.front().size(); }
    std::vector<double> row(std::size_t i) const;
};

// The number of the type that is nearest to x.
inline double rounded(double x, runtime::Real real) {
    return real == runtime::Real::f32 ? static_cast<float>(x) : x;
}

// `points` as the inputs of `function`, rounded to the type.
Table tabulate(const Function& function, const std::vector<Point>& points, runtime::Real);

// The index of the column `name` among the inputs, or -1.
int column(const Function& function, std::string_view name);

}  // namespace vndf::conformance
