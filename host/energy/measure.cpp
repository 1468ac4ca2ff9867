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

runtime::ProgramOptions options(const std::string& root, const Surface& surface,
                                const std::string& switches) {
    runtime::ProgramOptions options;
    options.root = "kernels/batch/" + root + ".cl";
    options.build_options =
        fmt::format(" -DVNDF_NDF={} -DVNDF_MASKING={}", surface.ndf, surface.masking) + switches;
    return options;
}

using Columns = std::vector<std::vector<float>>;

Columns columns_of(const std::vector<View>& views) {
    Columns columns(5);
    for (const View& v : views) {
        const std::array<double, 5> values{v.x, v.y, v.z, v.alpha_x, v.alpha_y};
        for (std::size_t c = 0; c < values.size(); ++c) columns[c].push_back(static_cast<float>(values[c]));
    }
    return columns;
}

Columns run(const runtime::Program& program, const char* name, Columns columns, std::size_t outputs) {
    const std::size_t items = columns.front().size(), bytes = runtime::whole_groups(items) * sizeof(float);
    const std::size_t inputs = columns.size();
    columns.resize(inputs + outputs);
    for (auto& column : columns) column.resize(runtime::whole_groups(items), 1);
    program.guarded("measure a table of energy", [&] {
        cl::Kernel kernel = program.kernel(name);
        std::vector<cl::Buffer> buffers;
        for (std::size_t c = 0; c < columns.size(); ++c) {
            buffers.push_back(program.buffer(bytes));
            program.queue().enqueueWriteBuffer(buffers[c], CL_TRUE, 0, bytes, columns[c].data());
            kernel.setArg(static_cast<cl_uint>(c), buffers[c]);
        }
        program.launch(kernel, items);
        for (std::size_t c = inputs; c < columns.size(); ++c)
            program.queue().enqueueReadBuffer(buffers[c], CL_TRUE, 0, bytes, columns[c].data());
    });
    columns.erase(columns.begin(), columns.begin() + static_cast<std::ptrdiff_t>(inputs));
    for (auto& column : columns) column.resize(items);
    return columns;
}

}  // namespace

std::vector<double> losses(const runtime::Device& device, const Surface& surface,
                           const std::vector<View>& views, int points) {
    const std::string switches =
        fmt::format(" -DVNDF_SAMPLING={} -DVNDF_FRESNEL=none -DVNDF_ALBEDO_POINTS={}",
                    surface.ndf == "ggx" ? "conic" : "plain", points);
    const runtime::Program program(device, runtime::Math::strict, runtime::Real::f32,
                                   options("albedo", surface, switches));
    const Columns found = run(program, "vndf_batch_albedo", columns_of(views), 1);
    return {found[0].begin(), found[0].end()};
}

std::vector<GlassAlbedo> glass_albedos(const runtime::Device& device, const Surface& surface,
                                       const std::vector<View>& views, const std::vector<double>& etas,
                                       int points, int walks) {
    const runtime::Program program(
        device, runtime::Math::strict, runtime::Real::f32,
        options("glass", surface,
                fmt::format(" -DVNDF_SAMPLING=plain -DVNDF_ALBEDO_POINTS={} -DVNDF_GLASS_WALKS={}", points,
                            walks)));
    Columns in = columns_of(views);
    in.emplace_back(etas.begin(), etas.end());
    const Columns found = run(program, "vndf_batch_glass", in, 3);
    std::vector<GlassAlbedo> albedos;
    for (std::size_t i = 0; i < views.size(); ++i) albedos.push_back({found[0][i], found[1][i], found[2][i]});
    return albedos;
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

GlassViews glass_views() {
    GlassViews all;
    for (int layer = 0; layer < 2 * GlassTable::layers; ++layer)
        for (int row = 0; row < GlassTable::rows; ++row)
            for (int column = 0; column < GlassTable::columns; ++column) {
                const double alpha = glass_alpha_of(row == 0 ? .25 : row),
                             cosine = glass_cosine_of(column == 0 ? .02 : column, alpha);
                all.views.push_back(in_plane(cosine, alpha));
                all.etas.push_back(glass_eta_of(layer));
            }
    return all;
}

GlassTable measured_glass(const runtime::Device& device, const Surface& surface) {
    const GlassViews all = glass_views();
    GlassTable table{surface, {}};
    for (const GlassAlbedo& albedo : glass_albedos(device, surface, all.views, all.etas))
        for (const float part : glass_parts_of(albedo)) table.parts.push_back(part);
    return table;
}

}  // namespace vndf::energy
