// The path tracer: one path for each pixel in flight, its stages over queues (kernels/render), samples added in order.
//
// Neither the size of the queues nor the number of threads changes a bit of the result: a path depends on its pixel and sample
// alone, and each pixel's light is added by one path at a time.
#pragma once

#include <cstdint>
#include <functional>

#include "render/scene.h"
#include "render/stages.h"
#include "render/tables.h"
#include "render/tree.h"
#include "render/words.h"

namespace vndf::render {

struct Settings {
    unsigned width = 960, height = 340;
    unsigned max_bounces = 6;  // surfaces that a path may visit
    std::uint64_t seed = 1;
    Random random = Random::sobol;
    std::size_t queue = std::size_t{1} << 16;  // paths in flight
    bool samples_caps = true;                  // lights that fill a cap; not so with Choices::lights_by bsdf
};

struct Image {
    unsigned width = 0, height = 0;
    std::vector<float> pixels;  // red, green, blue of each, row by row from the top: means over the samples
    double samples = 0;         // of each pixel
    double error = 0;           // estimated, root mean square over the pixels' mean luminance
    std::uint64_t bad_pixels = 0, bad_samples = 0;  // that had no finite number; left out of the means
};

// What a rendering has done so far.
struct State {
    std::uint64_t samples = 0;
    std::uint32_t ahead = 0;  // pixels that have one sample more
    std::vector<float> film;
};

Image image_of(const State& state, const Settings& settings);

// Some pixels, their part of a film plane by plane, and the samples that they are to get next.
struct Part {
    std::uint32_t first = 0, pixels = 0;
    std::uint64_t sample = 0, samples = 0;
    std::vector<float> film;
};

class Wavefront {
  public:
    Wavefront(Stages& stages, const Scene& scene, const Tree& tree, const Settings& settings);

    // Adds a sample to every pixel. stop(), asked after each queueful, may end it before; false if it did.
    bool add_sample(const std::function<bool()>& stop = [] { return false; });

    // Adds its samples to a part of any film, which afterwards has the bits that adding samples to all pixels gives it. Not to
    // be mixed with the others, whose film this one leaves undefined.
    void add(Part& part);

    Image image();
    State state();
    // In place of what this one has done, which is nothing yet.
    void resume(const State& state);
    std::uint64_t samples() const { return samples_; }
    // Bytes on the device: of the scene and its tree, of all paths in flight, and of one.
    struct Memory {
        std::size_t scene = 0, tree = 0, paths = 0, path = 0;
    };
    const Memory& memory() const { return memory_; }
    std::uint32_t lamps() const { return lamp_table_.count; }
    // Samples of single pixels so far.
    std::uint64_t pixel_samples() const { return samples_ * pixels_ + ahead_; }

  private:
    void prepare_sample();
    void add_queueful(std::uint32_t first, std::uint32_t count);
    void trace(std::uint32_t first, std::uint32_t count);
    std::uint32_t salt(unsigned bounce, bool shadow) const;
    void turn(std::uint32_t first, std::uint32_t count, unsigned bounce, Stages::Buffer path,
              Stages::Buffer slot);

    Stages& stages_;
    Settings settings_;
    std::uint32_t pixels_, queue_, stride_, film_stride_;
    vndf_render_view view_;
    vndf_render_sky sky_;
    vndf_render_sizes sizes_;
    bool media_, dressed_, shines_, balls_, cones_;  // whether the program has these stages
    Lamps lamp_table_;
    Words words_;
    Memory memory_;
    std::uint64_t samples_ = 0;
    std::uint32_t ahead_ = 0;  // pixels that have one sample more
    Stages::Buffer nodes_, leaves_, vertices_, triangles_, materials_, dressings_, textures_, texels_;
    Stages::Buffer around_, around_pdf_, around_keep_, around_other_, lamps_, lamp_numbers_, lamp_densities_,
        points_, spheres_, word_buffer_;
    Stages::Buffer path_[2], slot_[2], hit_[2], triangle_[2], lights_, surface_, material_, look_, from_,
        offset_, light_, film_;
};

}  // namespace vndf::render
