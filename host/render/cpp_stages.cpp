#include <cstring>
#include <map>
#include <tuple>
#include <utility>

#include "kernels/render/materials.cl"
#include "kernels/render/paths.cl"

#include "parallel.h"
#include "render/stages.h"

namespace vndf::render {
namespace {

// What an argument is for a stage: the address of the buffer, or the value.
struct Given {
    void* buffer;
    const void* value;
};

template <class T>
T as(const Given& given) {
    if constexpr (std::is_pointer_v<T>) {
        return static_cast<T>(given.buffer);
    } else {
        T value;
        std::memcpy(&value, given.value, sizeof value);
        return value;
    }
}

using Run = void (*)(const std::vector<Given>& given, std::size_t begin, std::size_t end);

template <auto stage>
struct Runner;
template <class... Types, void (*stage)(Types...)>
struct Runner<stage> {
    static void run(const std::vector<Given>& given, std::size_t begin, std::size_t end) {
        run(given, begin, end, std::index_sequence_for<Types...>());
    }
    template <std::size_t... index>
    static void run(const std::vector<Given>& given, std::size_t begin, std::size_t end,
                    std::index_sequence<index...>) {
        const std::tuple<Types...> arguments{as<Types>(given[index])...};
        for (std::size_t i = begin; i < end; ++i) {
            vndf_render_item = static_cast<uint>(i);
            std::apply(stage, arguments);
        }
    }
};

const std::map<std::string, Run>& runs() {
    static const std::map<std::string, Run> all{
        {"generate", Runner<vndf_render_generate>::run},    {"traverse", Runner<vndf_render_traverse>::run},
        {"leave", Runner<vndf_render_leave>::run},          {"lights", Runner<vndf_render_lights>::run},
        {"surface", Runner<vndf_render_surface>::run},      {"connect", Runner<vndf_render_connect>::run},
        {"scatter", Runner<vndf_render_scatter>::run},      {"survive", Runner<vndf_render_survive>::run},
        {"shadow", Runner<vndf_render_shadow>::run},        {"rank", Runner<vndf_render_rank>::run},
        {"offsets", Runner<vndf_render_offsets>::run},      {"move", Runner<vndf_render_move>::run},
        {"accumulate", Runner<vndf_render_accumulate>::run}};
    return all;
}

class CppStages final : public Stages {
  public:
    Buffer buffer(std::size_t bytes) override {
        buffers_.emplace_back((bytes + 3) / 4, 0.0f);
        return buffers_.size() - 1;
    }
    void write(Buffer to, const void* from, std::size_t bytes) override {
        std::memcpy(buffers_[to].data(), from, bytes);
    }
    void read(Buffer from, void* to, std::size_t bytes, std::size_t offset) override {
        std::memcpy(to, reinterpret_cast<const char*>(buffers_[from].data()) + offset, bytes);
    }
    void launch(const std::string& stage, std::size_t items, Arguments arguments) override {
        std::vector<Given> given;
        for (const Argument& argument : arguments)
            given.push_back({argument.value ? nullptr : buffers_[argument.buffer].data(), argument.value});
        const Run run = runs().at(stage);
        // Items that wait for nobody else's: those that add to a place shared by all beyond the count are the last ones,
        // which one thread runs.
        parallel_for(runtime::whole_groups(items), 1024,
                     [&](unsigned, std::size_t begin, std::size_t end) { run(given, begin, end); });
    }
    std::string describe() const override { return "C++"; }

  private:
    std::vector<std::vector<float>> buffers_;
};

}  // namespace

std::unique_ptr<Stages> cpp_stages() {
    return std::make_unique<CppStages>();
}

}  // namespace vndf::render
