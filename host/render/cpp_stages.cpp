#include "render/cpp_stages.h"

#include <algorithm>
#include <cstring>

#include <fmt/format.h>

#include "kernels/render/paths.cl"

#include "error.h"
#include "parallel.h"
#include "render/cpp_run.h"
#include "render/stages.h"

namespace vndf::render {
namespace {

Runs runs_of(const std::string& ndf, const std::string& fresnel) {
    Runs runs{
        {"generate", Runner<vndf_render_generate>::run}, {"traverse", Runner<vndf_render_traverse>::run},
        {"packets", Runner<vndf_render_packets>::run},   {"survive", Runner<vndf_render_survive>::run},
        {"shadow", Runner<vndf_render_shadow>::run},     {"count", Runner<vndf_render_count>::run},
        {"offsets", Runner<vndf_render_offsets>::run},   {"list", Runner<vndf_render_list>::run},
        {"move", Runner<vndf_render_move>::run},         {"accumulate", Runner<vndf_render_accumulate>::run}};
#define CLVNDF_TAKE(ndf_, fresnel_) \
    if (ndf == #ndf_ && fresnel == #fresnel_) runs.merge(cpp_materials_##ndf_##_##fresnel_());
    CLVNDF_CPP_MATERIALS(CLVNDF_TAKE)
#undef CLVNDF_TAKE
    if (runs.count("surface") == 0)
        throw InputError(
            fmt::format("no materials are compiled as C++ for ndf {} and fresnel {}", ndf, fresnel));
    return runs;
}

class CppStages final : public Stages {
  public:
    explicit CppStages(Runs runs) : runs_(std::move(runs)) {}

    Buffer buffer(std::size_t bytes) override {
        // Never empty, as on devices.
        buffers_.emplace_back(std::max<std::size_t>(1, (bytes + 3) / 4), 0.0f);
        return buffers_.size() - 1;
    }
    void write(Buffer to, const void* from, std::size_t bytes, std::size_t offset) override {
        std::memcpy(reinterpret_cast<char*>(buffers_[to].data()) + offset, from, bytes);
    }
    void read(Buffer from, void* to, std::size_t bytes, std::size_t offset) override {
        std::memcpy(to, reinterpret_cast<const char*>(buffers_[from].data()) + offset, bytes);
    }
    void launch(const std::string& stage, std::size_t items, Arguments arguments) override {
        std::vector<Given> given;
        for (const Argument& argument : arguments)
            given.push_back({argument.value ? nullptr : buffers_[argument.buffer].data(), argument.value});
        const Run run = runs_.at(stage);
        // Items that wait for nobody else's: those that add to a place shared by all beyond the count are the last ones,
        // which one thread runs.
        parallel_for(runtime::whole_groups(items), 1024,
                     [&](unsigned, std::size_t begin, std::size_t end) { run(given, begin, end); });
    }
    std::string describe() const override { return "C++"; }
    std::size_t bytes() const override {
        std::size_t sum = 0;
        for (const auto& buffer : buffers_) sum += buffer.size() * sizeof(float);
        return sum;
    }
    unsigned packet() const override { return VNDF_PACKET; }
    bool has(const std::string& stage) const override { return runs_.count(stage) != 0; }

  private:
    Runs runs_;
    std::vector<std::vector<float>> buffers_;
};

}  // namespace

std::unique_ptr<Stages> cpp_stages(const std::string& ndf, const std::string& fresnel) {
    return std::make_unique<CppStages>(runs_of(ndf, fresnel));
}

}  // namespace vndf::render
