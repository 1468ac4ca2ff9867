// clvndf render
#include <chrono>
#include <cmath>
#include <memory>

#include <fmt/format.h>

#include "cli/commands.h"
#include "cli/interrupt.h"
#include "cli/options.h"
#include "cli/output_file.h"
#include "cli/progress.h"
#include "cli/render_scene.h"
#include "cli/streams.h"
#include "error.h"
#include "render/effects.h"
#include "render/explain.h"
#include "render/image.h"

namespace vndf::cli {
namespace {

using Clock = std::chrono::steady_clock;

struct Render {
    std::string output = "render.png", size = "960x340", math = "strict", device, effects = "auto";
    SceneOptions scene;
    render::Choices choices;
    CLI::Option* sampler = nullptr;
    bool explain = false;
    std::uint64_t spp = 64;
    double seconds = 0, target_error = 0;  // 0: not asked for
    unsigned max_bounces = 6;
};

// "960x340"; as many pixels as 32-bit numbers count, beside those of the padding.
void set_size(const std::string& text, render::Settings& settings) {
    constexpr unsigned longest = 32768;
    const auto number = [&](std::string_view part) -> unsigned {
        unsigned value = 0;
        const auto [end, error] = std::from_chars(part.data(), part.data() + part.size(), value);
        return error == std::errc() && end == part.data() + part.size() && value <= longest ? value : 0;
    };
    const std::size_t x = std::min(text.find('x'), text.size());
    settings.width = number(std::string_view(text).substr(0, x));
    settings.height = x < text.size() ? number(std::string_view(text).substr(x + 1)) : 0;
    if (settings.width == 0 || settings.height == 0)
        throw InputError(
            fmt::format("--size '{}': expected WxH, such as 960x340, each from 1 to {}", text, longest));
}

class Goal {
  public:
    Goal(const Render& r, std::uint64_t pixels) : r_(r), pixels_(pixels) {}

    double elapsed() const { return std::chrono::duration<double>(Clock::now() - start_).count(); }
    bool late() const { return r_.seconds > 0 && elapsed() >= r_.seconds; }
    // What is done of it, given the samples of single pixels and the error so far.
    double share(std::uint64_t samples, double error) const {
        double share = 0;
        if (r_.seconds > 0) share = elapsed() / r_.seconds;
        // Errors fall with the root of the number of samples.
        if (r_.target_error > 0) share = std::max(share, std::pow(r_.target_error / error, 2));
        if (bounded())
            share = std::max(share, static_cast<double>(samples) / (static_cast<double>(r_.spp) * pixels_));
        return std::min(share, 1.0);
    }
    // Whether --spp is the goal, as it is without another.
    bool bounded() const { return r_.seconds == 0 && r_.target_error == 0; }

  private:
    const Render& r_;
    double pixels_;
    Clock::time_point start_ = Clock::now();
};

// How good the image is, seldom enough to cost nothing: whenever the samples have grown by a quarter.
bool worth_a_look(std::uint64_t samples, std::uint64_t looked_at) {
    return samples >= 16 && samples >= looked_at + looked_at / 4;
}

void trace(const Render& r, render::Wavefront& wavefront, std::uint64_t pixels, const Interrupt& interrupt,
           const Common& common) {
    const Progress progress(common.quiet);
    const Goal goal(r, pixels);
    std::uint64_t looked_at = 0;
    double error = 1;
    const auto stop = [&] {
        const std::uint64_t samples = wavefront.pixel_samples();
        const double share = goal.share(samples, error), elapsed = goal.elapsed();
        progress(fmt::format("{:.1f} Msamples/s, {:.0f} s left, error {}", samples / elapsed / 1e6,
                             share > 0 ? elapsed * (1 - share) / share : 0,
                             error < 1 ? fmt::format("{:.2g}", error) : "not yet known"),
                 share);
        return interrupt.asked() || (goal.late() && wavefront.samples() > 0);
    };
    while (!goal.bounded() || wavefront.samples() < r.spp) {
        if (!wavefront.add_sample(stop)) break;
        if (worth_a_look(wavefront.samples(), looked_at)) {
            looked_at = wavefront.samples();
            error = wavefront.image().error;
            if (r.target_error > 0 && error <= r.target_error) break;
        }
    }
    if (interrupt.asked() && !common.quiet) {
        progress.clear();
        remark("clvndf: interrupted; {} holds what is there\n", r.output);
    }
}

// Beckmann has no bounded sampler, which is the default.
render::Choices choices_of(const Render& r) {
    render::Choices choices = r.choices;
    if (r.sampler->count() == 0 && choices.ndf == "beckmann") choices.sampler = "plain";
    return choices;
}

void run(const Render& r, Common& common) {
    const Clock::time_point start = Clock::now();
    render::Settings settings;
    set_size(r.size, settings);
    settings.max_bounces = r.max_bounces;
    settings.seed = common.seed;
    settings.random = r.choices.random == "philox" ? render::Random::philox : render::Random::sobol;
    render::require_image_name(r.output);
    const ShownScene shown = shown_scene(r.scene);
    const render::Scene& scene = shown.scene;
    if (!common.quiet)
        for (const auto& [warning, count] : shown.warnings)
            remark("clvndf: warning: {}{}\n", warning, count > 1 ? fmt::format(" ({} times)", count) : "");
    const std::vector<render::Effect> effects = render::effects_for(scene, r.effects);
    const render::Switches switches = render::switches(scene, effects, choices_of(r));
    const runtime::Device device = [&] {
        Target target;
        target.device = r.device;
        return target.choose(common);
    }();
    OutputFile file(r.output);
    const Interrupt interrupt;
    const render::Tree tree = render::build_tree(scene);
    if (r.explain)
        put(render::explanation({device, math_named(r.math), scene, tree, effects, choices_of(r), settings}));
    const auto stages = render::device_stages(device, math_named(r.math), switches);
    render::Wavefront wavefront(*stages, scene, tree, settings);
    trace(r, wavefront, std::uint64_t{settings.width} * settings.height, interrupt, common);

    const render::Image image = wavefront.image();
    const double seconds = std::chrono::duration<double>(Clock::now() - start).count();
    file.write(render::encoded(image, r.output,
                               {{"software", "clvndf " CLVNDF_VERSION},
                                {"scene", scene.name},
                                {"samples per pixel", fmt::format("{:.6g}", image.samples)},
                                {"estimated error", fmt::format("{:.3g}", image.error)},
                                {"seed", fmt::format("{}", common.seed)},
                                {"random numbers", r.choices.random},
                                {"switches", switches.materials},
                                {"math", r.math},
                                {"longest path", fmt::format("{} surfaces", r.max_bounces)},
                                {"device", stages->describe()},
                                {"seconds", fmt::format("{:.2f}", seconds)}}));
    file.commit();
    if (!common.quiet)
        remark("{}: {} x {}, {:.6g} samples per pixel, {:.1f} s, error {:.2g}\n", r.output, image.width,
               image.height, image.samples, seconds, image.error);
    if (image.bad_pixels != 0) {
        remark("clvndf: {} samples in {} pixels were no finite numbers and are left out\n", image.bad_samples,
               image.bad_pixels);
        common.exit_status = 1;
    }
}

}  // namespace

void add_render(CLI::App& app, Common& common) {
    CLI::App* command = app.add_subcommand("render", "path-trace a scene with the samplers, to an image");
    const auto r = std::make_shared<Render>();
    command->add_option("-o,--output", r->output, "image to write: .exr or .png")->capture_default_str();
    command->add_option("--size", r->size, "width and height in pixels, WxH")->capture_default_str();
    CLI::Option* const spp =
        add_number(*command, "--spp", r->spp, std::uint64_t{1}, std::uint64_t{1} << 24, "samples per pixel");
    spp->default_str("64");
    add_number(*command, "--time", r->seconds, 0.001, 1e6, "instead: as many as these seconds allow")
        ->excludes(spp);
    add_number(*command, "--target-error", r->target_error, 1e-6, 1.0,
               "instead: until the estimated error, relative to the mean luminance, is at most this")
        ->excludes(spp);
    add_number(*command, "--max-bounces", r->max_bounces, 0u, 128u, "surfaces that a path may visit")
        ->default_str("6");
    const auto choice = [&](const char* name, std::string& value, const char* description,
                            const std::vector<std::string>& values) {
        return command->add_option(name, value, description)
            ->check(CLI::IsMember(values))
            ->capture_default_str();
    };
    r->sampler =
        choice("--sampler", r->choices.sampler,
               "how metals draw directions: bounded, plain or conic visible normals; to compare with, ndf:\n"
               "any normals, and cosine: none",
               render::samplers());
    choice("--ndf", r->choices.ndf, "distribution of normals: ggx or beckmann", {"ggx", "beckmann"});
    choice("--masking", r->choices.masking, "masking and shadowing: correlated or separable",
           {"correlated", "separable"});
    choice("--energy", r->choices.energy,
           "what scatters between facets: none (it is lost), turquin or kulla_conty",
           {"none", "turquin", "kulla_conty"});
    choice("--random", r->choices.random, "random numbers: sobol, scrambled after Owen, or philox",
           {"sobol", "philox"});
    choice("--math", r->math, "policy of elementary functions: strict, builtin or native",
           {"strict", "builtin", "native"});
    command
        ->add_option("--effects", r->effects,
                     "auto, what the scene calls for; all; or names, with commas between them")
        ->capture_default_str();
    command->add_flag("--explain", r->explain,
                      "print which effects the scene calls for and what each costs here");
    CLI::Option* const file = command->add_option("SCENE", r->scene.file, "a scene: .gltf or .glb");
    command->add_option("--orbs", r->scene.orbs, "without a file: what five orbs are of")
        ->check(CLI::IsMember(render::orb_kinds()))
        ->capture_default_str()
        ->excludes(file);
    command->add_option("--camera", r->scene.camera, "of the file: a name or a number; the first without it")
        ->needs(file);
    CLI::Option* const sky =
        choice("--sky", r->scene.sky,
               "day: blue, with a sun; none: dark; to compare with others, white: as bright everywhere, and "
               "sunlit:\n"
               "white with the day's sun; auto: day, but none where a file has lights of its own",
               {"auto", "day", "none", "white", "sunlit"});
    CLI::Option* const environment = command
                                         ->add_option("--env", r->scene.environment,
                                                      "in its place, an image from all around: .exr or .hdr")
                                         ->excludes(sky);
    add_number(*command, "--env-rotation", r->scene.rotation, -3600.0f, 3600.0f,
               "degrees by which it is turned, counterclockwise seen from above")
        ->needs(environment);
    add_device(*command, r->device);
    command->callback([r, &common] { common.action = [r, &common] { run(*r, common); }; });
}

}  // namespace vndf::cli
