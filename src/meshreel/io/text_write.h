/// Text built in memory: numbers in the fewest digits that read back the same.
// SPDX-License-Identifier: MIT
#pragma once

#include <charconv>
#include <string_view>
#include <type_traits>

#include "meshreel/base/views.h"

namespace meshreel::io {

/// Appends words and numbers to a growing block of bytes.
class TextWriter {
public:
    TextWriter& text(std::string_view words)
    {
        bytes_.insert(bytes_.end(), words.begin(), words.end());
        return *this;
    }
    /// The shortest decimal number that is nearest to this one and no other of its type.
    template <class Number>
    requires std::is_arithmetic_v<Number> TextWriter& number(Number value)
    {
        char digits[64];
        return text({digits, std::to_chars(digits, digits + sizeof digits, value).ptr});
    }
    /// A name from outside: line ends and other control characters would break the line, and become '_'.
    TextWriter& name(std::string_view words)
    {
        for (char c : words) bytes_.push_back(static_cast<unsigned char>(c) < ' ' ? '_' : static_cast<std::uint8_t>(c));
        return *this;
    }
    Bytes take() { return std::move(bytes_); }

private:
    Bytes bytes_;
};

} // namespace meshreel::io
