/// The table of a struct's fields for the specification, from the very struct that reads them.
// SPDX-License-Identifier: MIT
#pragma once

#include "meshreel/container/fields.h"

namespace meshreel::container {

/// Collects a row for each field; conditional fields and one item of each list included.
class Table : public FieldIo<Table> {
public:
    static constexpr bool reads = true; ///< reads nothing, so that every value stays zero

    bool failed() const { return false; }
    std::uint64_t integer(const Field& field, std::uint64_t);
    double real(const Field& field, double);
    ByteView bytes(const Field& field, ByteView expected);
    ByteView array(const Field& field, ByteView, std::uint64_t);
    std::uint64_t list_count(const Field& field, std::uint64_t, std::size_t);
    void enter(std::string_view name, std::uint64_t index = any.high);
    void leave();
    bool begin_when(bool condition, std::string_view text);
    void end_when();
    void rule(bool holds, std::string_view name, std::string_view rule);

    std::string markdown() const;

private:
    void row(const Field& field, std::string encoding, const std::string& range);

    std::vector<std::string> path_, conditions_;
    std::string rows_;
};

/// Markdown: field, encoding, values, meaning.
template <class Struct>
std::string table_of()
{
    Table table;
    Struct value;
    value.fields(table);
    return table.markdown();
}

} // namespace meshreel::container
