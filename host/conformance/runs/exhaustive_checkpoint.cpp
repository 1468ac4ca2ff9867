#include "conformance/runs/exhaustive_checkpoint.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "error.h"

namespace vndf::conformance {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* format = "clvndf check --exhaustive, checkpoint 1";

// What a text of this form may hold, and where it was found: "samplers[2].inputs".
class Reader {
  public:
    Reader(const Json& value, std::string path, const std::string& file)
        : value_(value), path_(std::move(path)), file_(file) {}

    Reader operator[](const char* name) const {
        if (!value_.is_object()) fail("is no object");
        const auto found = value_.find(name);
        if (found == value_.end()) fail(fmt::format("has no member '{}'", name));
        return {*found, path_.empty() ? name : path_ + '.' + name, file_};
    }
    Reader operator[](std::size_t i) const { return {value_.at(i), fmt::format("{}[{}]", path_, i), file_}; }
    void require_size(std::size_t size) const {
        if (!value_.is_array() || value_.size() != size)
            fail(fmt::format("is no array of {} elements", size));
    }
    std::uint64_t count(std::uint64_t most) const {
        if (!value_.is_number_unsigned() || value_.get<std::uint64_t>() > most)
            fail(fmt::format("is no whole number from 0 to {}", most));
        return value_;
    }
    double seconds() const {
        if (!value_.is_number() || !(value_.get<double>() >= 0) || !std::isfinite(value_.get<double>()))
            fail("is no number of seconds");
        return value_;
    }
    std::string text() const {
        if (!value_.is_string()) fail("is no text");
        return value_;
    }
    [[noreturn]] void fail(const std::string& what) const {
        throw InputError(
            fmt::format("--checkpoint '{}': damaged: {} {}", file_, path_.empty() ? "it" : path_, what));
    }

  private:
    const Json& value_;
    std::string path_;
    const std::string& file_;
};

Json parsed(const std::string& text, const std::string& file) {
    Json json = Json::parse(text, nullptr, false);
    if (!json.is_object() || json.value("format", Json()) != format)
        throw InputError(
            fmt::format("--checkpoint '{}': no checkpoint of check --exhaustive in this version", file));
    return json;
}

// An input in hex floats, which goes to a terminal: "wo_x=0x1.8p-1 ...".
std::string read_row(const Reader& reader) {
    const std::string row = reader.text();
    const auto fits = [](unsigned char c) {
        return std::isalnum(c) || std::string_view("=._+- ").find(c) < 6;
    };
    if (row.size() > 1000 || !std::all_of(row.begin(), row.end(), fits)) reader.fail("is no input");
    return row;
}

void read_sampler(const Reader& reader, std::uint64_t inputs, Exhausted& exhausted) {
    if (reader["sampler"].text() != exhausted.sampler->name)
        reader["sampler"].fail("is not '" + exhausted.sampler->name + "'");
    if (reader["inputs"].count(~std::uint64_t{0}) != inputs)
        reader["inputs"].fail(fmt::format("is not {}, which is what so many pieces have", inputs));
    exhausted.inputs = inputs;
    exhausted.seconds = reader["seconds"].seconds();
    reader["offenders"].require_size(invariant_count);
    for (std::size_t i = 0; i < invariant_count; ++i) {
        const Reader offenders = reader["offenders"][i];
        exhausted.offenders[i].count = offenders["count"].count(inputs);
        exhausted.offenders[i].first = read_row(offenders["first"]);
        if ((exhausted.offenders[i].count == 0) != exhausted.offenders[i].first.empty())
            offenders.fail("has a count or a first one without the other");
    }
}

}  // namespace

std::string checkpoint(const ExhaustiveWalk& walk, const std::string& run, double seconds) {
    const ExhaustiveReport& report = walk.report();
    Json samplers = Json::array();
    for (const Exhausted& exhausted : report.samplers) {
        Json offenders = Json::array();
        for (const Offenders& o : exhausted.offenders)
            offenders.push_back({{"invariant", o.invariant}, {"count", o.count}, {"first", o.first}});
        samplers.push_back({{"sampler", exhausted.sampler->name},
                            {"inputs", exhausted.inputs},
                            {"seconds", exhausted.seconds},
                            {"offenders", offenders}});
    }
    const Json text{{"format", format},          {"run", run},          {"pieces", walk.pieces()},
                    {"walked", walk.taken()},    {"seconds", seconds},  {"device", report.device},
                    {"options", report.options}, {"math", report.math}, {"samplers", samplers}};
    return text.dump(1, ' ', false, Json::error_handler_t::replace) + '\n';
}

double resume(ExhaustiveWalk& walk, const std::string& text, const std::string& run,
              const std::string& file) {
    const Json json = parsed(text, file);
    const Reader reader(json, "", file);
    if (const std::string other = reader["run"].text(); other != run)
        throw InputError(
            fmt::format("--checkpoint '{}': of another run: {}; this one is {}", file, other, run));
    const auto walked = static_cast<std::uint32_t>(reader["walked"].count(walk.pieces()));
    ExhaustiveReport report = walk.report();
    report.device = reader["device"].text();
    report.options = reader["options"].text();
    report.math = reader["math"].text();
    reader["samplers"].require_size(report.samplers.size());
    for (std::size_t i = 0; i < report.samplers.size(); ++i) {
        read_sampler(reader["samplers"][i], walk.inputs(i, walked), report.samplers[i]);
        report.inputs += report.samplers[i].inputs;
    }
    walk.resume(walked, std::move(report));
    return reader["seconds"].seconds();
}

}  // namespace vndf::conformance
