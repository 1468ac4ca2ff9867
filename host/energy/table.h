// A table of kernels/vndf/energy.h: what a rough conductor that reflects everything loses to scattering between its facets.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace vndf::energy {

// Whose loss it is, by the names that VNDF_NDF and VNDF_MASKING have.
struct Surface {
    std::string ndf, masking;
};

struct Table {
    // By sqrt(alpha / 2), from alpha 0 to 2; and by sqrt(1 - tan(theta / 2)), theta after the stretch, from the horizon to z.
    static constexpr int rows = 32, columns = 64;

    Surface surface;
    std::vector<float> losses;  // 1 - E, row by row
};

// The roughness of a row, and the cosine of a column there; places between them, too.
double alpha_of(double row);
double cosine_of(double column, double alpha);

// The cosine at a place in [0, 1], sqrt(1 - tan(theta / 2)) with theta after the stretch.
double stretched_cosine_of(double place, double stretch);

// The mean by the cosine law of what the table gives for alpha, so that a lobe made of both keeps all light.
double average(const Table& table, double alpha);

// A header for OpenCL C, C, C++ and CUDA: two arrays and their sizes. The numbers are rounded to 1e-5; those of the second are
// average() over alpha / 2, for equidistant sqrt(alpha / 2).
std::string header(const Table& table);

// As text that is kept on disk, and back: with a version, sizes and a checksum. Throws InputError that says what is wrong with
// the file at `path`.
std::string kept(const Table& table);
Table read_kept(const Surface& surface, std::string_view text, const std::string& path);

}  // namespace vndf::energy
