#include "energy/kept.h"

#include <charconv>

#include <fmt/format.h>

#include "error.h"
#include "hash.h"

namespace vndf::energy {
namespace {

std::string first_line(const std::string& title, std::string_view numbers) {
    return fmt::format("{} {:016x}\n", title, fnv1a(numbers));
}

}  // namespace

std::string kept_text(const std::string& title, const std::vector<float>& numbers) {
    std::string text;
    for (const float x : numbers) text += fmt::format("{:.9g}\n", x);
    return first_line(title, text) + text;
}

std::vector<float> read_kept_text(const std::string& title, std::size_t count, std::string_view text,
                                  const std::string& path) {
    const std::size_t end = text.find('\n');
    const std::string_view numbers = end == text.npos ? std::string_view() : text.substr(end + 1);
    const std::string wanted = first_line(title, numbers);
    if (end == text.npos || text.substr(0, end + 1) != wanted)
        throw InputError(fmt::format("{}:1: no table of this kind, or it is damaged: '{}' is wanted", path,
                                     wanted.substr(0, wanted.size() - 1)));
    std::vector<float> values;
    for (const char *at = numbers.data(), *last = at + numbers.size(); at < last; ++at) {
        float value = 0;
        const auto [next, error] = std::from_chars(at, last, value);
        if (error != std::errc() || !(value >= 0)) break;
        values.push_back(value);
        at = next;
    }
    if (values.size() != count)
        throw InputError(fmt::format("{}: {} numbers, not {}", path, values.size(), count));
    return values;
}

std::string array_text(const std::string& type, const std::string& name,
                       const std::vector<std::string>& numbers) {
    std::string text = fmt::format("VNDF_CONSTANT {} {}[{}] = {{", type, name, numbers.size());
    for (std::size_t i = 0; i < numbers.size(); ++i)
        text += fmt::format("{}{},", i % 12 == 0 ? "\n    " : " ", numbers[i]);
    text.pop_back();
    return text + "};\n";
}

}  // namespace vndf::energy
