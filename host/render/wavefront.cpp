#include "render/wavefront.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <utility>

#include "render/tables.h"
#include "splitmix64.h"

namespace vndf::render {
namespace {

constexpr unsigned roulette_from = 3;  // bounces that every path lives

// Random numbers of a sample: of the camera, two quads of each bounce, and for each bounce another.
std::size_t quads(const Settings& settings) {
    return VNDF_QUAD_PICK(std::max(1u, settings.max_bounces)) + std::max(1u, settings.max_bounces);
}

// In which of two halves a sample counts: by the digits of its number, so that each half has samples from all over the pixel.
// Those with odd numbers are, of Sobol's sequence, on one side of it.
bool other_half(std::uint64_t sample) {
    return std::popcount(sample) % 2 == 1;
}

constexpr std::size_t whole_chunks(std::size_t items) {
    return (items + VNDF_CHUNK - 1) / VNDF_CHUNK * VNDF_CHUNK;
}

// A cell of darkness, for programs that know environments where the scene has none.
const Environment& no_environment() {
    static const Environment dark{1, std::vector<float>(27), {0}, {1}, {0}};
    return dark;
}

}  // namespace

Wavefront::Wavefront(Stages& stages, const Scene& scene, const Tree& tree, const Settings& settings)
    : stages_(stages),
      settings_(settings),
      pixels_(settings.width * settings.height),
      queue_(static_cast<std::uint32_t>(whole_chunks(std::min<std::size_t>(settings.queue, pixels_)))),
      // Behind the queue and behind the film, places for what nobody reads.
      stride_(queue_ + runtime::group_size),
      film_stride_(pixels_ + 1),
      view_(view_of(scene.camera, settings.width, settings.height)),
      sizes_(sizes_of(scene)),
      media_(stages.has("media")),
      dressed_(stages.has("dress")),
      shines_(stages.has("glow")),
      balls_(stages.has("spheres")),
      cones_(stages.has("cones")),
      lamp_table_(lamps_of(scene)),
      words_(settings.random, settings.seed, static_cast<unsigned>(quads(settings))),
      nodes_(stages.upload(tree.nodes)),
      leaves_(stages.upload(tree.leaves)),
      vertices_(stages.upload(vertex_table(scene))),
      triangles_(stages.upload(triangle_table(scene))),
      materials_(stages.upload(material_table(scene))),
      dressings_(stages.upload(dressing_table(scene))),
      textures_(stages.upload(texture_table(scene))),
      texels_(stages.upload(texel_table(scene))),
      lamps_(stages.upload(lamp_table_.planes)),
      lamp_numbers_(stages.upload(lamp_table_.numbers)),
      lamp_densities_(stages.upload(lamp_table_.densities)),
      points_(stages.upload(point_table(scene))),
      spheres_(stages.upload(sphere_table(scene))) {
    sky_ = sky_of(scene, lamp_table_, settings.samples_caps);
    const Environment& e = scene.environment.side > 0 ? scene.environment : no_environment();
    around_ = stages.upload(e.radiance);
    around_pdf_ = stages.upload(e.pdf);
    around_keep_ = stages.upload(e.keep);
    around_other_ = stages.upload(e.other);
    memory_.tree = (tree.nodes.size() + tree.leaves.size()) * sizeof(float);
    memory_.scene = stages.bytes() - memory_.tree;
    const auto planes = [&](std::size_t count) { return stages_.buffer(count * stride_ * sizeof(float)); };
    for (int side = 0; side < 2; ++side) {
        path_[side] = planes(VNDF_PATH_PLANES);
        slot_[side] = planes(1);
        hit_[side] = planes(VNDF_HIT_PLANES + balls_);
        triangle_[side] = planes(1);
    }
    lights_ = planes(VNDF_LIGHT_PLANES + cones_);
    surface_ = planes(VNDF_SURFACE_PLANES);
    material_ = planes(1);
    look_ = planes(dressed_ ? VNDF_LOOK_PLANES : 0);
    from_ = planes(1);
    offset_ = planes(1);
    light_ = planes(3);
    memory_.paths = stages.bytes() - memory_.tree - memory_.scene;
    memory_.path = memory_.paths / stride_;
    film_ = stages_.buffer(std::size_t{VNDF_FILM_PLANES} * film_stride_ * sizeof(float));
    word_buffer_ = stages_.buffer(VNDF_QUAD_WORDS * quads(settings) * sizeof(std::uint32_t));
}

void Wavefront::prepare_sample() {
    const std::vector<std::uint32_t> words = words_.of(samples_);
    stages_.write(word_buffer_, words.data(), words.size() * sizeof(std::uint32_t));
}

void Wavefront::add_queueful(std::uint32_t first, std::uint32_t count) {
    trace(first, count);
    const float odd = other_half(samples_) ? 1.0f : 0.0f;
    stages_.launch("accumulate", count, {light_, first, count, stride_, film_stride_, odd, film_});
}

bool Wavefront::add_sample(const std::function<bool()>& stop) {
    prepare_sample();
    for (std::uint32_t first = ahead_; first < pixels_; first += queue_) {
        const std::uint32_t count = std::min(queue_, pixels_ - first);
        add_queueful(first, count);
        ahead_ = first + count;
        if (ahead_ < pixels_ && stop()) return false;
    }
    ahead_ = 0;
    ++samples_;
    return !stop();
}

void Wavefront::add(Part& part) {
    if (part.pixels == 0) return;
    const std::size_t bytes = part.pixels * sizeof(float);
    const auto offset = [&](std::size_t plane) {
        return (plane * film_stride_ + part.first) * sizeof(float);
    };
    for (std::size_t k = 0; k < VNDF_FILM_PLANES; ++k)
        stages_.write(film_, &part.film[k * part.pixels], bytes, offset(k));
    const std::uint32_t end = part.first + part.pixels;
    for (samples_ = part.sample; samples_ < part.sample + part.samples; ++samples_) {
        prepare_sample();
        for (std::uint32_t first = part.first; first < end; first += queue_)
            add_queueful(first, std::min(queue_, end - first));
    }
    for (std::size_t k = 0; k < VNDF_FILM_PLANES; ++k)
        stages_.read(film_, &part.film[k * part.pixels], bytes, offset(k));
}

void Wavefront::trace(std::uint32_t first, std::uint32_t count) {
    // Paths from one side to the other: of those traced to those that met something, which come back in their places.
    auto path = path_[0], slot = slot_[0], moved = path_[1], moved_slot = slot_[1];
    stages_.launch("generate", count, {&view_, word_buffer_, first, stride_, path, slot, light_});
    for (unsigned bounce = 0;; ++bounce) {
        const std::uint32_t ray_salt = salt(bounce, false);
        const std::uint32_t packet = bounce == 0 ? stages_.packet() : 1;
        stages_.launch(packet > 1 ? "packets" : "traverse", (count + packet - 1) / packet,
                       {nodes_, leaves_, &sizes_, vertices_, triangles_, dressings_, textures_, texels_, slot,
                        first, ray_salt, path, count, stride_, hit_[0], triangle_[0]});
        const std::uint32_t light_quad = VNDF_QUAD_LIGHT + VNDF_QUAD_BOUNCE * bounce;
        // Behind the last bounce there are no random numbers, and no use for one.
        const std::uint32_t channel_quad = bounce == settings_.max_bounces ? 0 : light_quad;
        for (std::uint32_t row = 0; balls_ && row < sky_.spheres; ++row)
            stages_.launch(
                "spheres", count,
                {&sky_, spheres_, row, &sizes_, materials_, hit_[0], path, slot, count, stride_, light_});
        if (media_)
            stages_.launch("media", count,
                           {&sizes_, vertices_, triangles_, materials_, hit_[0], triangle_[0], word_buffer_,
                            channel_quad, slot, first, count, stride_, path});
        stages_.launch("leave", count,
                       {&sky_, around_, around_pdf_, path, triangle_[0], slot, count, stride_, light_});
        if (bounce == settings_.max_bounces && !shines_) return;
        const auto chunks = static_cast<std::uint32_t>(whole_chunks(count) / VNDF_CHUNK);
        stages_.launch("count", chunks, {triangle_[0], count, chunks, offset_});
        stages_.launch("offsets", 1, {chunks, offset_});
        stages_.launch("list", chunks, {triangle_[0], count, chunks, stride_, offset_, from_});
        stages_.read(offset_, &count, sizeof count, chunks * sizeof count);
        if (count == 0) return;
        stages_.launch("move", count,
                       {path, slot, hit_[0], triangle_[0], from_, count, stride_, moved, moved_slot, hit_[1],
                        triangle_[1]});
        std::swap(path, moved);
        std::swap(slot, moved_slot);
        turn(first, count, bounce, path, slot);
        if (bounce == settings_.max_bounces) return;
    }
}

// Of the rays of a bounce of this sample, for what their chance to pass a surface is made from.
std::uint32_t Wavefront::salt(unsigned bounce, bool shadow) const {
    return static_cast<std::uint32_t>(
        splitmix64(settings_.seed ^ splitmix64((samples_ << 16) + 2 * bounce + shadow)));
}

// What happens on the surfaces that the paths met.
void Wavefront::turn(std::uint32_t first, std::uint32_t count, unsigned bounce, Stages::Buffer path,
                     Stages::Buffer slot) {
    const std::uint32_t light_quad = VNDF_QUAD_LIGHT + VNDF_QUAD_BOUNCE * bounce,
                        bsdf_quad = VNDF_QUAD_BSDF + VNDF_QUAD_BOUNCE * bounce;
    const std::int32_t roulette = bounce >= roulette_from;
    stages_.launch("surface", count,
                   {&sizes_, vertices_, triangles_, dressings_, textures_, texels_, hit_[1], triangle_[1],
                    count, stride_, path, surface_, material_});
    if (dressed_)
        stages_.launch("dress", count,
                       {&sizes_, vertices_, triangles_, dressings_, textures_, texels_, materials_, hit_[1],
                        triangle_[1], count, stride_, look_});
    if (shines_)
        stages_.launch("glow", count,
                       {&sizes_, &sky_, materials_, material_, look_, lamp_densities_, triangle_[1], surface_,
                        path, slot, count, stride_, light_});
    if (bounce == settings_.max_bounces) return;
    const std::uint32_t pick_quad = VNDF_QUAD_PICK(settings_.max_bounces) + bounce,
                        shadow_salt = salt(bounce, true);
    stages_.launch("lights", count, {&sky_,      around_,       around_pdf_, around_keep_, around_other_,
                                     lamps_,     lamp_numbers_, points_,     spheres_,     &sizes_,
                                     vertices_,  triangles_,    dressings_,  textures_,    texels_,
                                     materials_, word_buffer_,  light_quad,  pick_quad,    slot,
                                     first,      surface_,      path,        stride_,      lights_});
    if (cones_)
        stages_.launch("cones", count,
                       {&sizes_, materials_, material_, look_, surface_, path, word_buffer_, light_quad,
                        pick_quad, slot, first, stride_, lights_});
    stages_.launch("connect", count,
                   {&sizes_, materials_, material_, look_, surface_, path, stride_, lights_});
    stages_.launch("shadow", count,
                   {nodes_, leaves_, &sizes_, vertices_, triangles_, dressings_, textures_, texels_, path,
                    lights_, slot, first, shadow_salt, count, stride_, light_});
    stages_.launch("scatter", count,
                   {&sizes_, materials_, material_, look_, surface_, word_buffer_, bsdf_quad, slot, first,
                    stride_, path});
    stages_.launch("survive", count,
                   {surface_, word_buffer_, bsdf_quad, slot, first, stride_, roulette, path});
}

State Wavefront::state() {
    State state{samples_, ahead_, std::vector<float>(std::size_t{VNDF_FILM_PLANES} * film_stride_)};
    stages_.read(film_, state.film.data(), state.film.size() * sizeof(float));
    return state;
}

void Wavefront::resume(const State& state) {
    samples_ = state.samples;
    ahead_ = state.ahead;
    stages_.write(film_, state.film.data(), state.film.size() * sizeof(float));
}

Image Wavefront::image() {
    return image_of(state(), settings_);
}

Image image_of(const State& state, const Settings& settings) {
    const std::uint32_t pixels = settings.width * settings.height;
    const auto plane = [&](std::size_t k, std::size_t pixel) {
        return state.film[k * (pixels + std::size_t{1}) + pixel];
    };
    Image image{settings.width, settings.height, std::vector<float>(std::size_t{3} * pixels)};
    image.samples = static_cast<double>(state.samples * pixels + state.ahead) / pixels;
    double sum = 0, square = 0;
    for (std::uint32_t pixel = 0; pixel < pixels; ++pixel) {
        const std::uint64_t taken = state.samples + (pixel < state.ahead);
        const double bad = plane(VNDF_FILM_BAD, pixel),
                     good = std::max(1.0, static_cast<double>(taken) - bad);
        image.bad_pixels += bad > 0;
        image.bad_samples += static_cast<std::uint64_t>(bad);
        for (int channel = 0; channel < 3; ++channel)
            image.pixels[3 * pixel + channel] =
                static_cast<float>(plane(VNDF_FILM_RED + channel, pixel) / good);
        const float* const rgb = &image.pixels[3 * pixel];
        const double mean = luminance(rgb[0], rgb[1], rgb[2]);
        sum += mean;
        // Two halves differ by twice the error of their mean.
        const std::uint64_t others = taken / 2 + (taken % 2 == 1 && other_half(taken - 1));
        const double odd = plane(VNDF_FILM_ODD, pixel) / std::max<std::uint64_t>(1, others);
        square += (odd - mean) * (odd - mean);
    }
    image.error = state.samples < 2 || sum == 0 ? 1 : std::sqrt(square / pixels) / (sum / pixels);
    return image;
}

}  // namespace vndf::render
