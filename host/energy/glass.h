// A table of kernels/vndf/energy_glass.h: what single scattering of rough glass has of what the random walk reflects and refracts.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "energy/table.h"

namespace vndf::energy {

struct GlassTable {
    // By the cosine of the angle of total reflection, for an index from 1 to 3, once for light from the thinner side and once from the
    // denser one; by sqrt(alpha), from 0 to 1; and by the direction as in Table, stretched by sqrt(alpha).
    static constexpr int layers = 10, rows = 13, columns = 20, numbers = 2 * 2 * layers * rows * columns;
    // What stands for 1.
    static constexpr int one = 10000;

    Surface surface;
    std::vector<float> parts;  // reflected and refracted in turn, in units of 1 / one
};

// The index of a layer, of 2 layers; the roughness of a row, and the cosine of a column there.
double glass_eta_of(int layer);
double glass_alpha_of(double row);
double glass_cosine_of(double column, double alpha);

// Of what single scattering reflects and refracts, and of what walks reflect: the two numbers of a place. Parts of less than 1e-3
// are those of 1e-3 more, whatever noise there is in them; the greater of the two is such that no light is lost.
struct GlassAlbedo {
    double reflected, refracted, walk;
};
std::vector<float> glass_parts_of(const GlassAlbedo& albedo);

// As of Table. The numbers of the header are whole.
std::string header(const GlassTable& table);
std::string kept(const GlassTable& table);
GlassTable read_kept_glass(const Surface& surface, std::string_view text, const std::string& path);

}  // namespace vndf::energy
