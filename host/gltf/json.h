// JSON that nobody trusts: bounded before it is parsed, and values that know where they stand.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <string_view>

#include <nlohmann/json_fwd.hpp>

#include "gltf/limits.h"

namespace vndf::gltf {

// Text of a file as part of a message: one line of printable characters, not long.
std::string printable(std::string_view text);
std::string in_quotes(std::string_view text);

// A value, or the lack of one, and the way to it from the root. It lives as long as its Json. Every getter throws InputError,
// which names the file and the place, if the value is there and is not what is asked for.
class Item {
  public:
    Item(const std::string& file, const nlohmann::json& root) : file_(&file), value_(&root) {}

    explicit operator bool() const { return value_ != nullptr; }
    Item operator[](const char* key) const;  // of an object; of what is not there, nothing
    Item at(std::size_t i) const;            // of an array
    std::size_t size() const;                // of an array; of what is not there, 0

    double number(double low, double high) const;
    std::uint64_t whole(std::uint64_t low, std::uint64_t high) const;
    // A number of one of `count` things, of which `what` says what they are.
    std::size_t index(std::size_t count, const char* what) const;
    std::string text() const;
    bool truth() const;
    template <std::size_t N>
    std::array<double, N> numbers() const {
        std::array<double, N> result{};
        read_numbers(result.data(), N);
        return result;
    }

    double number_or(double otherwise, double low, double high) const {
        return value_ ? number(low, high) : otherwise;
    }
    std::uint64_t whole_or(std::uint64_t otherwise, std::uint64_t low, std::uint64_t high) const {
        return value_ ? whole(low, high) : otherwise;
    }
    std::string text_or(const std::string& otherwise) const { return value_ ? text() : otherwise; }
    bool truth_or(bool otherwise) const { return value_ ? truth() : otherwise; }

    const std::string& place() const { return place_; }
    [[noreturn]] void fail(const std::string& what) const;

  private:
    Item(const std::string* file, const nlohmann::json* value, std::string place)
        : file_(file), value_(value), place_(std::move(place)) {}
    void read_numbers(double* to, std::size_t count) const;
    const nlohmann::json& value() const;

    const std::string* file_;
    const nlohmann::json* value_;  // null: not there
    std::string place_;
};

class Json {
  public:
    // Throws InputError if the text is too long, too deep or no JSON, or if its root is no object.
    Json(std::string file, std::string_view text, const Limits& limits);
    ~Json();
    Item root() const;
    // How often each extension is written.
    std::map<std::string, std::size_t> extensions() const;

  private:
    std::string file_;
    std::unique_ptr<nlohmann::json> value_;
};

}  // namespace vndf::gltf
