/// A file told field by field: offset, size, name, value, meaning, from the very structs that read it.
// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <string>

#include "meshreel/container/chunks.h"
#include "meshreel/container/stream.h"

namespace meshreel::container {

/// A Reader that writes a line for each field it meets.
class Explainer : public FieldIo<Explainer> {
public:
    static constexpr bool reads = true;

    Explainer(Source source, const DecodeLimits& limits, std::string& lines)
        : reader_(std::move(source), limits), lines_(lines)
    {
    }

    Status finish() { return reader_.finish(); }
    bool failed() const { return reader_.failed(); }
    const Reader& reader() const { return reader_; }

    std::uint64_t integer(const Field& field, std::uint64_t ignored);
    double real(const Field& field, double ignored);
    ByteView bytes(const Field& field, ByteView expected);
    ByteView array(const Field& field, ByteView ignored, std::uint64_t count);
    std::uint64_t list_count(const Field& field, std::uint64_t ignored, std::size_t item_size);
    void enter(std::string_view name, std::uint64_t index = Reader::no_index);
    void leave();
    bool begin_when(bool condition, std::string_view text) { return reader_.begin_when(condition, text); }
    void end_when() {}
    void rule(bool holds, std::string_view name, std::string_view rule) { reader_.rule(holds, name, rule); }

private:
    void line(const Field& field, std::uint64_t begin, const std::string& value);

    static constexpr std::uint64_t items_shown = 100; ///< of a list; the others are read, not told
    Reader reader_;
    std::string& lines_;
    std::vector<bool> quiet_; ///< a level of nesting each
    std::uint64_t quiet_levels_ = 0;
};

/// Tells the fields of a struct that is all of `source`.
template <class Struct>
Status explain_fields(Source source, const DecodeLimits& limits, std::string& lines)
{
    Explainer explainer(std::move(source), limits, lines);
    Struct value;
    value.fields(explainer);
    return explainer.finish();
}

/// What a codec and the connectivity coder say of their own bytes: the payload of CONN, and the payload within SEGM.
/// Appends lines (explain_fields); none where it has nothing to say.
using ExplainPayload = std::function<Status(const Header& header, Tag type, Source payload, std::string& lines)>;

/// Every field of every chunk, a line each. @fails bad_input: a field of a chunk is wrong.
Result<std::string> explain(const StreamReader& file, const ExplainPayload& payloads = {});

} // namespace meshreel::container
