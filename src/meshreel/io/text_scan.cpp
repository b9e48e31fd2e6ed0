/// Scanning text: line ends of three kinds, numbers rounded once.
// SPDX-License-Identifier: MIT
#include "meshreel/io/text_scan.h"

#include <charconv>
#include <limits>
#include <string>

namespace meshreel::io {

namespace {

bool is_space(char c)
{
    return c == ' ' || c == '\t' || c == '\r' || c == '\n' || c == '\v' || c == '\f';
}
bool is_line_end(char c)
{
    return c == '\n' || c == '\r';
}

/// A number beyond the range of its type is nearest to zero or to infinity.
template <class Number>
Number beyond_range(std::string_view word)
{
    const bool negative = word.front() == '-';
    const std::size_t exponent = word.find_first_of("eE");
    const bool tiny = exponent != std::string_view::npos ? word.substr(exponent + 1).starts_with('-')
                                                         : word.find_first_of("123456789") > word.find('.');
    const Number size = tiny ? Number(0) : std::numeric_limits<Number>::infinity();
    return negative ? -size : size;
}

template <class Number>
std::optional<Number> to_number(std::string_view word)
{
    if (word.starts_with('+')) word.remove_prefix(1);
    Number value{};
    const auto [end, problem] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (end != word.data() + word.size() || word.empty() || word.front() == '+') return std::nullopt;
    if (problem == std::errc()) return value;
    if (problem == std::errc::result_out_of_range) return beyond_range<Number>(word);
    return std::nullopt;
}

} // namespace

LineScanner::LineScanner(ByteView text, Continuation continuation)
    : text_(reinterpret_cast<const char*>(text.data()), text.size()),
      backslash_(continuation == Continuation::backslash)
{
}

bool LineScanner::continued(std::size_t line_end) const
{
    return backslash_ && line_end > at_ && text_[line_end - 1] == '\\';
}

bool LineScanner::next_line()
{
    if (next_ >= text_.size()) return false;
    at_ = next_;
    line_ = lines_read_ + 1;
    for (std::size_t search = at_;;) {
        end_ = search;
        while (end_ < text_.size() && !is_line_end(text_[end_])) ++end_;
        next_ = end_ < text_.size() ? end_ + 1 : end_;
        if (end_ < text_.size() && text_[end_] == '\r' && next_ < text_.size() && text_[next_] == '\n') ++next_;
        ++lines_read_;
        if (!continued(end_) || next_ >= text_.size()) return true;
        search = next_;
    }
}

void LineScanner::skip_space()
{
    while (at_ < end_) {
        const bool joint = backslash_ && text_[at_] == '\\' && (at_ + 1 == end_ || is_line_end(text_[at_ + 1]));
        if (!joint && !is_space(text_[at_])) return;
        ++at_;
    }
}

std::string_view LineScanner::word()
{
    skip_space();
    const std::size_t begin = at_;
    if (begin < end_ && text_[begin] == '#') at_ = end_;
    if (at_ == end_) return {};
    while (at_ < end_ && !is_space(text_[at_])) ++at_;
    const bool joined = backslash_ && text_[at_ - 1] == '\\' && (at_ == text_.size() || is_line_end(text_[at_]));
    return text_.substr(begin, at_ - begin - (joined && at_ - begin > 1 ? 1 : 0));
}

std::string_view LineScanner::rest()
{
    skip_space();
    std::size_t end = at_;
    while (end < end_ && !is_line_end(text_[end])) ++end;
    const bool joined = backslash_ && end > at_ && text_[end - 1] == '\\';
    if (joined && end < text_.size()) --end;
    while (end > at_ && is_space(text_[end - 1])) --end;
    const std::string_view found = text_.substr(at_, end - at_);
    at_ = end_;
    return found;
}

std::optional<float> to_float(std::string_view word)
{
    return to_number<float>(word);
}
std::optional<double> to_double(std::string_view word)
{
    return to_number<double>(word);
}

std::optional<std::int64_t> to_integer(std::string_view word)
{
    if (word.starts_with('+')) word.remove_prefix(1);
    std::int64_t value = 0;
    const auto [end, problem] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (problem != std::errc() || end != word.data() + word.size() || word.starts_with('+')) return std::nullopt;
    return value;
}

std::string in_quotes(std::string_view word)
{
    constexpr std::size_t longest = 40;
    std::string shown = "'";
    for (char c : word.substr(0, longest)) shown += c >= ' ' && c < 127 ? c : '?';
    return shown + (word.size() > longest ? "...'" : "'");
}

} // namespace meshreel::io
