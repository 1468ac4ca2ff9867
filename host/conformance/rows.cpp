#include "conformance/rows.h"

#include <algorithm>
#include <limits>

namespace vndf::conformance {

double dot(const Direction& a, const Direction& b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
double length(const Direction& a) {
    return std::sqrt(dot(a, a));
}

RowReader::RowReader(const Function& function)
    : wo_(column(function, "wo_x")),
      n_(column(function, "n_x")),
      wm_(column(function, "wm_x")),
      wi_(column(function, "wi_x")),
      alpha_(column(function, "alpha_x")),
      alpha_columns_(2) {
    if (wo_ < 0) wo_ = column(function, "w_x");
    if (alpha_ < 0) {
        alpha_ = column(function, "alpha");
        alpha_columns_ = 1;
    }
}

Direction RowReader::read(const double* row, int column) {
    if (column < 0) return {0, 0, 1};
    return {row[column], row[column + 1], row[column + 2]};
}

std::array<double, 2> RowReader::alpha(const double* row) const {
    if (alpha_ < 0) return {1, 1};
    return {row[alpha_], row[alpha_ + alpha_columns_ - 1]};
}

double RowReader::cos_theta_o(const double* row) const {
    const Direction o = wo(row), axis = n(row);
    return dot(o, axis) / (length(o) * length(axis));
}

double beckmann_exponent(const Direction& m, std::array<double, 2> alpha) {
    const double x = m[0] / (std::max(alpha[0], 1e-8) * m[2]), y = m[1] / (std::max(alpha[1], 1e-8) * m[2]);
    return x * x + y * y;
}

double relative_condition(const Function& function, reference::Evaluation<double> evaluation,
                          const double* row, reference::Precision precision) {
    constexpr double step = 0x1p-24;
    const std::size_t outputs = function.outputs.size();
    double in[16], low[4], high[4], at[4], condition = 0, size = 0;
    std::copy(row, row + function.inputs.size(), in);
    evaluation(in, at, precision);
    for (std::size_t k = 0; k < outputs; ++k) size = std::hypot(size, at[k]);
    for (std::size_t j = 0; j < function.inputs.size(); ++j) {
        const double x = in[j];
        in[j] = x * (1 - step);
        evaluation(in, low, precision);
        in[j] = x * (1 + step);
        evaluation(in, high, precision);
        in[j] = x;
        double change = 0;
        for (std::size_t k = 0; k < outputs; ++k) change = std::hypot(change, high[k] - low[k]);
        condition += change / (2 * step);
    }
    return size > 0 ? condition / size : std::numeric_limits<double>::infinity();
}

}  // namespace vndf::conformance
