// What the parts of the stages' C++ build share.
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <vector>

namespace vndf::render {

// What an argument is for a stage: the address of the buffer, or the value.
struct Given {
    void* buffer;
    const void* value;
};

// Runs items begin ... end - 1.
using Run = void (*)(const std::vector<Given>& given, std::size_t begin, std::size_t end);
using Runs = std::map<std::string, Run>;

// Every distribution and Fresnel model that materials are compiled for (cpp_materials.cpp; CMake has the same list).
#define CLVNDF_CPP_MATERIALS(row)                                                          \
    row(ggx, none) row(ggx, conductor) row(ggx, schlick) row(ggx, f82) row(beckmann, none) \
        row(beckmann, conductor) row(beckmann, schlick) row(beckmann, f82)

#define CLVNDF_DECLARE(ndf, fresnel) Runs cpp_materials_##ndf##_##fresnel();
CLVNDF_CPP_MATERIALS(CLVNDF_DECLARE)
#undef CLVNDF_DECLARE

}  // namespace vndf::render
