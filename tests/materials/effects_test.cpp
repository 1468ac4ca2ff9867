// An effect that is off changes no result for inputs that do not call for it.
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "splitmix64.h"
#include "support/bsdf_program.h"
#include "support/catch.h"

namespace {

using namespace vndf;

const std::vector<std::string> all_effects{
#define VNDF_EFFECT(name, called_for, marks) #name,
#include "../../kernels/effects.def"
};

using Off = std::vector<std::string>;
bool has(const Off& off, const char* effect) {
    return std::find(off.begin(), off.end(), effect) != off.end();
}

// Materials and directions of every kind but what the effects of `off` are for: half of them as scenes have them, half with
// parameters at the ends of their ranges.
class Inputs {
  public:
    Inputs(const Off& off, std::size_t items, std::uint64_t seed) : off_(off), draw_(seed) {
        evaluated_.resize(6 + bsdf_parameters.size());
        sampled_.resize(6 + bsdf_parameters.size());
        for (std::size_t i = 0; i < items; ++i) add();
    }
    const Columns& evaluated() const { return evaluated_; }
    const Columns& sampled() const { return sampled_; }
    // A way, and the material.
    Columns travelled() const {
        Columns all(sampled_.begin() + 5, sampled_.end());
        return all;
    }

  private:
    using Vector = std::array<float, 3>;

    double any(double low, double high) { return low + (high - low) * draw_.uniform(); }
    bool chance(double p) { return draw_.uniform() < p; }
    double part() { return chance(.2) ? (chance(.5) ? 0. : 1.) : draw_.uniform(); }
    double alpha() { return chance(.1) ? std::exp(any(-19, 7)) : std::exp(any(-7, .7)); }
    Vector direction(double least) {
        const double z = chance(.1) ? std::exp(any(-16, 0)) * (least < 0 && chance(.5) ? -1 : 1)
                                    : any(least, 1),
                     phi = any(0, 6.2831853), r = std::sqrt(1 - z * z);
        return {static_cast<float>(r * std::cos(phi)), static_cast<float>(r * std::sin(phi)),
                static_cast<float>(z)};
    }

    void add() {
        const bool one_normal = has(off_, "SHADING_NORMAL") || has(off_, "TERMINATOR") || chance(.3);
        const Vector ng = one_normal ? Vector{0, 0, 1} : direction(chance(.1) ? -1 : .3);
        Vector wo = direction(-1);
        // Not from behind: over the geometric normal in the arithmetic of the kernel, and not so near that it would matter.
        if (has(off_, "BACK_FACING") && wo[0] * ng[0] + wo[1] * ng[1] + wo[2] * ng[2] < 1e-6f) wo = ng;
        const Vector wi = chance(.2) ? mirrored(wo) : direction(-1);
        std::vector<double> material{alpha()};
        material.push_back(has(off_, "ANISOTROPIC") || chance(.3) ? material[0] : alpha());
        for (int c = 0; c < 3; ++c) material.push_back(chance(.5) ? part() : any(0, 3));
        for (int c = 0; c < 3; ++c) material.push_back(chance(.5) ? part() : any(0, 8));
        for (int c = 0; c < 3; ++c) material.push_back(has(off_, "TINT") ? 1 : part());
        for (int c = 0; c < 3; ++c) material.push_back(part());
        const double metal = has(off_, "CONDUCTOR")                            ? 0
                             : has(off_, "LAMBERT") && has(off_, "DIELECTRIC") ? 1
                                                                               : part();
        material.push_back(metal);
        material.push_back(has(off_, "DIELECTRIC") ? 1 : chance(.1) ? 1 : std::exp(any(-.7, 1.1)));
        material.push_back(has(off_, "DIELECTRIC") ? 0 : has(off_, "LAMBERT") ? 1 : part());
        for (int c = 0; c < 3; ++c) material.push_back(has(off_, "TINT") ? 1 : part());
        for (int c = 0; c < 4; ++c)
            material.push_back(has(off_, "SPECULAR") ? 1 : chance(.3) ? any(0, 8) : part());
        material.push_back(has(off_, "THIN_WALLED") ? 0 : chance(.3));
        material.push_back(has(off_, "DISPERSION") ? 0 : part());
        material.push_back(std::floor(any(0, 3)));
        for (int c = 0; c < 3; ++c)
            material.push_back(has(off_, "ABSORPTION") || has(off_, "DIELECTRIC") ? 0 : part());
        material.push_back(has(off_, "ROUGH_DIFFUSE") ? 0 : part());
        material.push_back(has(off_, "COAT") ? 0 : part());
        material.push_back(alpha());
        for (const float x : ng) material.push_back(x);
        const double u1 = part(), u2 = part(), u_lobe = part();
        put(evaluated_, {wo[0], wo[1], wo[2], wi[0], wi[1], wi[2]}, material);
        put(sampled_, {wo[0], wo[1], wo[2], u1, u2, u_lobe}, material);
    }
    static Vector mirrored(const Vector& wo) { return {-wo[0], -wo[1], wo[2]}; }
    static void put(Columns& to, const std::vector<double>& first, const std::vector<double>& material) {
        std::size_t column = 0;
        for (const auto* values : {&first, &material})
            for (const double x : *values) to[column++].push_back(x);
    }

    const Off& off_;
    SplitMix64 draw_;
    Columns evaluated_, sampled_;
};

// The rows whose bits differ.
std::size_t different(const Columns& a, const Columns& b) {
    std::size_t rows = 0;
    for (std::size_t i = 0; i < a.front().size(); ++i)
        for (std::size_t c = 0; c < a.size(); ++c)
            if (std::bit_cast<std::uint64_t>(a[c][i]) != std::bit_cast<std::uint64_t>(b[c][i])) {
                ++rows;
                break;
            }
    return rows;
}

std::string switches(const std::string& choices, const Off& off) {
    std::string text = choices;
    for (const std::string& effect : off) text += " " + effect + "=0";
    return text;
}

// Without any lobe nothing is left.
bool is_program(const Off& off) {
    return !(has(off, "CONDUCTOR") && has(off, "DIELECTRIC") && has(off, "LAMBERT"));
}

void compare(const BsdfProgram& all, const std::string& choices, const Off& off, std::size_t items) {
    const std::string text = switches(choices, off);
    CAPTURE(text);
    const BsdfProgram program(text);
    const Inputs inputs(off, items, 1);
    CHECK(different(all.eval_pdf(inputs.evaluated()), program.eval_pdf(inputs.evaluated())) == 0);
    CHECK(different(all.sample(inputs.sampled()), program.sample(inputs.sampled())) == 0);
    CHECK(different(all.transmittance(inputs.travelled()), program.transmittance(inputs.travelled())) == 0);
}

std::vector<std::string> all_choices() {
    std::vector<std::string> all;
    for (const char* model : {"ggx SAMPLING=plain", "ggx SAMPLING=bounded", "ggx SAMPLING=conic",
                              "ggx SAMPLING=tilted", "beckmann"})
        for (const char* fresnel : {"none", "conductor", "schlick", "f82"})
            for (const char* masking : {"correlated", "separable"})
                for (const char* energy : {"none", "turquin", "kulla_conty"})
                    all.push_back(fmt::format("NDF={} FRESNEL={} MASKING={} ENERGY={}", model, fresnel,
                                              masking, energy));
    return all;
}

Off all_but_conductor() {
    Off off = all_effects;
    off.erase(std::find(off.begin(), off.end(), "CONDUCTOR"));
    return off;
}
const Off front_conductor = all_but_conductor();

}  // namespace

TEST_CASE("results with an effect off are those with everything on, to the bit") {
    constexpr std::size_t items = 1 << 14;
    const BsdfProgram all("");
    for (const std::string& effect : all_effects) compare(all, "", {effect}, items);
    compare(all, "", front_conductor, items);
    for (const std::string other :
         {"NDF=beckmann FRESNEL=conductor MASKING=separable", "ENERGY=turquin", "ENERGY=kulla_conty"})
        for (const Off& off : {front_conductor, Off{"CONDUCTOR"}, Off{"DIELECTRIC"}})
            compare(BsdfProgram(other), other, off, items);
}

// Shown able to fail: with inputs that do call for the effect, and with a changed formula.
TEST_CASE("a comparison of bits notices an effect that is called for, and a formula that an effect changes") {
    const BsdfProgram all("");
    const Off none;
    const Inputs inputs(none, 1 << 10, 1);
    const Columns values = all.eval_pdf(inputs.evaluated()), samples = all.sample(inputs.sampled()),
                  left = all.transmittance(inputs.travelled());
    for (const std::string& effect : all_effects) {
        CAPTURE(effect);
        const BsdfProgram program(effect + "=0");
        if (effect == "ABSORPTION") {
            CHECK(different(left, program.transmittance(inputs.travelled())) > 0);
            continue;
        }
        CHECK(different(values, program.eval_pdf(inputs.evaluated())) > 0);
        CHECK(different(samples, program.sample(inputs.sampled())) > 0);
    }
    const Off off{"DIELECTRIC", "LAMBERT"};
    const Inputs metals(off, 1 << 12, 1);
    const BsdfProgram changed(
        "",
        {{"kernels/vndf/bsdf.h", "VNDF_FMA(share, d.weight.r, rest * s.weight.r)",
          "VNDF_FMA(share, d.weight.r - s.weight.r, s.weight.r) * VNDF_R(0.99999994)", 1}},
        1);
    CHECK(different(BsdfProgram("DIELECTRIC=0 LAMBERT=0").sample(metals.sampled()),
                    changed.sample(metals.sampled())) > 0);
}

// By hand: 96 choices, each effect alone, all pairs and all together. The environment's CLVNDF_CHOICES: only those with
// this text in them, "bounded FRESNEL=schlick MASKING=correlated".
TEST_CASE("results with effects off are those with everything on, for every choice", "[.effects-full]") {
    const std::size_t items = items_by_hand();
    const char* some = std::getenv("CLVNDF_CHOICES");
    for (const std::string& choices : all_choices()) {
        if (some && choices.find(some) == std::string::npos) continue;
        const BsdfProgram all(choices);
        for (std::size_t a = 0; a < all_effects.size(); ++a) {
            compare(all, choices, {all_effects[a]}, items);
            for (std::size_t b = a + 1; b < all_effects.size(); ++b)
                if (is_program({all_effects[a], all_effects[b]}))
                    compare(all, choices, {all_effects[a], all_effects[b]}, items);
        }
        compare(all, choices, front_conductor, items);
        fmt::print("{}: same bits\n", choices);
    }
}
