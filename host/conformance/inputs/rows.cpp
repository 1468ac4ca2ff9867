#include "conformance/inputs/rows.h"

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
      l_(column(function, "l_x")),
      ng_(column(function, "ng_x")),
      wm_(column(function, "wm_x")),
      wi_(column(function, "wi_x")),
      alpha_(column(function, "alpha_x")),
      alpha_columns_(2),
      cos_o_(column(function, "cos_theta_o")),
      cos_m_(column(function, "cos_theta_m")),
      cos_i_(column(function, "cos_theta_i")) {
    if (wo_ < 0) wo_ = column(function, "w_x");
    if (cos_o_ < 0) cos_o_ = column(function, "cos_theta");
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

namespace {

Direction of_cosine(double cosine) {
    return {std::sqrt(std::max(0.0, (1 - cosine) * (1 + cosine))), 0, cosine};
}

// w in a frame about n: the half turn about n + z, or n - z, takes n to the axis.
Direction about(Direction n, const Direction& w) {
    const double size = length(n);
    for (double& x : n) x /= size;
    const double sign = n[2] < 0 ? -1 : 1, share = dot(n, w) + sign * w[2], twice = share / (1 + sign * n[2]);
    return {twice * n[0] - w[0], twice * n[1] - w[1], dot(n, w)};
}

}  // namespace

RowReader::Local RowReader::local(const double* row) const {
    Local l;
    const auto place = [&](int column, int cosine, Direction& w) {
        if (column >= 0) w = has_n() ? about(n(row), read(row, column)) : read(row, column);
        if (cosine >= 0) w = of_cosine(row[cosine]);
        return column >= 0 || cosine >= 0;
    };
    place(wo_, cos_o_, l.wo);
    l.has_wm = place(wm_, cos_m_, l.wm);
    l.has_wi = place(wi_, cos_i_, l.wi);
    return l;
}

reference::Lobe RowReader::lobe(const double* row) const {
    const auto [ox, oy, oz] = cos_o_ < 0 ? wo(row) : of_cosine(row[cos_o_]);
    const auto [nx, ny, nz] = n(row);
    const auto [alpha_x, alpha_y] = alpha(row);
    const auto [lx, ly, lz] = l(row);
    const auto [gx, gy, gz] = ng(row);
    return {.wo = {ox, oy, oz},
            .n = {nx, ny, nz},
            .alpha_x = alpha_x,
            .alpha_y = alpha_y,
            .l = {lx, ly, lz},
            .one_minus_cos = has_cap() ? row[l_ + 3] : 1,
            .ng = {gx, gy, gz}};
}

double RowReader::cos_theta_o(const double* row) const {
    const Direction o = wo(row), axis = n(row);
    return dot(o, axis) / (length(o) * length(axis));
}

bool in_core(const RowReader& reader, const double* row) {
    const auto [x, y] = reader.alpha(row);
    return reader.cos_theta_o(row) >= 0.1 && std::min(x, y) >= 1e-3 && std::max(x, y) <= 1;
}

double beckmann_exponent(const Direction& m, std::array<double, 2> alpha) {
    const double x = m[0] / (std::max(alpha[0], 1e-8) * m[2]), y = m[1] / (std::max(alpha[1], 1e-8) * m[2]);
    return x * x + y * y;
}

bool at_edge(const Function& density, const double* row, runtime::Real real) {
    return std::abs(reference::cap_margin(density.model, row, precision(real))) <= 64;
}

namespace {

// The Euclidean size of output `output` of a - b, or of all of them; an azimuth u1 counts modulo 1.
double distance(const Function& function, const std::array<double, 4>& a, const std::array<double, 4>& b,
                int output) {
    if (output >= 0) return std::abs(a[output] - b[output]);
    double size = 0;
    for (std::size_t k = 0; k < function.outputs.size(); ++k) {
        const double difference = a[k] - b[k];
        size = std::hypot(size,
                          function.outputs[k] == "u1" ? difference - std::nearbyint(difference) : difference);
    }
    return size;
}

}  // namespace

double absolute_condition(const Function& function, reference::Evaluation<double> evaluation,
                          const double* row, reference::Precision precision, int output, double step) {
    std::array<double, 20> in{};
    std::array<double, 4> low{}, high{};
    std::copy(row, row + function.inputs.size(), in.begin());
    double condition = 0;
    for (std::size_t j = 0; j < function.inputs.size(); ++j) {
        const double x = in[j];
        in[j] = x * (1 - step);
        evaluation(in.data(), low.data(), precision);
        in[j] = x * (1 + step);
        evaluation(in.data(), high.data(), precision);
        in[j] = x;
        condition += distance(function, high, low, output) / (2 * step);
    }
    return condition;
}

double relative_condition(const Function& function, reference::Evaluation<double> evaluation,
                          const double* row, reference::Precision precision, int output) {
    std::array<double, 4> at{};
    evaluation(row, at.data(), precision);
    const double size = distance(function, at, {}, output);
    return size > 0 ? absolute_condition(function, evaluation, row, precision, output) / size
                    : std::numeric_limits<double>::infinity();
}

}  // namespace vndf::conformance
