/// Lines of text from fields.
// SPDX-License-Identifier: MIT
#include "meshreel/container/explain.h"

#include <cstdio>
#include <cstdlib>

#include "meshreel/base/text.h"

namespace meshreel::container {

namespace {

std::string padded_left(std::string text, std::size_t width)
{
    return text.size() >= width ? text : std::string(width - text.size(), ' ') + text;
}
std::string padded(std::string text, std::size_t width)
{
    if (text.size() < width) text.append(width - text.size(), ' ');
    return text;
}

/// The fewest digits that give the number back.
std::string digits_of(double value, int most_digits)
{
    char text[40];
    for (int digits = 1; digits <= most_digits; ++digits) {
        std::snprintf(text, sizeof text, "%.*g", digits, value);
        const double again = std::strtod(text, nullptr);
        if (most_digits == 9 ? static_cast<float>(again) == static_cast<float>(value) : again == value) break;
    }
    std::string result = text;
    for (char& c : result) c = c == ',' ? '.' : c; // whatever the program's locale
    return result;
}

std::string hex(std::uint8_t byte)
{
    constexpr char digits[] = "0123456789abcdef";
    return {digits[byte >> 4], digits[byte & 15]};
}

std::string in_quotes(ByteView text)
{
    constexpr std::size_t longest = 80;
    std::string all = "\"";
    for (std::size_t i = 0; i < std::min(text.size(), longest); ++i) {
        const std::uint8_t c = text[i];
        const bool plain = c >= 0x20 && c != 0x7f && c != '"' && c != '\\';
        all += plain ? std::string(1, static_cast<char>(c)) : "\\x" + hex(c);
    }
    return all + (text.size() > longest ? "\"..." : "\"");
}

std::string dump(ByteView bytes)
{
    constexpr std::size_t most = 8;
    std::string all = concat(bytes.size(), bytes.size() == 1 ? " byte" : " bytes");
    for (std::size_t i = 0; i < std::min(bytes.size(), most); ++i) all += (i == 0 ? ": " : " ") + hex(bytes[i]);
    return all + (bytes.size() > most ? " ..." : "");
}

std::string integer_text(const Field& field, std::uint64_t value)
{
    if (field.encoding == Encoding::tag) return name_of(static_cast<Tag>(value));
    if (field.encoding == Encoding::zigzag) return concat(unzigzag(value));
    return value < field.names.size() ? concat(value, " (", field.names[value], ")") : concat(value);
}

} // namespace

void Explainer::line(const Field& field, std::uint64_t begin, const std::string& value)
{
    if (failed() || quiet_levels_ != 0) return;
    lines_ += padded_left(concat(begin), 10) + padded_left(concat(reader_.offset() - begin), 10) + "  ";
    lines_ +=
        padded(reader_.full_name(field.name), 30) + " " + padded(value, 30) + " " + std::string(field.meaning) + "\n";
}

std::uint64_t Explainer::integer(const Field& field, std::uint64_t ignored)
{
    const std::uint64_t begin = reader_.offset();
    const std::uint64_t value = reader_.integer(field, ignored);
    line(field, begin, integer_text(field, value));
    return value;
}

double Explainer::real(const Field& field, double ignored)
{
    const std::uint64_t begin = reader_.offset();
    const double value = reader_.real(field, ignored);
    line(field, begin, digits_of(value, field.encoding == Encoding::f32 ? 9 : 17));
    return value;
}

ByteView Explainer::bytes(const Field& field, ByteView expected)
{
    const std::uint64_t begin = reader_.offset();
    const ByteView value = reader_.bytes(field, expected);
    line(field, begin, field.encoding == Encoding::text ? in_quotes(value) : dump(value));
    return value;
}

ByteView Explainer::array(const Field& field, ByteView ignored, std::uint64_t count)
{
    const std::uint64_t begin = reader_.offset();
    const ByteView value = reader_.array(field, ignored, count);
    constexpr std::uint64_t most = 4;
    const bool single = field.encoding == Encoding::f32;
    std::string text = concat(count, " numbers");
    for (std::size_t i = 0; i < std::min(failed() ? 0 : count, most); ++i)
        text +=
            (i == 0 ? ": " : " ") + (single ? digits_of(static_cast<double>(load_real<float>(value.data() + 4 * i)), 9)
                                            : digits_of(load_real<double>(value.data() + 8 * i), 17));
    line(field, begin, text + (count > most ? " ..." : ""));
    return value;
}

std::uint64_t Explainer::list_count(const Field& field, std::uint64_t ignored, std::size_t item_size)
{
    const std::uint64_t begin = reader_.offset();
    const std::uint64_t count = reader_.list_count(field, ignored, item_size);
    line(field, begin,
         concat(count, " items", count > items_shown ? concat(", the first ", items_shown, " told") : ""));
    return count;
}

void Explainer::enter(std::string_view name, std::uint64_t index)
{
    reader_.enter(name, index);
    quiet_.push_back(index != Reader::no_index && index >= items_shown);
    quiet_levels_ += quiet_.back();
}

void Explainer::leave()
{
    quiet_levels_ -= quiet_.back();
    quiet_.pop_back();
    reader_.leave();
}

namespace {

struct Opaque {
    ByteView bytes;
    void fields(auto& io) { io.rest("payload", bytes, "not explained"); }
};

/// The payload of a chunk that is not a codec's.
Status explain_common(const Chunk& chunk, const DecodeLimits& limits, std::string& lines)
{
    switch (chunk.type) {
    case type::head:
        return explain_fields<Header>(chunk.source(), limits, lines);
    case type::time:
        return explain_fields<TimeChunk>(chunk.source(), limits, lines);
    case type::meta:
        return explain_fields<MetaChunk>(chunk.source(), limits, lines);
    case type::attr:
        return explain_fields<AttributeChunk>(chunk.source(), limits, lines);
    case type::matl:
    case type::grup:
        return explain_fields<NamesChunk>(chunk.source(), limits, lines);
    case type::aset:
        return explain_fields<AssetChunk>(chunk.source(), limits, lines);
    case type::indx:
        return explain_fields<Index>(chunk.source(), limits, lines);
    case type::tail:
        return explain_fields<Tail>(chunk.source(), limits, lines);
    case type::segm:
        return explain_fields<Segment>(chunk.source(), limits, lines);
    default:
        return explain_fields<Opaque>(chunk.source(), limits, lines);
    }
}

/// CONN as its coder tells it, or as opaque bytes; SEGM's payload likewise, after its own fields.
Status explain_payload(const StreamReader& file, const Chunk& chunk, const ExplainPayload& payloads, std::string& lines)
{
    const bool codecs = chunk.type == type::conn || chunk.type == type::segm;
    if (!codecs || !payloads) return explain_common(chunk, file.limits(), lines);
    Source source = chunk.source();
    if (chunk.type == type::segm) {
        MESHREEL_CHECK(explain_common(chunk, file.limits(), lines));
        MESHREEL_TRY(const Segment segment, read_fields<Segment>(chunk.source(), file.limits()));
        const std::uint64_t skipped = source.bytes.size() - segment.payload.size();
        source = {segment.payload, chunk.offset + skipped, "SEGM.payload"};
    }
    MESHREEL_TRY(const Header header, file.read<Header>(type::head));
    const std::size_t before = lines.size();
    MESHREEL_CHECK(payloads(header, chunk.type, source, lines));
    if (lines.size() != before || chunk.type == type::segm) return Ok{};
    return explain_common(chunk, file.limits(), lines);
}

} // namespace

Result<std::string> explain(const StreamReader& file, const ExplainPayload& payloads)
{
    std::string lines = padded_left("offset", 10) + padded_left("size", 10) + "  " + padded("field", 30) + " " +
                        padded("value", 30) + " meaning\n";
    const ByteView bytes = file.file();
    const DecodeLimits& limits = file.limits();
    MESHREEL_CHECK(explain_fields<Preamble>({bytes.first(Preamble::size), 0, "preamble"}, limits, lines));
    std::vector<Chunk> chunks = file.chunks();
    chunks.push_back(file.index_chunk());
    chunks.push_back(file.tail_chunk());
    for (const Chunk& chunk : chunks) {
        const auto part = [&](std::uint64_t begin, std::uint64_t end) {
            const std::size_t size = static_cast<std::size_t>(end - begin);
            return Source{bytes.subspan(static_cast<std::size_t>(begin), size), begin, name_of(chunk.type)};
        };
        MESHREEL_CHECK(explain_fields<ChunkHead>(part(chunk.begin, chunk.offset), limits, lines));
        MESHREEL_CHECK(explain_payload(file, chunk, payloads, lines));
        MESHREEL_CHECK(explain_fields<ChunkEnd>(part(chunk.end() - 4, chunk.end()), limits, lines));
    }
    return lines;
}

} // namespace meshreel::container
