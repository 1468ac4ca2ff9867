// libFuzzer target: any bytes are a sound scene or a refusal of one line. Files beside the scene are served from memory.
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <random>

#include <nlohmann/json.hpp>

#include "error.h"
#include "gltf/container.h"
#include "gltf/load.h"
#include "gltf/sound.h"
#include "support/gltf_cases.h"

using namespace vndf;

namespace {

// So that no run takes long: what the limits bound is bounded the same way.
gltf::Limits small_limits() {
    gltf::Limits limits;
    limits.json_values = 1 << 13;
    limits.json_depth = 32;
    limits.triangles = 1 << 11;
    limits.sparse_elements = 1 << 12;
    limits.image_pixels = 1 << 14;
    limits.total_pixels = 1 << 15;
    return limits;
}

std::string served(const gltf::Item& place, const std::string& path, std::uint64_t) {
    if (path == "a.bin") return std::string(256, '\1');
    if (path == "a.png") return test::small_png();
    place.fail("there is no such file");
}

void require(bool good, const std::string& what) {
    if (good) return;
    std::fprintf(stderr, "%s\n", what.c_str());
    std::abort();
}

using Random = std::minstd_rand;

nlohmann::json odd_value(Random& random) {
    switch (random() % 14) {
        case 0:
            return -1;
        case 1:
            return 0;
        case 2:
            return 1;
        case 3:
            return 255;
        case 4:
            return 4294967295u;
        case 5:
            return std::int64_t{1} << 40;
        case 6:
            return 1e300;
        case 7:
            return 0.5;
        case 8:
            return -1e-30;
        case 9:
            return nullptr;
        case 10:
            return true;
        case 11:
            return nlohmann::json::array();
        case 12:
            return "a.bin";
        default:
            return 5120 + random() % 8;
    }
}

// Changes, removes or copies a value somewhere in the text.
void change(nlohmann::json& root, Random& random) {
    nlohmann::json* at = &root;
    while (at->is_structured() && !at->empty() && (at == &root || random() % 8 != 0))
        at = &*std::next(at->begin(), static_cast<std::ptrdiff_t>(random() % at->size()));
    if (at->is_array() && !at->empty() && random() % 2) {
        at->push_back((*at)[random() % at->size()]);
    } else if (at->is_structured() && !at->empty() && random() % 2) {
        at->erase(std::next(at->begin(), static_cast<std::ptrdiff_t>(random() % at->size())));
    } else if (at->is_number() && random() % 2) {
        *at = at->get<double>() + static_cast<double>(random() % 5) - 2;
    } else {
        *at = odd_value(random);
    }
}

std::string glb_of(const std::string& text, const std::string& bin) {
    return "glTF" + test::little_endian(2) + test::little_endian(28 + text.size() + bin.size()) +
           test::little_endian(text.size()) + "JSON" + text + test::little_endian(bin.size()) +
           std::string("BIN\0", 4) + bin;
}

// The same bytes with a value of the JSON changed, or with the bytes beside it changed; nothing if there is no JSON.
std::string changed(const std::string& bytes, Random& random) {
    try {
        const gltf::Chunks chunks = gltf::chunks_of("fuzz", bytes);
        std::string bin(chunks.bin.value_or(""));
        nlohmann::json root = nlohmann::json::parse(chunks.json);
        if (!bin.empty() && random() % 3 == 0)
            bin[random() % bin.size()] = static_cast<char>(random());
        else
            for (unsigned times = random() % 3; times < 3; ++times) change(root, random);
        const std::string text = root.dump();
        return chunks.bin ? glb_of(text, bin) : text;
    } catch (const std::exception&) {
        return {};
    }
}

}  // namespace

extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t room);

extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t room,
                                               unsigned seed) {
    Random random(seed);
    if (random() % 3 == 0) return LLVMFuzzerMutate(data, size, room);
    const std::string result = changed(std::string(reinterpret_cast<const char*>(data), size), random);
    if (result.empty() || result.size() > room) return LLVMFuzzerMutate(data, size, room);
    std::copy(result.begin(), result.end(), reinterpret_cast<char*>(data));
    return result.size();
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string_view bytes(reinterpret_cast<const char*>(data), size);
    try {
        const gltf::Loaded loaded = gltf::load("fuzz", bytes, served, "", small_limits());
        require(test::unsound(loaded.scene).empty(), test::unsound(loaded.scene));
        for (const auto& [what, count] : loaded.warnings)
            require(count > 0 && what.find('\n') == what.npos, "a warning: " + what);
    } catch (const InputError& error) {
        const std::string what = error.what();
        require(what.starts_with("fuzz: ") && what.find('\n') == what.npos, "a refusal: " + what);
    }
    return 0;
}
