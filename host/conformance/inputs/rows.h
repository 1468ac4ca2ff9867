// What an input row of a function means: its directions, its lobe, its condition.
#pragma once

#include <cmath>
#include <string_view>

#include "conformance/inputs/points.h"
#include "reference/distribution.h"
#include "runtime/evaluator.h"

namespace vndf::conformance {

constexpr reference::Precision precision(runtime::Real real) {
    return real == runtime::Real::f32 ? reference::Precision::f32 : reference::Precision::f64;
}

// Reads the named arguments out of rows of a function's inputs.
class RowReader {
  public:
    explicit RowReader(const Function& function);

    bool has_wo() const { return wo_ >= 0; }
    bool has_n() const { return n_ >= 0; }
    bool has_cap() const { return l_ >= 0; }
    bool has_ng() const { return ng_ >= 0; }
    bool has_wm() const { return wm_ >= 0; }
    bool has_wi() const { return wi_ >= 0; }

    Direction wo(const double* row) const {
        return read(row, wo_);
    }  // (0, 0, 1) if there is none; also for w
    Direction n(const double* row) const { return read(row, n_); }
    Direction l(const double* row) const { return read(row, l_); }
    Direction ng(const double* row) const { return read(row, ng_); }
    Direction wm(const double* row) const { return read(row, wm_); }
    Direction wi(const double* row) const { return read(row, wi_); }
    std::array<double, 2> alpha(const double* row) const;

    // The directions of the row in the local frame, whichever way they are given: about n, or by cosines, with an azimuth that
    // makes no difference.
    struct Local {
        Direction wo{0, 0, 1}, wm{0, 0, 1}, wi{0, 0, 1};
        bool has_wm = false, has_wi = false;
    };
    Local local(const double* row) const;

    // What a density is about.
    reference::Lobe lobe(const double* row) const;

    // The cosine between wo and the macroscopic normal; 1 without wo.
    double cos_theta_o(const double* row) const;

  private:
    static Direction read(const double* row, int column);
    int wo_, n_, l_, ng_, wm_, wi_, alpha_, alpha_columns_;
    int cos_o_, cos_m_, cos_i_;
};

// The part of the domain for which the strict bounds hold in full: cos(theta_o) >= 0.1, 1e-3 <= alpha <= 1.
bool in_core(const RowReader& reader, const double* row);

double dot(const Direction& a, const Direction& b);
double length(const Direction& a);

// (tan(theta_m) / alpha)^2 per axis, summed, for the normal m of any length in the local frame: the exponent
// of the Beckmann distribution.
double beckmann_exponent(const Direction& m, std::array<double, 2> alpha);

// Whether the row lies where the rounding of its direction decides between the density and 0: the edge of the
// bounded cap.
bool at_edge(const Function& density, const double* row, runtime::Real real);

// The condition of a function's result, or of one of its outputs: sum over the inputs of |x_j| ||df/dx_j||, by
// differences of the reference over `step`, a rounding error of float, either way. Divided by the size of the result it is
// the relative condition number.
double absolute_condition(const Function& function, reference::Evaluation<double> evaluation,
                          const double* row, reference::Precision precision, int output = -1,
                          double step = 0x1p-24);

// The relative one, infinite where the result is 0. Where it is not well below 2^24 the differences mean nothing
// (a switch between branches, a lobe narrower than the step): see is_settled.
double relative_condition(const Function& function, reference::Evaluation<double> evaluation,
                          const double* row, reference::Precision precision, int output = -1);

// Whether rounding an input to float changes a result of this relative condition by less than a hundredth.
constexpr bool is_settled(double condition) {
    return condition * 0x1p-24 < 0.01;
}

}  // namespace vndf::conformance
