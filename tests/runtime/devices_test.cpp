// Devices as they are elsewhere, played by support/device_layer.cpp: each command gives the right result or says what is wrong.
#include <map>
#include <string>
#include <vector>

#include "runtime/devices.h"
#include "support/catch.h"
#include "support/command.h"
#include "support/skip.h"
#include "text.h"

#ifndef CLVNDF_DEVICE_LAYER
#define CLVNDF_DEVICE_LAYER ""
#endif

namespace {

using namespace vndf;
using Catch::Matchers::ContainsSubstring;

const std::string sampler = "vndf_ggx_sample_wm_dupuy2023";
const std::string lobe = "wo_x,wo_y,wo_z,alpha_x,alpha_y,u1,u2\n0.6,0,0.8,0.5,0.1,0.25,0.75\n";

// With the device that plays so.
std::string playing(const std::string& play) {
    return "export OPENCL_LAYERS='" CLVNDF_DEVICE_LAYER "' CLVNDF_LAYER=" + play;
}
Outcome on(const std::string& play, const std::string& arguments, const std::string& input = lobe) {
    return clvndf_after(playing(play), arguments, input);
}

// Why nothing can be played; empty if it can.
std::string no_layers() {
    if (std::string(CLVNDF_DEVICE_LAYER).empty()) return "no CL/cl_layer.h";
    return on("no_compiler", "devices").out == clvndf("devices").out ? "the loader of OpenCL knows no layers"
                                                                     : "";
}

#define NEEDS_LAYERS                                \
    static const std::string missing = no_layers(); \
    if (!missing.empty()) VNDF_SKIP(missing)

// Of the sampler and its forms, as committed.
std::string digests() {
    const Folder folder;
    REQUIRE(shell(folder, "grep " + sampler + " '" CLVNDF_SOURCE_DIR "/tests/data/digests_quick.txt' >out") ==
            0);
    return folder.read("out");
}

void require_right_bits(const std::string& play) {
    const Outcome run = on(play, "--quiet check --digest --quick --only " + sampler);
    CAPTURE(play, run.err);
    CHECK(run.status == 0);
    CHECK(run.out == digests());
}

// Of one small picture, the same whatever makes it.
void require_right_image(const std::string& play) {
    const Folder folder;
    const std::string render = "\"$clvndf\" --quiet render --size 16x8 --spp 1 --output ";
    CAPTURE(play);
    CHECK(shell(folder, render + "plain.png && " + playing(play) + " && " + render +
                            "played.png && cmp plain.png played.png") == 0);
}

// Commands that use a device, and what they write.
const std::vector<std::string>& commands() {
    static const std::vector<std::string> all{
        "eval " + sampler + " --output new",
        "check --quick --points 1024 --only vndf_reflect --json new",
        "check --quick --points 1024 --only " + sampler + " --report new",
        "check --digest --quick --only vndf_reflect",
        "check --only " + sampler + " --exhaustive --minutes 0.001 --slice 1/1000",
        "check --quick --points 1024 --kernel '" CLVNDF_SOURCE_DIR
        "/tests/judge/right.cl' --function my_sample --as ggx_sample_wm",
        "policies --quick --only vndf_reflect --json new",
        "energy --ndf ggx --masking separable --no-cache --output new",
        "render --size 8x4 --spp 1 --output new.png"
#ifdef CLVNDF_BENCH
        ,
        "bench --only vndf_reflect/strict --repetitions 3 --json new"
#endif
    };
    return all;
}

// Whether the command fails; then because of the device, with a message that holds `said`, and nothing written.
bool fails(const std::string& play, const std::string& command, const std::string& said) {
    const Folder folder;
    folder.write("in", lobe);
    const int status =
        shell(folder, playing(play) + "\ntimeout 120 \"$clvndf\" " + command + " <in >out 2>err");
    const std::string err = folder.read("err");
    CAPTURE(play, command, err);
    if (status == 0) return false;
    CHECK(status == 3);
    CHECK_THAT(err, ContainsSubstring("clvndf: ") && ContainsSubstring(said));
    CHECK(folder.files() == 3);  // in, out, err
    return true;
}

}  // namespace

TEST_CASE("a device without double computes in float, and refuses double in a line") {
    NEEDS_LAYERS;
    CHECK_THAT(on("no_fp64", "devices").out, ContainsSubstring("double (fp64)                   no"));
    require_right_bits("no_fp64");
    require_right_image("no_fp64");
    for (const std::string& command :
         {"eval " + sampler, "check --quick --only " + sampler, "policies --quick --only " + sampler}) {
        const Outcome run = on("no_fp64", command + " --real double");
        CAPTURE(command, run.err);
        CHECK(run.status == 2);
        CHECK(one_line(run.err));
        CHECK_THAT(run.err, ContainsSubstring("has no fp64; float is allowed"));
        CHECK(run.out.empty());
    }
}

TEST_CASE("a device without fma or correct division gives the same bits") {
    NEEDS_LAYERS;
    require_right_bits("no_fma,no_rounding");
    CHECK(fails("no_fma,no_rounding,vanish=11", commands().front(),
                "-DVNDF_SOFTWARE_FMA=1 -DVNDF_SOFTWARE_DIVIDE=1"));
}

TEST_CASE("a device with small work-groups gives the same bits") {
    NEEDS_LAYERS;
    const std::string limit = GENERATE("1", "64", "256");
    const std::string play = "group=" + limit;
    CHECK_THAT(on(play, "devices").out, ContainsSubstring("largest work-group              " + limit + "\n"));
    require_right_bits(play);
    if (limit == "1") require_right_image(play);
}

TEST_CASE("a device without a compiler is refused, and no user's function for it") {
    NEEDS_LAYERS;
    for (const std::string& command : commands())
        CHECK(fails("no_compiler", command, "has no compiler (CL_DEVICE_COMPILER_AVAILABLE is false)"));
}

TEST_CASE("a platform without a device is no device") {
    NEEDS_LAYERS;
    for (const std::string command : {"devices", "eval vndf_reflect"}) {
        const Outcome run = on("no_device", command);
        CAPTURE(command, run.err);
        CHECK(run.status == 3);
        CHECK(one_line(run.err));
        CHECK_THAT(run.err, ContainsSubstring("is installed but offers no device (CL_DEVICE_NOT_FOUND)"));
    }
}

TEST_CASE("of devices with one name the first is taken, and said so; the others have numbers") {
    NEEDS_LAYERS;
    const std::string name = runtime::choose_device().device.name, out = clvndf("eval " + sampler, lobe).out;
    for (const char* play : {"twins", "sub_devices"}) {
        const auto devices = split(on(play, "devices").out, '\n');
        if (std::count(devices.begin(), devices.end(), devices.front()) < 2)
            continue;  // one core has no parts
        const Outcome first = on(play, "eval " + sampler + " --device '" + name + "'");
        CAPTURE(play, first.err);
        CHECK(first.out == out);
        CHECK(one_line(first.err));
        CHECK_THAT(first.err, ContainsSubstring("devices; taking '") &&
                                  ContainsSubstring("'" + name + "#2' is the second"));
        const Outcome second = on(play, "eval " + sampler + " --device '" + name + "#2'");
        CHECK(second.out == out);
        CHECK(second.err.empty());
        const Outcome beyond = on(play, "eval " + sampler + " --device '" + name + "#99'");
        CHECK(beyond.status == 2);
        CHECK(one_line(beyond.err));
        CHECK_THAT(beyond.err, ContainsSubstring("#99': '" + name + "' matches "));
    }
}

TEST_CASE("a part of a device is a device") {
    NEEDS_LAYERS;
    const Outcome parts = on("sub_devices", "devices");
    if (parts.status != 0) VNDF_SKIP("the device has no parts");
    CHECK_THAT(parts.out, ContainsSubstring("compute units                   1\n"));
    require_right_bits("sub_devices");
}

TEST_CASE(
    "a device with 32-bit addresses, and one with little memory, gives the same bits or says what does not "
    "fit") {
    NEEDS_LAYERS;
    CHECK_THAT(on("address_32", "devices").out,
               ContainsSubstring("addresses                       32 bits\n"));
    require_right_bits("address_32");
    require_right_image("address_32");
    CHECK(fails("memory=100", "eval " + sampler + " --output new", "CL_INVALID_BUFFER_SIZE"));
    CHECK(
        fails("memory=100000", "render --size 64x64 --spp 1 --output new.png", "cannot allocate memory on "));
}

TEST_CASE("a device that vanishes ends the command with an error, at whichever call") {
    NEEDS_LAYERS;
    const std::string said = "CL_OUT_OF_RESOURCES";
    for (const std::string& command : commands()) CHECK(fails("vanish=11", command, said));
    // Each of the first calls of a short run, which build, and some of the others.
    std::size_t last = 1;
    while (last < 100 && fails("vanish=" + std::to_string(last), commands().front(), said))
        last += last < 8 ? 1 : 5;
    CHECK((last > 15 && last < 100));
}

TEST_CASE("a device that vanishes late in any command ends it with an error", "[.vanish-full]") {
    NEEDS_LAYERS;
    for (const std::string& command : commands())
        for (std::size_t calls = 1; fails("vanish=" + std::to_string(calls), command, "CL_OUT_OF_RESOURCES");)
            calls += calls / 2 + 1;  // ends with the run that the device survives
}
