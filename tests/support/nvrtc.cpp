// Compiles one file by NVRTC: nvrtc FILE OPTION...; prints its log, exit status 1 if it fails.
#include <cstdio>
#include <fstream>
#include <iterator>
#include <string>

#include <nvrtc.h>

int main(int argc, char** argv) {
    std::ifstream file(argv[1]);
    const std::string text{std::istreambuf_iterator<char>(file), {}};
    nvrtcProgram program;
    nvrtcCreateProgram(&program, text.c_str(), argv[1], 0, nullptr, nullptr);
    const nvrtcResult result = nvrtcCompileProgram(program, argc - 2, argv + 2);
    std::size_t size = 0;
    nvrtcGetProgramLogSize(program, &size);
    std::string log(size, '\0');
    nvrtcGetProgramLog(program, log.data());
    if (size > 1) std::printf("%s\n", log.c_str());
    return result != NVRTC_SUCCESS;
}
