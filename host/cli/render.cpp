// clvndf render
#include <chrono>
#include <cmath>
#include <filesystem>
#include <limits>
#include <memory>
#include <mutex>
#include <optional>

#include <fmt/format.h>

#include "cli/commands.h"
#include "cli/interrupt.h"
#include "cli/options.h"
#include "cli/output_file.h"
#include "cli/progress.h"
#include "cli/render_report.h"
#include "cli/render_scene.h"
#include "cli/streams.h"
#include "error.h"
#include "file.h"
#include "render/checkpoint.h"
#include "render/effects.h"
#include "render/explain.h"
#include "render/image.h"
#include "render/shared_film.h"

namespace vndf::cli {
namespace {

using Clock = std::chrono::steady_clock;

struct Render {
    std::string output = "render.png", size = "960x340", math = "strict", device, effects = "auto";
    SceneOptions scene;
    render::Choices choices;
    CLI::Option *sampler = nullptr, *orbs = nullptr;
    bool explain = false, effect_costs = false;
    std::string checkpoint, report;  // files
    double stops = 0;
    std::optional<double> exposure;  // the same, if it was given
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

// Where a rendering that is not done goes on later; nothing without --checkpoint.
class Checkpoint {
  public:
    Checkpoint(const std::string& path, const std::string& fingerprint)
        : path_(path), fingerprint_(fingerprint) {}

    const std::string& fingerprint() const { return fingerprint_; }
    // What is there, if anything.
    std::optional<render::State> state() const {
        std::error_code none;
        if (path_.empty() || !std::filesystem::exists(path_, none)) return std::nullopt;
        const std::string bytes = read_file(path_, std::uint64_t{1} << 36);
        return render::state_of(bytes, fingerprint_, path_);
    }
    // of: a Wavefront or a SharedFilm.
    template <class Film>
    void write(Film& of) {
        if (path_.empty()) return;
        OutputFile file(path_);
        file.write(render::checkpoint(of.state(), fingerprint_));
        file.commit();
        written_ = Clock::now();
    }
    template <class Film>
    void write_sometimes(Film& of) {
        if (Clock::now() - written_ > std::chrono::seconds(30)) write(of);
    }

  private:
    std::string path_, fingerprint_;
    Clock::time_point written_ = Clock::now();
};

// Everything that is known before the first ray.
struct Work {
    const Render& r;
    const Common& common;
    const render::Scene& scene;
    const render::Tree& tree;
    const render::Settings& settings;
    const render::Switches& switches;
    const Interrupt& interrupt;
    Clock::time_point start;

    double since_start() const { return std::chrono::duration<double>(Clock::now() - start).count(); }
    runtime::Math math() const { return math_named(r.math); }
    std::uint64_t pixels() const { return std::uint64_t{settings.width} * settings.height; }
};

void show(const Progress& progress, const Goal& goal, std::uint64_t samples, double per_second,
          double error) {
    const double share = goal.share(samples, error), elapsed = goal.elapsed();
    progress(fmt::format("{:.1f} Msamples/s, {:.0f} s left, error {}", per_second / 1e6,
                         share > 0 ? elapsed * (1 - share) / share : 0,
                         error < 1 ? fmt::format("{:.2g}", error) : "not yet known"),
             share);
}

// By one device of this process.
Traced trace(const Work& work, const runtime::Device& device, Checkpoint& checkpoint) {
    const Render& r = work.r;
    const auto stages = render::device_stages(device, work.math(), work.switches);
    render::Wavefront wavefront(*stages, work.scene, work.tree, work.settings);
    if (const auto state = checkpoint.state()) wavefront.resume(*state);
    const Progress progress(work.common.quiet);
    const Goal goal(r, work.pixels());
    const std::uint64_t before = wavefront.pixel_samples();
    Traced traced;
    std::uint64_t looked_at = 0;
    double error = 1;
    const auto speed = [&] {
        return static_cast<double>(wavefront.pixel_samples() - before) / goal.elapsed();
    };
    const auto stop = [&] {
        show(progress, goal, wavefront.pixel_samples(), speed(), error);
        return work.interrupt.asked() || (goal.late() && wavefront.samples() > 0);
    };
    while (!goal.bounded() || wavefront.samples() < r.spp) {
        const bool whole = wavefront.add_sample(stop);
        if (traced.first == 0) traced.first = work.since_start();
        if (!whole) break;
        checkpoint.write_sometimes(wavefront);
        if (worth_a_look(wavefront.samples(), looked_at)) {
            looked_at = wavefront.samples();
            error = wavefront.image().error;
            if (r.target_error > 0 && error <= r.target_error) break;
        }
    }
    traced.samples_per_second = speed();
    checkpoint.write(wavefront);
    traced.image = wavefront.image();
    traced.device = stages->describe();
    traced.memory = wavefront.memory();
    traced.lamps = wavefront.lamps();
    return traced;
}

// A device of several: the stages and the paths in flight.
class Tracer {
  public:
    Tracer(const Work& work, const runtime::Device& device)
        : stages_(render::device_stages(device, work.math(), work.switches)),
          wavefront_(*stages_, work.scene, work.tree, work.settings) {}

    std::string trace(const std::string& task) { return render::trace_part(wavefront_, task); }
    void describe(Traced& traced) const {
        traced.device = stages_->describe();
        traced.memory = wavefront_.memory();
        traced.lamps = wavefront_.lamps();
    }

  private:
    std::unique_ptr<render::Stages> stages_;
    render::Wavefront wavefront_;
};

// When the error is looked at next by who has looked at it after so many samples.
std::uint64_t next_look(std::uint64_t looked_at) {
    return std::max<std::uint64_t>(16, looked_at + looked_at / 4);
}

// By every device of every rank, of which this is the one that leads; to the bits that one device gives.
class TraceTogether {
  public:
    TraceTogether(const Work& work, runtime::Team& team, render::State from, Checkpoint& checkpoint)
        : work_(work),
          team_(team),
          checkpoint_(checkpoint),
          goal_(work.r, work.pixels()),
          film_(work.settings, std::move(from), team.size()),
          before_(samples()) {}

    Traced run() {
        const Render& r = work_.r;
        std::uint64_t looked_at = 0;
        for (bool more = true; more;) {
            std::uint64_t end = goal_.bounded() ? r.spp : std::numeric_limits<std::uint64_t>::max();
            // Only who is to stop at an error has to wait for all to look at it.
            if (r.target_error > 0) end = std::max(next_look(looked_at), film_.state().samples + 1);
            more = trace_up_to(end);
            if (!more || r.target_error == 0) break;
            looked_at = film_.state().samples;
            error_ = render::image_of(film_.state(), work_.settings).error;
            more = error_ > r.target_error;
        }
        traced_.samples_per_second = speed();
        checkpoint_.write(film_);
        traced_.image = render::image_of(film_.state(), work_.settings);
        return std::move(traced_);
    }

  private:
    // False if it was stopped before.
    bool trace_up_to(std::uint64_t end) {
        const std::size_t first = task_;
        runtime::Team::Plan plan;
        plan.window = film_.parts();
        plan.task = [&](std::size_t i) { return film_.task(first + i, end, samples_of_round()); };
        plan.take = [&](std::size_t, const std::string& traced) {
            if (!film_.take(task_++, traced)) return;
            if (traced_.first == 0) traced_.first = work_.since_start();
            checkpoint_.write_sometimes(film_);
        };
        bool stopped = false;
        plan.proceed = [&](std::size_t) {
            show(progress_, goal_, samples(), speed(), error_);
            stopped = work_.interrupt.asked() || (goal_.late() && film_.state().samples > 0);
            return !stopped;
        };
        team_.run(plan);
        return !stopped;
    }

    std::uint64_t samples() const { return film_.state().samples * work_.pixels() + film_.state().ahead; }
    double speed() const { return static_cast<double>(samples() - before_) / goal_.elapsed(); }
    // So many that a task takes long enough to be worth its way, and that no round outlasts the time that is left.
    std::uint64_t samples_of_round() const {
        constexpr double seconds_of_task = 0.2;
        const double left = work_.r.seconds > 0 ? std::max(0.0, work_.r.seconds - goal_.elapsed()) : 1e9;
        const double of_member = speed() / static_cast<double>(team_.size()) / film_.part_pixels();
        const double of_all = speed() / static_cast<double>(work_.pixels());
        return static_cast<std::uint64_t>(
            std::clamp(std::min(seconds_of_task * of_member, left / 2 * of_all), 1.0, 1024.0));
    }

    const Work& work_;
    runtime::Team& team_;
    Checkpoint& checkpoint_;
    Goal goal_;
    render::SharedFilm film_;
    std::uint64_t before_;
    std::size_t task_ = 0;  // taken
    double error_ = 1;
    Progress progress_{work_.common.quiet};
    Traced traced_;
};

// By the team of this rank and its devices; of a rank that does not lead nothing.
std::optional<Traced> trace_by_team(const Work& work, const std::vector<runtime::Device>& devices,
                                    Checkpoint& checkpoint) {
    std::mutex mutex;
    Traced described;
    const auto hire = [&](const runtime::Device& device) -> runtime::Team::Work {
        const auto tracer = std::make_shared<Tracer>(work, device);
        const std::lock_guard lock(mutex);
        tracer->describe(described);
        return [tracer](const std::string& task) { return tracer->trace(task); };
    };
    runtime::Team::Options options = team_options("render: " + checkpoint.fingerprint());
    // Strict results are the same on any device, unless it takes subnormal numbers for 0.
    options.alike = work.math() != runtime::Math::strict ||
                    std::any_of(devices.begin(), devices.end(), [](const auto& d) { return !d.denormals; });
    runtime::Team team(*work.common.ranks, devices, hire, options);
    if (!work.common.leads()) {
        team.serve();
        return std::nullopt;
    }
    const std::size_t film = VNDF_FILM_PLANES * (work.pixels() + 1);
    const auto state = checkpoint.state();
    Traced traced =
        TraceTogether(work, team, state ? *state : render::State{0, 0, std::vector<float>(film)}, checkpoint)
            .run();
    const std::lock_guard lock(mutex);
    traced.device = fmt::format("{} ({})", described.device, team.describe());
    traced.memory = described.memory;
    traced.lamps = described.lamps;
    return traced;
}

// Beckmann has no bounded sampler, which is the default.
render::Choices choices_of(const Render& r) {
    render::Choices choices = r.choices;
    if (r.sampler->count() == 0 && choices.ndf == "beckmann") choices.sampler = "plain";
    return choices;
}

render::Settings settings_of(const Render& r, const Common& common, const render::Scene& scene) {
    render::Settings settings;
    set_size(r.size, settings);
    settings.max_bounces = render::useful_bounces(scene, r.max_bounces);
    settings.seed = common.seed;
    settings.samples_caps = r.choices.lights_by != "bsdf";
    settings.random = r.choices.random == "philox" ? render::Random::philox : render::Random::sobol;
    return settings;
}

// What CLI11 would tell less well of the word SCENE.
void require_consistent(const Render& r) {
    const auto stray = [](const char* option, const char* without) {
        throw InputError(fmt::format("{}: of no use {}", option, without));
    };
    if (!r.scene.file.empty() && r.orbs->count() > 0) stray("--orbs", "beside a SCENE");
    if (r.scene.file.empty() && !r.scene.camera.empty()) stray("--camera", "without a SCENE");
    if (r.scene.environment.empty() && r.scene.rotation != 0) stray("--env-rotation", "without --env");
}

void warn(const ShownScene& shown, const Common& common) {
    if (common.quiet) return;
    for (const auto& [warning, count] : shown.warnings)
        remark("clvndf: warning: {}{}\n", warning, count > 1 ? fmt::format(" ({} times)", count) : "");
}

render::Metadata metadata(const Reported& r) {
    return {{"software", "clvndf " CLVNDF_VERSION},
            {"scene", r.shown.scene.name},
            {"samples per pixel", fmt::format("{:.6g}", r.traced.image.samples)},
            {"estimated error", fmt::format("{:.3g}", r.traced.image.error)},
            {"seed", fmt::format("{}", r.settings.seed)},
            {"random numbers", r.choices.random},
            {"switches", r.switches.materials},
            {"math", r.math},
            {"longest path", fmt::format("{} surfaces", r.settings.max_bounces)},
            {"device", r.traced.device},
            {"seconds", fmt::format("{:.2f}", r.seconds)}};
}

// "auto" where a file's lights have any unit; without a file 0.
double stops_of(const Render& r, const render::Image& image) {
    if (r.exposure) return *r.exposure;
    return r.scene.file.empty() ? 0 : render::fitting_stops(image);
}

void say_result(const Reported& r, const std::string& output, bool interrupted, Common& common) {
    const render::Image& image = r.traced.image;
    if (!common.quiet)
        remark("{}: {} x {}, {:.6g} samples per pixel, {:.1f} s, error {:.2g}{}\n", output, image.width,
               image.height, image.samples, r.seconds, image.error,
               r.stops == 0 || !output.ends_with(".png")
                   ? ""
                   : fmt::format(", exposed by {:+.1f} stops", r.stops));
    if (interrupted && !common.quiet) remark("clvndf: interrupted; {} holds what is there\n", output);
    if (image.bad_pixels == 0) return;
    remark("clvndf: {} samples in {} pixels were no finite numbers and are left out\n", image.bad_samples,
           image.bad_pixels);
    common.exit_status = 1;
}

void run(const Render& r, Common& common) {
    const Clock::time_point start = Clock::now();
    require_consistent(r);
    render::require_image_name(r.output);
    require_distinct({{"--output", r.output}, {"--report", r.report}, {"--checkpoint", r.checkpoint}},
                     {{"SCENE", r.scene.file}, {"--env", r.scene.environment}});
    const ShownScene shown = shown_scene(r.scene);
    const render::Scene& scene = shown.scene;
    const render::Settings settings = settings_of(r, common, scene);
    const render::Choices choices = choices_of(r);
    const std::vector<render::Effect> effects = render::effects_for(scene, r.effects);
    const render::Switches switches = render::switches(scene, effects, choices);
    const runtime::Math math = math_named(r.math);
    const std::vector<runtime::Device> devices = [&] {
        Target target;
        target.device = r.device;
        return target.choose_all(common);
    }();
    const bool alone = common.ranks->size() == 1 && devices.size() == 1;
    std::optional<OutputFile> file, report;
    if (common.leads()) file.emplace(r.output);
    if (common.leads() && !r.report.empty()) report.emplace(r.report);
    const Interrupt interrupt;
    const render::Tree tree = render::build_tree(scene);
    warn(shown, common);
    const render::Explained explained{devices.front(), math, scene, tree, effects, choices, settings};
    if (r.explain && common.leads()) put(render::explanation(explained));
    if (r.effect_costs && common.leads()) put(render::effect_costs(explained));
    const Work work{r, common, scene, tree, settings, switches, interrupt, start};
    // Long to make of large scenes, so for who needs it alone.
    const std::string fingerprint =
        alone && r.checkpoint.empty()
            ? ""
            : render::fingerprint(scene, settings, switches.materials + ' ' + r.math);
    Checkpoint checkpoint(common.leads() ? r.checkpoint : "", fingerprint);
    std::optional<Traced> traced;
    if (alone)
        traced = trace(work, devices.front(), checkpoint);
    else
        traced = trace_by_team(work, devices, checkpoint);
    if (!traced) return;

    const Reported reported{r.scene,
                            shown,
                            effects,
                            choices,
                            switches,
                            settings,
                            *traced,
                            r.math,
                            work.since_start(),
                            traced->first,
                            stops_of(r, traced->image)};
    file->write(render::encoded(traced->image, r.output, metadata(reported), reported.stops));
    if (report) report->write(render_report(reported));
    file->commit();
    if (report) report->commit();
    say_result(reported, r.output, interrupt.asked(), common);
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
    r->sampler = choice(
        "--sampler", r->choices.sampler,
        "how metals draw directions: bounded, plain or conic visible normals, or tilted: conic, above the\n"
        "geometric normal, too; to compare with, ndf: any normals, and cosine: none",
        render::samplers());
    choice("--ndf", r->choices.ndf, "distribution of normals: ggx or beckmann", {"ggx", "beckmann"});
    choice("--masking", r->choices.masking, "masking and shadowing: correlated or separable",
           {"correlated", "separable"});
    choice("--energy", r->choices.energy,
           "what scatters between facets: none (it is lost), turquin or kulla_conty",
           {"none", "turquin", "kulla_conty"});
    choice("--lights-by", r->choices.lights_by,
           "how spheres and the sun are sampled: mis, evenly in the cap that they fill and by materials, "
           "weighed;\n"
           "cap or bsdf alone; or cones: of GGX facets all their reflections into it and no other",
           render::lights_by());
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
    command->add_flag("--effect-costs", r->effect_costs,
                      "print each effect's share of the time and of the image's error here");
    command->add_option("--checkpoint", r->checkpoint,
                        "a file that holds how far it has come: where there is one, it goes on from there");
    command->add_option("--report", r->report, "a file for what is known of the rendering, as JSON");
    add_number(*command, "--exposure", r->stops, -100.0, 100.0,
               "of a PNG: times 2 to this; without it 0, of a file's scene what fits")
        ->each([r](const std::string&) { r->exposure = r->stops; });
    command->add_option("SCENE", r->scene.file, "a scene: .gltf or .glb");
    r->orbs = command->add_option("--orbs", r->scene.orbs, "without a file: what five orbs are of")
                  ->check(CLI::IsMember(render::orb_kinds()))
                  ->capture_default_str();
    command->add_option("--camera", r->scene.camera, "of the file: a name or a number; the first without it");
    add_number(*command, "--light-radius", r->scene.light_radius, 1e-6f, 1e6f,
               "of the file's point and spot lights, which are spheres then; without a file, of lights over "
               "the orbs");
    CLI::Option* const sky =
        choice("--sky", r->scene.sky,
               "day: blue, with a sun; none: dark; to compare with others, white: as bright everywhere, and "
               "sunlit:\n"
               "white with the day's sun; auto: day, but none where a file has lights of its own",
               {"auto", "day", "none", "white", "sunlit"});
    command->add_option("--env", r->scene.environment, "in its place, an image from all around: .exr or .hdr")
        ->excludes(sky);
    add_number(*command, "--env-rotation", r->scene.rotation, -3600.0f, 3600.0f,
               "degrees by which it is turned, counterclockwise seen from above");
    add_device(*command, r->device, "share the work");
    command->callback([r, &common] { common.action = [r, &common] { run(*r, common); }; });
}

}  // namespace vndf::cli
