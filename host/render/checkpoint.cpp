#include "render/checkpoint.h"

#include <cstring>
#include <fmt/format.h>

#include "error.h"
#include "render/tables.h"
#include "splitmix64.h"

namespace vndf::render {
namespace {

constexpr std::string_view magic = "clvndf checkpoint 1\n";

class Hash {
  public:
    void add(const void* bytes, std::size_t size) {
        const char* from = static_cast<const char*>(bytes);
        for (std::size_t i = 0; i < size; i += sizeof(std::uint64_t)) {
            std::uint64_t word = 0;
            std::memcpy(&word, from + i, std::min(sizeof word, size - i));
            value_ = splitmix64(value_ ^ word) + size;
        }
    }
    template <class T>
    void add(const std::vector<T>& values) {
        add(values.data(), values.size() * sizeof(T));
    }
    std::uint64_t value() const { return value_; }

  private:
    std::uint64_t value_ = 1;
};

}  // namespace

std::string fingerprint(const Scene& scene, const Settings& settings, std::string_view program) {
    Hash hash;
    hash.add(vertex_table(scene));
    hash.add(triangle_table(scene));
    hash.add(material_table(scene));
    hash.add(dressing_table(scene));
    hash.add(texture_table(scene));
    hash.add(texel_table(scene));
    hash.add(point_table(scene));
    hash.add(scene.environment.radiance);
    const vndf_render_view view = view_of(scene.camera, settings.width, settings.height);
    const vndf_render_sky sky = sky_of(scene, lamps_of(scene));
    hash.add(&view, sizeof view);
    hash.add(&sky, sizeof sky);
    Hash code;
    code.add(program.data(), program.size());
    return fmt::format("{} x {}, {} surfaces, seed {}, program {:016x}, scene {:016x}", settings.width,
                       settings.height, settings.max_bounces, settings.seed, code.value(), hash.value());
}

std::string checkpoint(const State& state, const std::string& fingerprint) {
    std::string bytes(magic);
    const auto add = [&](const void* from, std::size_t size) {
        bytes.append(static_cast<const char*>(from), size);
    };
    const std::uint64_t numbers[] = {fingerprint.size(), state.samples, state.ahead, state.film.size()};
    add(numbers, sizeof numbers);
    bytes += fingerprint;
    add(state.film.data(), state.film.size() * sizeof(float));
    Hash hash;
    hash.add(bytes.data(), bytes.size());
    const std::uint64_t sum = hash.value();
    add(&sum, sizeof sum);
    return bytes;
}

State state_of(std::string_view bytes, const std::string& fingerprint, const std::string& file) {
    std::uint64_t numbers[4], sum = 0;
    const std::size_t head = magic.size() + sizeof numbers;
    if (!bytes.starts_with(magic) || bytes.size() < head + sizeof sum)
        throw InputError(fmt::format("--checkpoint '{}': no checkpoint of this version", file));
    Hash hash;
    hash.add(bytes.data(), bytes.size() - sizeof sum);
    std::memcpy(&sum, bytes.data() + bytes.size() - sizeof sum, sizeof sum);
    std::memcpy(numbers, bytes.data() + magic.size(), sizeof numbers);
    if (sum != hash.value())
        throw InputError(fmt::format("--checkpoint '{}': damaged, its sum does not fit its content", file));
    const std::string_view whose = bytes.substr(head, numbers[0]);
    if (whose != fingerprint)
        throw InputError(fmt::format("--checkpoint '{}': of another rendering: {}; this one is {}", file,
                                     whose, fingerprint));
    State state{numbers[1], static_cast<std::uint32_t>(numbers[2]), std::vector<float>(numbers[3])};
    std::memcpy(state.film.data(), bytes.data() + head + numbers[0], numbers[3] * sizeof(float));
    return state;
}

}  // namespace vndf::render
