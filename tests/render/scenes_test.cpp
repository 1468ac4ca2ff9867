// Scenes from files as `clvndf render` shows them: with the effects that they call for and with all of them to the same bits, no
// pixel that is no number, checkpoints, reports, and files that are none.
#include <cstdlib>
#include <filesystem>

#include <nlohmann/json.hpp>

#include "error.h"
#include "gltf/load.h"
#include "render/checkpoint.h"
#include "scenes.h"
#include "support/command.h"
#include "support/gltf_cases.h"
#include "support/skip.h"

using namespace vndf;
using namespace vndf::test;

namespace {

render::Scene loaded(const std::string& name, const std::string& bytes) {
    render::Scene scene = gltf::load(
                              name, bytes, [](const auto&, const auto&, auto) { return std::string(); }, "")
                              .scene;
    scene.sky = render::day_sky();
    return scene;
}

// Whether auto and all have the same bits, and all of them numbers.
void check_effects(const render::Scene& scene, unsigned width, unsigned height) {
    Rendered r = rendered(scene, width, height, 2);
    const render::Image called = r.image();
    CHECK(called.bad_samples == 0);
    r.effects = "all";
    CHECK(r.image().pixels == called.pixels);
}

}  // namespace

TEST_CASE(
    "files with everything in them have the same bits with the effects that they call for and with all") {
#if !CLVNDF_PNG
    VNDF_SKIP("this build lacks libpng");
#endif
    GltfFile rich = rich_file();
    check_effects(loaded("rich", rich.glb()), 24, 16);
    rich.material()["alphaMode"] = "BLEND";
    check_effects(loaded("rich, blended", rich.gltf()), 24, 16);
    check_effects(loaded("busy", busy_file().gltf()), 24, 16);
}

// By hand: the scenes of the folder that CLVNDF_SCENES names, and what is broken and shown nevertheless.
TEST_CASE("real scenes have the same bits with the effects that they call for and with all",
          "[.scenes-full]") {
    const char* const folder = std::getenv("CLVNDF_SCENES");
    if (!folder) VNDF_SKIP("CLVNDF_SCENES names no folder");
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
        const std::filesystem::path& file = entry.path();
        if (file.extension() != ".gltf" && file.extension() != ".glb") continue;
        CAPTURE(file.string());
        try {
            render::Scene scene = gltf::load(file, "").scene;
            scene.sky = render::day_sky();
            check_effects(scene, 48, 32);
        } catch (const InputError&) {
            CHECK(file.string().find("broken") != std::string::npos);
        }
    }
}

TEST_CASE("a texture calls for an effect only if a texel does") {
#if !CLVNDF_PNG
    VNDF_SKIP("this build lacks libpng");
#endif
    const auto called = [](const render::Scene& scene, const std::string& name) {
        for (const render::Effect& e : render::effects_for(scene, "auto"))
            if (e.name == name) return e.called_by;
        return std::string("there is no such effect");
    };
    render::Scene scene = loaded("rich", rich_file().glb());
    scene.dressings[0].factors.alpha_cutoff = 0.9f;  // above its opacity
    for (const char* name :
         {"alpha", "texture", "roughness_texture", "layer_texture", "normal_map", "tangent",
          "emission_texture", "lamp", "specular", "coat", "dielectric", "anisotropic"}) {
        CAPTURE(name);
        CHECK(called(scene, name) != "");
    }
    CHECK(called(scene, "coat").find("(all?of it)") != std::string::npos);  // by its name
    for (render::Bitmap& b : scene.bitmaps) std::fill(b.texels.begin(), b.texels.end(), 0xffffffff);
    scene.dressings[0].factors.opacity = 1;
    for (const char* name : {"alpha", "texture", "roughness_texture", "emission_texture"})
        CHECK(called(scene, name) == "");
    for (render::Bitmap& b : scene.bitmaps) std::fill(b.texels.begin(), b.texels.end(), 0xff000000);
    for (const char* name : {"emission", "lamp", "coat", "anisotropic", "conductor", "absorption"}) {
        CAPTURE(name);
        CHECK(called(scene, name) == "");
    }
    for (render::Bitmap& b : scene.bitmaps) std::fill(b.texels.begin(), b.texels.end(), 0xffff8080);
    CHECK(called(scene, "normal_map") == "");
}

TEST_CASE("a scene in which nothing sends light on needs no bounce") {
    render::Scene scene = loaded("triangle", triangle_file().gltf());
    CHECK(render::useful_bounces(scene, 6) == 6);
    render::GltfMaterial unlit;
    unlit.unlit = true;
    for (render::Material& m : scene.materials) m = render::material_of(unlit);
    CHECK(render::useful_bounces(scene, 6) == 0);
}

TEST_CASE("a rendering goes on from its checkpoint to the same bits, and from no other one") {
    const Folder folder;
    folder.write("a.gltf", triangle_file().gltf());
    const std::string render = "\"$clvndf\" --quiet render a.gltf --size 40x30 ";
    CHECK(shell(folder, render + "--spp 3 --checkpoint at -o part.exr && cp at at3 && " + render +
                            "--spp 8 --checkpoint at -o whole.png && " + render +
                            "--spp 8 -o once.png && cmp whole.png once.png && " + render +
                            "--spp 3 -o less.png && ! cmp -s less.png once.png") == 0);
    CHECK(shell(folder, render + "--spp 8 --seed 2 --checkpoint at -o no.png 2>err") == 2);
    CHECK(folder.read("err").find("of another rendering: 40 x 30, 6 surfaces, seed 1") != std::string::npos);
    CHECK(shell(folder, "head -c 500 at3 >cut; " + render + "--spp 8 --checkpoint cut -o no.png 2>err") == 2);
    CHECK(folder.read("err").find("damaged") != std::string::npos);
    CHECK(shell(folder,
                render + "--spp 8 --checkpoint a.gltf -o no.png 2>err; grep -q 'one file\\|same file' err") ==
          0);
    CHECK(shell(folder, "echo no >none; " + render + "--spp 8 --checkpoint none -o no.png 2>err") == 2);
    CHECK(folder.read("err").find("no checkpoint") != std::string::npos);
    CHECK(shell(folder, "[ ! -e no.png ]") == 0);
}

TEST_CASE("a report says what was rendered, and for what effects") {
    const Folder folder;
    folder.write("b.glb", busy_file().glb());
    CHECK(shell(folder, "\"$clvndf\" --quiet render b.glb --size 24x16 --spp 2 --report r.json -o a.png") ==
          0);
    const auto report = nlohmann::json::parse(folder.read("r.json"));
    CHECK(report.at("triangles") == 2);
    CHECK(report.at("lights") == 3);
    CHECK(report.at("samples_per_pixel") == 2);
    CHECK(report.at("memory").at("path") > 100);
    CHECK(report.at("seconds_to_first_sample") > 0);
    bool found = false;
    for (const auto& effect : report.at("effects"))
        if (effect.at("name") == "point_light")
            found = effect.at("on") && effect.at("called_by") == "3 lights";
    CHECK(found);
}

TEST_CASE("what cannot be rendered is one line, status 2 and no file") {
    const Folder folder;
    folder.write("triangle.gltf", triangle_file().gltf());
    folder.write("broken.gltf", "{\"asset\": {\"version\": \"2.0\"}}");
    folder.write("deep.gltf", "{\"asset\":{\"version\":\"2.0\"},\"extras\":" + std::string(200000, '[') +
                                  std::string(200000, ']') + "}");
    folder.write("env.hdr", "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 40000 +X 40000\n");
    for (const char* options :
         {"none.gltf", "broken.gltf", "deep.gltf", "triangle.gltf --camera 3", "triangle.gltf --env env.hdr",
          "triangle.gltf --env none.exr", "--camera 1", "triangle.gltf --orbs glass",
          "--env env.hdr --sky day", "--env-rotation 20", "triangle.gltf --exposure 1000"}) {
        CAPTURE(options);
        CHECK(shell(folder, std::string("\"$clvndf\" render ") + options + " -o a.png 2>err") == 2);
        const std::string error = folder.read("err");
        CHECK(std::count(error.begin(), error.end(), '\n') == 1);
        CHECK(error.size() < 400);
        CHECK(shell(folder, "[ ! -e a.png ]") == 0);
    }
}

TEST_CASE("a PNG is exposed as is said, or so that it can be seen") {
    const Folder folder;
    folder.write("b.gltf", triangle_file().gltf());
    CHECK(
        shell(
            folder,
            "\"$clvndf\" render b.gltf --size 24x16 --spp 1 -o a.png 2>said && grep -q 'exposed by' said && "
            "\"$clvndf\" render b.gltf --size 24x16 --spp 1 --exposure 0 -o b.png 2>said && "
            "! grep -q 'exposed by' said && ! cmp -s a.png b.png") == 0);
}
