#include "energy/measure.h"

#include <array>
#include <cmath>

#include <fmt/format.h>

#include "runtime/program.h"

namespace vndf::energy {
namespace {

View in_plane(double cosine, double alpha) {
    return {std::sqrt((1 - cosine) * (1 + cosine)), 0, cosine, alpha, alpha};
}

// The first row is alpha = 0, where the loss has a limit: it is measured a quarter of a row from there.
double measured_alpha(int row) {
    return alpha_of(row == 0 ? .25 : row);
}

}  // namespace

std::vector<double> losses(const runtime::Device& device, const Surface& surface,
                           const std::vector<View>& views, int points) {
    runtime::ProgramOptions options;
    options.root = "kernels/batch/albedo.cl";
    options.build_options = fmt::format(
        " -DVNDF_NDF={} -DVNDF_MASKING={} -DVNDF_SAMPLING={} -DVNDF_FRESNEL=none -DVNDF_ALBEDO_POINTS={}",
        surface.ndf, surface.masking, surface.ndf == "ggx" ? "conic" : "plain", points);
    const runtime::Program program(device, runtime::Math::strict, runtime::Real::f32, options);
    const std::size_t padded = runtime::whole_groups(views.size());
    std::array<std::vector<float>, 6> columns;
    for (auto& column : columns) column.resize(padded, 1);
    for (std::size_t i = 0; i < views.size(); ++i) {
        const View& v = views[i];
        const std::array<double, 5> values{v.x, v.y, v.z, v.alpha_x, v.alpha_y};
        for (std::size_t c = 0; c < values.size(); ++c) columns[c][i] = static_cast<float>(values[c]);
    }
    program.guarded("measure a table of energy", [&] {
        cl::Kernel kernel = program.kernel("vndf_batch_albedo");
        std::vector<cl::Buffer> buffers;
        for (cl_uint c = 0; c < columns.size(); ++c) {
            buffers.push_back(program.buffer(padded * sizeof(float)));
            program.queue().enqueueWriteBuffer(buffers[c], CL_TRUE, 0, padded * sizeof(float),
                                               columns[c].data());
            kernel.setArg(c, buffers[c]);
        }
        program.launch(kernel, views.size());
        program.queue().enqueueReadBuffer(buffers.back(), CL_TRUE, 0, padded * sizeof(float),
                                          columns.back().data());
    });
    return {columns.back().begin(), columns.back().begin() + static_cast<std::ptrdiff_t>(views.size())};
}

Table measured(const runtime::Device& device, const Surface& surface) {
    std::vector<View> views;
    for (int row = 0; row < Table::rows; ++row)
        for (int column = 0; column < Table::columns; ++column) {
            // The horizon sees nothing: it has the limit, too.
            const double alpha = measured_alpha(row), cosine = cosine_of(column == 0 ? .02 : column, alpha);
            views.push_back(in_plane(cosine, alpha));
        }
    Table table{surface, {}};
    for (const double loss : losses(device, surface, views))
        table.losses.push_back(static_cast<float>(std::max(loss, 0.)));
    return table;
}

}  // namespace vndf::energy
