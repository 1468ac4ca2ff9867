// What changes no bit of an image: effects that are off because nothing calls for them, the size of the queues, the number of
// threads, and where the stages run.
#include <fmt/format.h>

#include "error.h"
#include "scenes.h"
#include "support/command.h"

using namespace vndf;
using namespace vndf::test;

namespace {

bool same(const render::Image& a, const render::Image& b) {
    return a.pixels == b.pixels && a.error == b.error;
}

Rendered small_orbs(const std::string& kind) {
    return rendered(render::orbs(kind), 60, 25, 4);
}

}  // namespace

namespace {

// Orbs that have every effect of a material between them; by hand all kinds.
const std::vector<std::string> varied{"roughness", "metals", "tinted", "clay", "gltf"};

void check_effects(const std::vector<std::string>& kinds) {
    for (const std::string& kind : kinds) {
        CAPTURE(kind);
        Rendered r = small_orbs(kind);
        const std::string automatic = r.switches().materials;
        const render::Image called = r.image();
        r.effects = "all";
        CHECK(same(called, r.image()));
        CHECK(called.bad_pixels == 0);
        // And the program is another one.
        CHECK(automatic != r.switches().materials);
    }
}

}  // namespace

TEST_CASE("with the effects that a scene calls for and with all of them, its image has the same bits") {
    check_effects(varied);
    // Without an effect that the scene calls for it is another image.
    Rendered r = small_orbs("anisotropy");
    const render::Image whole = r.image();
    r.effects = "conductor,lambert,shading_normal,terminator";
    CHECK_FALSE(same(whole, r.image()));
}

TEST_CASE("the same of every kind of orb", "[.same-image-full]") {
    check_effects(render::orb_kinds());
}

namespace {

render::Image image_with(const Rendered& r, const std::vector<render::Effect>& effects) {
    const auto stages = render::device_stages(runtime::choose_device().device, runtime::Math::strict,
                                              render::switches(r.scene, effects, r.choices));
    return r.on(*stages);
}

}  // namespace

TEST_CASE("effects that nothing calls for change no bit, in groups of which each is in one at least") {
    const Rendered r = small_orbs("roughness");
    const auto effects = render::effects_for(r.scene, "auto");
    const render::Image usual = image_with(r, effects);
    // By the digits of their numbers, from 1 on.
    for (std::size_t digit = 1; digit <= effects.size(); digit *= 2) {
        auto more = effects;
        for (std::size_t i = 0; i < effects.size(); ++i) more[i].on |= ((i + 1) & digit) != 0;
        CAPTURE(digit);
        CHECK(same(usual, image_with(r, more)));
    }
}

// By hand, a minute.
TEST_CASE("each effect that nothing calls for changes no bit by itself", "[.same-image-full]") {
    const Rendered r = small_orbs("roughness");
    const auto effects = render::effects_for(r.scene, "auto");
    const render::Image usual = image_with(r, effects);
    for (std::size_t i = 0; i < effects.size(); ++i) {
        if (effects[i].on) continue;
        CAPTURE(effects[i].name);
        auto more = effects;
        more[i].on = true;
        CHECK(same(usual, image_with(r, more)));
    }
}

TEST_CASE("the size of the queues changes no bit") {
    Rendered r = small_orbs("roughness");
    const render::Image usual = r.image();
    for (const std::size_t queue : {1, 256, 500, 1000}) {
        CAPTURE(queue);
        r.settings.queue = queue;
        CHECK(same(usual, r.image()));
    }
}

TEST_CASE("packets of any width see what single rays see, whatever the size of the queues") {
    Rendered r = small_orbs("roughness");
    const auto image = [&](unsigned packet, std::size_t queue) {
        render::Switches switches = r.switches();
        switches.packet = packet;
        r.settings.queue = queue;
        const auto stages =
            render::device_stages(runtime::choose_device().device, runtime::Math::strict, switches);
        CHECK(stages->packet() == packet);
        return r.on(*stages);
    };
    const render::Image single = image(1, 1 << 17);
    for (const unsigned packet : {1, 8, 16, 32})
        for (const std::size_t queue : {256, 1000, 1 << 17}) {
            CAPTURE(packet, queue);
            CHECK(same(single, image(packet, queue)));
        }
}

TEST_CASE("the stages as C++ have the bits of the device, for every model") {
    const auto check = [](Rendered r) {
        CAPTURE(r.scene.name, r.choices.ndf, r.scene.fresnel);
        const auto cpp = render::cpp_stages(r.choices.ndf, r.scene.fresnel);
        const render::Image image = r.image();
        CHECK(same(image, r.on(*cpp)));
        return image;
    };
    for (const std::string& kind : varied) check(small_orbs(kind));
    std::vector<render::Image> different;
    for (const std::string ndf : {"ggx", "beckmann"})
        for (const std::string fresnel : {"none", "conductor", "schlick", "f82"}) {
            Rendered r = small_orbs("metals");
            r.choices.ndf = ndf;
            r.choices.sampler = ndf == "ggx" ? "bounded" : "plain";
            r.scene.fresnel = fresnel;
            for (render::Material& m : r.scene.materials)
                if (fresnel != "conductor") m.first = {0.9f, 0.6f, 0.3f}, m.second = {0.8f, 0.9f, 0.7f};
            const render::Image image = check(r);
            for (const render::Image& other : different) CHECK_FALSE(same(image, other));
            different.push_back(image);
        }
    CHECK_THROWS_AS(render::cpp_stages("ggx", "fog"), InputError);
}

TEST_CASE("another seed is another image, the same seed the same") {
    Rendered r = small_orbs("roughness");
    const render::Image first = r.image();
    CHECK(same(first, r.image()));
    r.settings.seed = 2;
    CHECK_FALSE(same(first, r.image()));
    r.settings.seed = 1;
    r.choices.random = "philox";
    r.settings.random = render::Random::philox;
    CHECK_FALSE(same(first, r.image()));
}

TEST_CASE("the number of threads changes no bit, and both kinds of file hold the image") {
    const Folder folder;
    const std::string render = "\"$clvndf\" --quiet render --size 60x25 --spp 2 ";
    CHECK(shell(folder, "POCL_MAX_PTHREAD_COUNT=1 POCL_CPU_MAX_CU_COUNT=1 " + render + "-o one.png && " +
                            render + "-o two.png && cmp one.png two.png") == 0);
    CHECK(folder.read("one.png").starts_with("\x89PNG"));
    CHECK(shell(folder, render + "-o a.exr && " + render + "--seed 2 -o b.exr && ! cmp -s a.exr b.exr") == 0);
    const std::string exr = folder.read("a.exr");
    CHECK(exr.starts_with("\x76\x2f\x31\x01"));
    for (const char* word : {"orbs of roughness", "samples per pixel", "VNDF_CONDUCTOR=1"})
        CHECK(exr.find(word) != exr.npos);
}

TEST_CASE("Ctrl-C writes what is there") {
    const Folder folder;
    // Once the file is there by another name, it is at work.
    CHECK(
        shell(
            folder,
            "env --default-signal=INT \"$clvndf\" render --size 60x25 --time 10000 -o a.png 2>err & run=$!\n"
            "n=0; until ls -A | grep -q 'a\\.png' || [ $n = 400 ]; do sleep .05; n=$((n+1)); done\n"
            "sleep .2; kill -INT $run; wait $run") == 0);
    CHECK(folder.read("a.png").starts_with("\x89PNG"));
    CHECK(folder.read("err").find("interrupted; a.png holds what is there") != std::string::npos);
    CHECK(folder.files() == 2);
}
