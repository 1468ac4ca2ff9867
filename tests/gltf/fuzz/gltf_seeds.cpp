// Writes the small glTF files of the tests into a folder: the fuzzer's seeds.
#include <cmath>
#include <cstdio>
#include <fstream>

#include "support/gltf_cases.h"

int main(int count, char** arguments) {
    if (count != 2) {
        std::fprintf(stderr, "usage: gltf_seeds FOLDER\n");
        return 2;
    }
    auto cases = vndf::test::sound_cases();
    for (const auto& one : vndf::test::defects()) cases.push_back(one);
    constexpr std::size_t longest = 16384;  // as fuzz.sh has it
    for (const auto& one : cases)
        if (one.bytes.size() <= longest)
            std::ofstream(std::string(arguments[1]) + "/" + one.name, std::ios::binary) << one.bytes;
    return 0;
}
