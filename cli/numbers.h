/// The numbers of a command line that are more than a number: percents, frame ranges, memory sizes.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "meshreel/base/result.h"
#include "meshreel/io/io.h"

namespace meshreel::cli {

/// "0.1%" or "0.004".
struct Amount {
    double value = 0.0;
    bool percent = false;
};

/// A finite number above 0, with or without %. @fails usage.
Result<Amount> parse_amount(const std::string& text);

/// "10:20", "10:20:2", ":20", "5:", "::2" or "7"; counted from 0, the last one included. @fails usage.
Result<io::FrameRange> parse_frames(const std::string& text);

/// "512M", "4G", "1000000": bytes, with K M G T as powers of 1024. @fails usage.
Result<std::uint64_t> parse_memory(const std::string& text);

/// Accepts finite numbers above 0.
CLI::Validator positive();

/// Accepts these words, and guesses which of them was meant by another one.
CLI::Validator one_of(std::vector<std::string> words);

/// An option's name and what its help says.
struct Described {
    std::string name, help;
};

/// An option whose text a function reads; its error is a usage error that names the option.
template <class Value, class Parse>
CLI::Option* add_parsed(CLI::App& app, const Described& option, Value& value, const Parse& parse)
{
    const auto read = [&value, parse, name = option.name](const std::string& text) {
        auto parsed = parse(text);
        if (!parsed.ok()) throw CLI::ValidationError(name, parsed.error().message);
        value = *std::move(parsed);
    };
    return app.add_option_function<std::string>(option.name, read, option.help);
}

} // namespace meshreel::cli
