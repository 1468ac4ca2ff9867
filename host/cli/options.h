// Options that several commands have, and kinds of options.
#pragma once

#include <charconv>
#include <string>
#include <type_traits>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "conformance/runs/user_kernel.h"
#include "error.h"
#include "registry.h"

namespace vndf::cli {

// several: of a command that takes --device all, what the devices do: "share the work".
CLI::Option* add_device(CLI::App& command, std::string& device, const std::string& several = {});

// --only; `pattern` is set to what was given, empty without the option.
CLI::Option* add_only(CLI::App& command, std::string& pattern);

// --kernel FILE with --function NAME, if `function` says what, --as and --options: a user's function. The option --kernel.
CLI::Option* add_kernel(CLI::App& command, conformance::UserOptions& user, const std::string& kernel,
                        const std::string& as, const std::string& function = "");

// --alpha LO:HI.
CLI::Option* add_alpha(CLI::App& command, conformance::AlphaRange& range, const std::string& description);

// The functions that --only selects, all without it. Throws InputError if there is none.
std::vector<const Function*> selected_by(const std::string& pattern);

// An option with a number from `low` to `high`. CLI11's own would let -1 wrap around, take NaN for a number of any
// range and print a range without end in 309 digits.
template <class Number>
CLI::Option* add_number(CLI::App& command, const std::string& name, Number& number, Number low, Number high,
                        const std::string& description) {
    const auto parse = [=, &number](const std::string& text) {
        const char* const last = text.data() + text.size();
        Number read{};
        const auto [end, error] = std::from_chars(text.data(), last, read);
        if (error == std::errc() && end == last && read >= low && read <= high) {
            number = read;
            return;
        }
        throw InputError(fmt::format("{}: '{}' is no {} from {} to {}", name, text,
                                     std::is_integral_v<Number> ? "whole number" : "number", low, high));
    };
    return command.add_option_function<std::string>(name, parse, description)
        ->type_name(fmt::format("{}..{}", low, high));
}

}  // namespace vndf::cli
