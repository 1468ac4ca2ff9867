#include "gltf/json.h"

#include <cmath>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "error.h"

namespace vndf::gltf {
namespace {

// Whole numbers up to it are the same as JSON's and as doubles.
constexpr double whole_limit = 9007199254740992.0;

std::string shown(const nlohmann::json& value) {
    if (value.is_string()) return in_quotes(value.get_ref<const std::string&>());
    if (value.is_object()) return "an object";
    if (value.is_array()) return fmt::format("an array of {}", value.size());
    return value.dump();
}

void require_bounded(const std::string& file, std::string_view text, const Limits& limits) {
    const auto refuse = [&](const std::string& what) { throw InputError(fmt::format("{}: {}", file, what)); };
    if (text.size() > limits.json_bytes)
        refuse(fmt::format("{} bytes of JSON; at most {} are read", text.size(), limits.json_bytes));
    std::uint64_t values = 0;
    unsigned depth = 0;
    bool quotes = false;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const char c = text[i];
        if (quotes) {
            if (c == '\\') ++i;
            if (c == '"') quotes = false;
            continue;
        }
        if (c == '"') quotes = true;
        if (c == '[' || c == '{') ++depth;
        if ((c == ']' || c == '}') && depth > 0) --depth;
        if (c == '[' || c == '{' || c == ',' || c == ':') ++values;
        if (depth > limits.json_depth)
            refuse(fmt::format("JSON nested more than {} deep, at byte {}", limits.json_depth, i));
        if (values > limits.json_values)
            refuse(fmt::format("JSON of more than {} values", limits.json_values));
    }
}

void count_extensions(const nlohmann::json& value, std::map<std::string, std::size_t>& counts) {
    if (!value.is_structured()) return;
    for (const auto& [key, child] : value.items()) {
        if (value.is_object() && key == "extensions" && child.is_object())
            for (const auto& [name, extension] : child.items()) ++counts[name];
        if (!(value.is_object() && key == "extras")) count_extensions(child, counts);
    }
}

}  // namespace

std::string printable(std::string_view text) {
    constexpr std::size_t longest = 60;
    std::string result;
    for (const char c : text.substr(0, longest))
        result += static_cast<unsigned char>(c) < 32 || c == 127 ? '?' : c;
    if (text.size() <= longest) return result;
    // What a cut leaves of a character of several bytes goes as well.
    std::size_t end = result.size();
    while (end > 0 && (static_cast<unsigned char>(result[end - 1]) & 0xC0) == 0x80) --end;
    if (end > 0 && static_cast<unsigned char>(result[end - 1]) >= 0xC0) result.resize(end - 1);
    return result + "...";
}

std::string in_quotes(std::string_view text) {
    return fmt::format("'{}'", printable(text));
}

const nlohmann::json& Item::value() const {
    if (!value_) fail("is missing");
    return *value_;
}

void Item::fail(const std::string& what) const {
    throw InputError(place_.empty() ? fmt::format("{}: {}", *file_, what)
                                    : fmt::format("{}: {}: {}", *file_, place_, what));
}

Item Item::operator[](const char* key) const {
    std::string place = place_.empty() ? key : fmt::format("{}.{}", place_, key);
    if (!value_) return {file_, nullptr, std::move(place)};
    if (!value_->is_object()) fail(fmt::format("{} is no object", shown(*value_)));
    const auto found = value_->find(key);
    return {file_, found == value_->end() ? nullptr : &*found, std::move(place)};
}

Item Item::at(std::size_t i) const {
    if (i >= size()) fail(fmt::format("has no element {}", i));
    return {file_, &(*value_)[i], fmt::format("{}[{}]", place_, i)};
}

std::size_t Item::size() const {
    if (!value_) return 0;
    if (!value_->is_array()) fail(fmt::format("{} is no array", shown(*value_)));
    return value_->size();
}

double Item::number(double low, double high) const {
    if (!value().is_number()) fail(fmt::format("{} is no number", shown(*value_)));
    const double x = value_->get<double>();
    if (!(x >= low && x <= high))
        fail(fmt::format("{:g} is out of range; {:g} to {:g} are allowed", x, low, high));
    return x;
}

std::uint64_t Item::whole(std::uint64_t low, std::uint64_t high) const {
    const bool is_whole = value().is_number() && std::floor(value_->get<double>()) == value_->get<double>() &&
                          std::abs(value_->get<double>()) < whole_limit;
    if (!is_whole) fail(fmt::format("{} is no whole number", shown(*value_)));
    const double x = value_->get<double>();
    if (!(x >= static_cast<double>(low) && x <= static_cast<double>(high)))
        fail(fmt::format("{} is out of range; {} to {} are allowed", x, low, high));
    return static_cast<std::uint64_t>(x);
}

std::size_t Item::index(std::size_t count, const char* what) const {
    constexpr auto any = static_cast<std::uint64_t>(whole_limit);
    const std::uint64_t i = whole(0, any);
    if (i >= count)
        fail(count == 0
                 ? fmt::format("there is no {0} {1}: the file has no {0}", what, i)
                 : fmt::format("there is no {0} {1}; those of the file are 0 to {2}", what, i, count - 1));
    return i;
}

std::string Item::text() const {
    if (!value().is_string()) fail(fmt::format("{} is no text", shown(*value_)));
    return value_->get<std::string>();
}

bool Item::truth() const {
    if (!value().is_boolean()) fail(fmt::format("{} is neither true nor false", shown(*value_)));
    return value_->get<bool>();
}

void Item::read_numbers(double* to, std::size_t count) const {
    if (!value().is_array() || value_->size() != count)
        fail(fmt::format("{}, where {} numbers belong", shown(*value_), count));
    for (std::size_t i = 0; i < count; ++i) {
        const nlohmann::json& element = (*value_)[i];
        if (!element.is_number()) at(i).fail(fmt::format("{} is no number", shown(element)));
        to[i] = element.get<double>();
    }
}

Json::Json(std::string file, std::string_view text, const Limits& limits) : file_(std::move(file)) {
    require_bounded(file_, text, limits);
    try {
        value_ = std::make_unique<nlohmann::json>(nlohmann::json::parse(text.begin(), text.end()));
    } catch (const nlohmann::json::parse_error& error) {
        throw InputError(fmt::format("{}: no JSON, as seen at byte {}", file_, error.byte));
    } catch (const nlohmann::json::exception&) {
        throw InputError(fmt::format("{}: a number in the JSON is too large", file_));
    }
    if (!value_->is_object()) throw InputError(fmt::format("{}: the JSON is no object", file_));
}

Json::~Json() = default;

Item Json::root() const {
    return {file_, *value_};
}

std::map<std::string, std::size_t> Json::extensions() const {
    std::map<std::string, std::size_t> counts;
    count_extensions(*value_, counts);
    return counts;
}

}  // namespace vndf::gltf
