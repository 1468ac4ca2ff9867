#include "render/environment.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "error.h"
#include "file.h"
#include "parallel.h"
#include "render/alias.h"

namespace vndf::render {
namespace {

using std::numbers::pi;

std::string bytes_of(const std::filesystem::path& file) {
    std::error_code error;
    if (!std::filesystem::is_regular_file(file, error))
        throw InputError(fmt::format("{}: no file", file.string()));
    return read_file(file, std::uint64_t{1} << 32);
}

LatLong read(const std::filesystem::path& file) {
    const std::string bytes = bytes_of(file);
    if (bytes.starts_with("#?")) return read_hdr(bytes, file.string());
    if (bytes.starts_with("\x76\x2f\x31\x01")) return read_exr(bytes, file.string());
    throw InputError(
        fmt::format("{}: neither a Radiance picture (.hdr) nor an OpenEXR image (.exr)", file.string()));
}

void clean(LatLong& image, const std::string& name, std::vector<std::string>& warnings) {
    std::size_t infinite = 0, negative = 0;
    for (float& x : image.pixels) {
        const bool bad = !std::isfinite(x), below = x < 0 && !bad;
        infinite += bad, negative += below;
        if (bad || below) x = 0;
    }
    const auto warn = [&](std::size_t count, const char* what) {
        if (count > 0) warnings.push_back(fmt::format("{}: {} values {}, taken as 0", name, count, what));
    };
    warn(infinite, "that are no finite numbers");
    warn(negative, "below 0");
    if (image.width != 2 * image.height)
        warnings.push_back(
            fmt::format("{}: {} x {} pixels, not twice as wide as high; taken as all directions", name,
                        image.width, image.height));
}

// Between the middles of pixels, around the columns.
class Interpolation {
  public:
    explicit Interpolation(const LatLong& image) : image_(image) {}

    // turn: of the width, from 0 to 2; row: of the middles, 0 and below is the first.
    void add(double turn, double row, std::array<double, 3>& sum) const {
        const double x = turn * image_.width + (image_.width - 0.5),
                     y = std::clamp(row, 0.0, image_.height - 1.0);
        const auto column = static_cast<std::size_t>(x);
        const auto low = static_cast<std::size_t>(y),
                   high = std::min<std::size_t>(low + 1, image_.height - 1);
        const double s = x - static_cast<double>(column), t = y - static_cast<double>(low);
        const float *a = at(column, low), *b = at(column + 1, low), *c = at(column, high),
                    *d = at(column + 1, high);
        for (int i = 0; i < 3; ++i)
            sum[i] += (1 - t) * ((1 - s) * a[i] + s * b[i]) + t * ((1 - s) * c[i] + s * d[i]);
    }

  private:
    const float* at(std::size_t column, std::size_t row) const {
        return &image_.pixels[3 * (row * image_.width + column % image_.width)];
    }
    const LatLong& image_;
};

std::uint32_t side_for(const LatLong& image) {
    const double cells = static_cast<double>(image.width) * image.height / 2;
    return 1u << std::clamp(static_cast<int>(std::lround(std::log2(cells) / 2)), 5, 10);
}

// The means over cells, from points of a grid finer than the pixels. Clarberg's map (kernels/render/octahedral.h) on such a grid:
// in whole steps, latitudes from a table.
class Resampling {
  public:
    Resampling(const LatLong& image, std::uint32_t side, float rotation_degrees)
        : image_(image), from_(image) {
        const double pixels = std::sqrt(static_cast<double>(image.width) * image.height) / side;
        points_ = std::clamp(static_cast<int>(std::ceil(4 * pixels)), 8, 32);
        steps_ = points_ * static_cast<int>(side);
        // The image turns, so that what is looked up turns back; 0 at +x.
        const double turns = rotation_degrees / 360.0 + 0.25;
        start_ = turns - std::floor(turns);
        for (int k = 0; k <= steps_ / 2; ++k)
            rows_.push_back(2 * std::asin(std::min(1.0, std::sqrt(2.0) * k / steps_)) / pi * image.height -
                            0.5);
    }

    Vec cell(std::uint32_t column, std::uint32_t row) const {
        std::array<double, 3> sum{};
        for (int j = 0; j < points_; ++j)
            for (int i = 0; i < points_; ++i)
                add(2 * (static_cast<int>(column) * points_ + i) + 1 - steps_,
                    2 * (static_cast<int>(row) * points_ + j) + 1 - steps_, sum);
        Vec mean;
        for (int c = 0; c < 3; ++c) mean[c] = static_cast<float>(sum[c] / points_ / points_);
        return mean;
    }

  private:
    void add(int u, int v, std::array<double, 3>& sum) const {
        const int au = std::abs(u), av = std::abs(v);
        const bool above = au + av <= steps_;
        const int a = above ? au : steps_ - av, b = above ? av : steps_ - au;
        double turn = 0.25 * b / (a + b), row = rows_[(a + b) / 2];
        if (u < 0) turn = 0.5 - turn;
        if (v < 0) turn = 1 - turn;
        from_.add(start_ + turn, above ? row : image_.height - 1.0 - row, sum);
    }

    const LatLong& image_;
    Interpolation from_;
    int points_, steps_;
    double start_;
    std::vector<double> rows_;  // at k / (steps / 2) of the way from the centre to the horizon
};

// What is beyond an edge is at the mirrored place of the same edge; beyond a corner, in the opposite one.
void fill_border(float* map, std::uint32_t side) {
    const std::uint32_t n = side + 2, last = side + 1;
    for (std::uint32_t i = 1; i <= side; ++i) {
        const std::uint32_t mirrored = last - i;
        map[i] = map[n + mirrored];
        map[last * n + i] = map[side * n + mirrored];
        map[i * n] = map[mirrored * n + 1];
        map[i * n + last] = map[mirrored * n + side];
    }
    map[0] = map[side * n + side];
    map[last] = map[side * n + 1];
    map[last * n] = map[n + side];
    map[last * n + last] = map[n + 1];
}

// The mean luminance over each cell of what the kernels interpolate: above 0 wherever that is.
std::vector<double> weights_of(const Environment& environment) {
    const std::size_t side = environment.side, n = side + 2;
    std::vector<double> bright(n * n);
    for (std::size_t i = 0; i < n * n; ++i)
        bright[i] = luminance(environment.radiance[i], environment.radiance[n * n + i],
                              environment.radiance[2 * n * n + i]);
    const auto across = [&](std::size_t i) { return bright[i - 1] + 6 * bright[i] + bright[i + 1]; };
    std::vector<double> weights;
    for (std::size_t y = 1; y <= side; ++y)
        for (std::size_t x = 1; x <= side; ++x) {
            const std::size_t i = y * n + x;
            weights.push_back((across(i - n) + 6 * across(i) + across(i + n)) / 64);
        }
    return weights;
}

}  // namespace

Environment environment_of(const LatLong& image, float rotation_degrees) {
    Environment environment;
    const std::uint32_t side = environment.side = side_for(image);
    const std::size_t n = side + 2;
    environment.radiance.resize(3 * n * n);
    const Resampling resampling(image, side, rotation_degrees);
    parallel_for(side, 1, [&](unsigned, std::size_t begin, std::size_t end) {
        for (std::size_t y = begin; y < end; ++y)
            for (std::uint32_t x = 0; x < side; ++x) {
                const Vec mean = resampling.cell(x, static_cast<std::uint32_t>(y));
                for (std::size_t c = 0; c < 3; ++c)
                    environment.radiance[(c * n + y + 1) * n + x + 1] = mean[c];
            }
    });
    for (std::size_t c = 0; c < 3; ++c) fill_border(&environment.radiance[c * n * n], side);
    Alias alias = alias_of(weights_of(environment));
    environment.keep = std::move(alias.keep);
    environment.other = std::move(alias.other);
    for (const double chance : alias.chance)
        environment.pdf.push_back(static_cast<float>(chance * side * side / (4 * pi)));
    return environment;
}

Environment read_environment(const std::filesystem::path& file, std::vector<std::string>& warnings,
                             float rotation_degrees) {
    LatLong image = read(file);
    clean(image, file.string(), warnings);
    return environment_of(image, rotation_degrees);
}

Vec mean_radiance(const Environment& environment) {
    const std::size_t side = environment.side, n = side + 2;
    Vec mean{};
    for (std::size_t c = 0; c < 3; ++c) {
        double sum = 0;
        for (std::size_t y = 1; y <= side; ++y)
            for (std::size_t x = 1; x <= side; ++x) sum += environment.radiance[(c * n + y) * n + x];
        mean[c] = static_cast<float>(sum / static_cast<double>(std::max<std::size_t>(side * side, 1)));
    }
    return mean;
}

}  // namespace vndf::render
