#include "render/checkpoint.h"

#include <cstring>
#include <fmt/format.h>

#include "error.h"
#include "hash.h"
#include "render/tables.h"

namespace vndf::render {
namespace {

constexpr std::string_view magic = "clvndf checkpoint 1\n";

std::string_view bytes_of(const void* from, std::size_t size) {
    return {static_cast<const char*>(from), size};
}

}  // namespace

std::string fingerprint(const Scene& scene, const Settings& settings, std::string_view program) {
    const vndf_render_view view = view_of(scene.camera, settings.width, settings.height);
    const vndf_render_sky sky = sky_of(scene, lamps_of(scene));
    std::uint64_t hash = fnv1a(bytes_of(&view, sizeof view));
    const auto add = [&](const auto& table) {
        hash = fnv1a(bytes_of(table.data(), table.size() * sizeof table[0]), hash);
    };
    hash = fnv1a(bytes_of(&sky, sizeof sky), hash);
    add(vertex_table(scene));
    add(triangle_table(scene));
    add(material_table(scene));
    add(dressing_table(scene));
    add(texture_table(scene));
    add(texel_table(scene));
    add(point_table(scene));
    add(sphere_table(scene));
    add(scene.environment.radiance);
    return fmt::format("{} x {}, {} surfaces, seed {}, program {:016x}, scene {:016x}", settings.width,
                       settings.height, settings.max_bounces, settings.seed, fnv1a(program), hash);
}

std::string checkpoint(const State& state, const std::string& fingerprint) {
    std::string bytes(magic);
    const auto add = [&](const void* from, std::size_t size) { bytes += bytes_of(from, size); };
    const std::uint64_t numbers[] = {fingerprint.size(), state.samples, state.ahead, state.film.size()};
    add(numbers, sizeof numbers);
    bytes += fingerprint;
    add(state.film.data(), state.film.size() * sizeof(float));
    const std::uint64_t sum = fnv1a(bytes);
    add(&sum, sizeof sum);
    return bytes;
}

State state_of(std::string_view bytes, const std::string& fingerprint, const std::string& file) {
    std::uint64_t numbers[4], sum = 0;
    const std::size_t head = magic.size() + sizeof numbers;
    if (!bytes.starts_with(magic) || bytes.size() < head + sizeof sum)
        throw InputError(fmt::format("--checkpoint '{}': no checkpoint of this version", file));
    std::memcpy(&sum, bytes.data() + bytes.size() - sizeof sum, sizeof sum);
    std::memcpy(numbers, bytes.data() + magic.size(), sizeof numbers);
    if (sum != fnv1a(bytes.substr(0, bytes.size() - sizeof sum)))
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
