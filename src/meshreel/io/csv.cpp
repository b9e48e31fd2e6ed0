/// Cells one after the other, by a scanner that knows its line.
// SPDX-License-Identifier: MIT
#include "meshreel/io/csv.h"

#include <algorithm>
#include <iterator>
#include <set>
#include <string_view>

#include "meshreel/base/text.h"
#include "meshreel/io/text_scan.h"

namespace meshreel::io {

namespace {

constexpr std::string_view byte_order_mark = "\xef\xbb\xbf";
constexpr std::size_t bytes_a_cell = sizeof(std::string) + 1; // at least, of memory for a byte of text

/// The separator that a header has most of.
char separator_of(std::string_view header)
{
    const char separators[] = {'\t', ';', ','};
    const auto fewer = [&](char a, char b) {
        return std::count(header.begin(), header.end(), a) < std::count(header.begin(), header.end(), b);
    };
    return *std::max_element(std::begin(separators), std::end(separators), fewer);
}

std::string_view without_blanks(std::string_view text)
{
    const auto is_blank = [](char c) { return c == ' ' || c == '\t'; };
    while (!text.empty() && is_blank(text.front())) text.remove_prefix(1);
    while (!text.empty() && is_blank(text.back())) text.remove_suffix(1);
    return text;
}

bool is_control(char c)
{
    return (c >= 0 && c < ' ' && c != '\t') || c == '\x7f';
}

/// Walks over the cells of a table.
class CsvScanner {
public:
    CsvScanner(std::string_view text, char separator) : text_(text), separator_(separator) {}

    /// The next row with a cell that is not empty, or one without cells at the end.
    Result<CsvRow> row()
    {
        for (;;) {
            skip_empty_lines();
            CsvRow row{line_, {}};
            if (at_ == text_.size()) return row;
            do {
                MESHREEL_TRY(std::string cell, next_cell(row.cells.size() + 1));
                row.cells.push_back(std::move(cell));
            } while (take(separator_));
            end_line();
            if (row.cells.size() > 1 || !row.cells.front().empty()) return row;
        }
    }

private:
    bool at_line_end() const
    {
        return at_ == text_.size() || text_[at_] == '\n' || text_.substr(at_).starts_with("\r\n");
    }
    bool take(char c)
    {
        if (at_ == text_.size() || text_[at_] != c) return false;
        ++at_;
        return true;
    }
    void end_line()
    {
        take('\r');
        if (take('\n')) ++line_;
    }
    void skip_empty_lines()
    {
        while (at_ < text_.size() && at_line_end()) end_line();
    }
    void skip_blanks()
    {
        while (at_ < text_.size() && text_[at_] != separator_ && (text_[at_] == ' ' || text_[at_] == '\t')) ++at_;
    }
    Error wrong(std::size_t column, std::string message) const
    {
        return bad_input(std::move(message), concat("column ", column), at_line(line_));
    }

    Result<std::string> next_cell(std::size_t column)
    {
        skip_blanks();
        if (take('"')) return quoted(column);
        const std::size_t begin = at_;
        for (; !at_line_end() && text_[at_] != separator_; ++at_) {
            if (text_[at_] == '"') return wrong(column, "a quote inside a cell that does not begin with one");
            if (is_control(text_[at_])) return wrong(column, "a control character");
        }
        return std::string(without_blanks(text_.substr(begin, at_ - begin)));
    }

    /// A cell whose first quote is taken.
    Result<std::string> quoted(std::size_t column)
    {
        const std::uint64_t first_line = line_;
        std::string cell;
        for (; at_ < text_.size(); ++at_) {
            if (text_[at_] == '"' && !text_.substr(at_ + 1).starts_with('"')) return after_quote(column, cell);
            at_ += text_[at_] == '"' ? 1 : 0; // two stand for one
            if (is_control(text_[at_]) && !at_line_end()) return wrong(column, "a control character");
            line_ += text_[at_] == '\n' ? 1 : 0;
            cell += text_[at_];
        }
        return bad_input("a quote that does not end", concat("column ", column), at_line(first_line));
    }

    /// Nothing may follow the quote that ends a cell but blanks.
    Result<std::string> after_quote(std::size_t column, const std::string& cell)
    {
        ++at_;
        skip_blanks();
        if (at_line_end() || text_[at_] == separator_) return cell;
        return wrong(column, "more text after the quote that ends a cell");
    }

    std::string_view text_;
    char separator_;
    std::size_t at_ = 0;
    std::uint64_t line_ = 1;
};

Status check_csv_header(const CsvRow& header)
{
    std::set<std::string_view> names;
    for (std::size_t i = 0; i < header.cells.size(); ++i) {
        const std::string& name = header.cells[i];
        if (!name.empty() && names.insert(name).second) continue;
        const std::string problem =
            name.empty() ? "it has no name" : concat("another one is ", in_quotes(name), " too");
        return bad_input(problem, concat("column ", i + 1), at_line(header.line));
    }
    return Ok{};
}

} // namespace

Result<Csv> parse_csv(ByteView bytes, const DecodeLimits& limits)
{
    std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    if (text.size() > limits.max_memory / bytes_a_cell) return bad_input("the table does not fit in the memory limit");
    if (text.starts_with(byte_order_mark)) text.remove_prefix(byte_order_mark.size());
    const std::size_t begin = std::min(text.find_first_not_of("\r\n"), text.size());
    const std::size_t length = text.find('\n', begin) - begin; // to the end where there is none
    Csv csv{separator_of(text.substr(begin, length)), {}, {}};
    CsvScanner scanner(text, csv.separator);
    MESHREEL_TRY(csv.header, scanner.row());
    if (csv.header.cells.empty()) return bad_input("there is no header", {}, at_line(1));
    MESHREEL_CHECK(check_csv_header(csv.header));
    for (;;) {
        MESHREEL_TRY(CsvRow row, scanner.row());
        if (row.cells.empty()) break;
        if (row.cells.size() != csv.header.cells.size())
            return bad_input(concat("cells: ", row.cells.size(), ", but the header has ", csv.header.cells.size()), {},
                             at_line(row.line));
        csv.rows.push_back(std::move(row));
    }
    if (csv.rows.empty()) return bad_input("there is no row under the header", {}, at_line(csv.header.line));
    return csv;
}

} // namespace meshreel::io
