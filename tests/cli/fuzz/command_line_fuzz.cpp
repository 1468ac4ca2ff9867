// libFuzzer target: any arguments, one a line, are an action or a refusal. Nothing is carried out.
#include <cstdint>
#include <cstdio>
#include <cstdlib>

#include "cli/command_line.h"
#include "error.h"
#include "support/csv_oracle.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    std::string text(reinterpret_cast<const char*>(data), size);
    for (char& c : text)
        if (c == '\0') c = ' ';  // no argument holds one
    const std::vector<std::string> words = vndf::test::split(text, '\n');
    std::vector<const char*> arguments{"clvndf"};
    for (const std::string& word : words) arguments.push_back(word.c_str());
    vndf::cli::CommandLine line;
    try {
        line.parse(static_cast<int>(arguments.size()), arguments.data());
    } catch (const vndf::InputError& error) {
        if (std::string(error.what()).empty()) std::abort();
        return 0;
    }
    if (!line.common().action) std::abort();
    return 0;
}
