/// The format is written once: a chunk's struct lists its fields, and reader, writer, explanation and table follow.
// SPDX-License-Identifier: MIT
//
//     struct SegmentHeader {
//         std::uint32_t bases = 0;
//         double step = 0.0;
//         Entropy entropy = Entropy::range;          // enumerators 0, 1, ... in the order of their names below
//         std::vector<float> mean;
//         ByteView residuals;                        // a view into the file when read: nothing is copied
//
//         void fields(auto& io)
//         {
//             io.varint("bases", bases, {1, 3'000'000}, "K, the number of eigentrajectories");
//             io.f64("step", step, positive, "quantisation step, model units");
//             io.choice("entropy", entropy, {"huffman", "range"}, "coder of the residuals");
//             io.when(bases > 1, "bases > 1", [&] { io.f32s("mean", mean, bases, "mean trajectory"); });
//             io.rest("residuals", residuals, "residuals, see ...");
//         }
//     };
//     Result<Bytes> payload = write_fields(header);
//     Result<SegmentHeader> back = read_fields<SegmentHeader>({payload, offset_in_file, "SEGM"}, limits);
//
// All numbers are little-endian. A Reader never trusts: each value is checked against its range and the limits, each
// count against the bytes that are left and the memory allowed, before anything is allocated. The first error sticks:
// it names byte and field, everything read after it is zero or empty, and no list goes on.
#pragma once

#include <algorithm>
#include <initializer_list>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "meshreel/base/limits.h"
#include "meshreel/base/result.h"
#include "meshreel/base/views.h"
#include "meshreel/container/field.h"

namespace meshreel::container {

/// What `void fields(auto& io)` may call. Each direction (Io) supplies integer, real, bytes, list_count, enter, leave,
/// begin_when, end_when, fail; `Io::reads` says whether values are to be replaced by what was read.
template <class Io>
class FieldIo {
public:
    void u8(std::string_view name, std::uint8_t& value, Range range, std::string_view meaning)
    {
        number({name, Encoding::u8, meaning, range}, value);
    }
    void u16(std::string_view name, std::uint16_t& value, Range range, std::string_view meaning)
    {
        number({name, Encoding::u16, meaning, range}, value);
    }
    void u32(std::string_view name, std::uint32_t& value, Range range, std::string_view meaning)
    {
        number({name, Encoding::u32, meaning, range}, value);
    }
    void u64(std::string_view name, std::uint64_t& value, Range range, std::string_view meaning)
    {
        number({name, Encoding::u64, meaning, range}, value);
    }
    /// Any unsigned type; its largest value bounds the range too.
    template <class Unsigned>
    void varint(std::string_view name, Unsigned& value, Range range, std::string_view meaning)
    {
        static_assert(std::is_unsigned_v<Unsigned>);
        range.high = std::min<std::uint64_t>(range.high, std::numeric_limits<Unsigned>::max());
        number({name, Encoding::varint, meaning, range}, value);
    }
    template <class Signed>
    void signed_varint(std::string_view name, Signed& value, SignedRange range, std::string_view meaning)
    {
        static_assert(std::is_signed_v<Signed>);
        range.low = std::max<std::int64_t>(range.low, std::numeric_limits<Signed>::min());
        range.high = std::min<std::int64_t>(range.high, std::numeric_limits<Signed>::max());
        const std::uint64_t stored = self().integer({name, Encoding::zigzag, meaning, {}, {}, range}, zigzag(value));
        if constexpr (Io::reads) value = static_cast<Signed>(unzigzag(stored));
    }
    void f32(std::string_view name, float& value, RealRange range, std::string_view meaning)
    {
        const double stored = self().real({name, Encoding::f32, meaning, {}, range}, static_cast<double>(value));
        if constexpr (Io::reads) value = static_cast<float>(stored);
    }
    void f64(std::string_view name, double& value, RealRange range, std::string_view meaning)
    {
        const double stored = self().real({name, Encoding::f64, meaning, {}, range}, value);
        if constexpr (Io::reads) value = stored;
    }
    /// One byte, 0 or 1.
    void flag(std::string_view name, bool& value, std::string_view meaning)
    {
        static constexpr std::string_view names[] = {"no", "yes"};
        const std::uint64_t stored = self().integer({name, Encoding::u8, meaning, {0, 1}, {}, {}, names}, value);
        if constexpr (Io::reads) value = stored != 0;
    }
    /// One byte; the enumerators count from 0 in the order of `names`.
    template <class Enum>
    void choice(std::string_view name, Enum& value, std::span<const std::string_view> names, std::string_view meaning)
    {
        const Range range{0, names.size() - 1};
        const std::uint64_t stored =
            self().integer({name, Encoding::u8, meaning, range, {}, {}, names}, static_cast<std::uint64_t>(value));
        if constexpr (Io::reads) value = static_cast<Enum>(stored);
    }
    template <class Enum>
    void choice(std::string_view name, Enum& value, std::initializer_list<std::string_view> names,
                std::string_view meaning)
    {
        choice(name, value, std::span(names.begin(), names.size()), meaning);
    }
    void tag(std::string_view name, Tag& value, std::string_view meaning)
    {
        number({name, Encoding::tag, meaning}, value);
    }
    void text(std::string_view name, std::string& value, std::uint64_t longest, std::string_view meaning)
    {
        const ByteView now{reinterpret_cast<const std::uint8_t*>(value.data()), value.size()};
        const ByteView stored = self().bytes({name, Encoding::text, meaning, {0, longest}}, now);
        if constexpr (Io::reads) value.assign(stored.begin(), stored.end());
    }
    /// `length`: bounds of the byte count.
    void blob(std::string_view name, ByteView& value, Range length, std::string_view meaning)
    {
        const ByteView stored = self().bytes({name, Encoding::bytes, meaning, length}, value);
        if constexpr (Io::reads) value = stored;
    }
    void blob(std::string_view name, Bytes& value, Range length, std::string_view meaning)
    {
        const ByteView stored = self().bytes({name, Encoding::bytes, meaning, length}, value);
        if constexpr (Io::reads) value.assign(stored.begin(), stored.end());
    }
    /// Everything up to the end of the chunk; so it must be the last field.
    void rest(std::string_view name, ByteView& value, std::string_view meaning)
    {
        const ByteView stored = self().bytes({name, Encoding::rest, meaning}, value);
        if constexpr (Io::reads) value = stored;
    }
    void rest(std::string_view name, Bytes& value, std::string_view meaning)
    {
        const ByteView stored = self().bytes({name, Encoding::rest, meaning}, value);
        if constexpr (Io::reads) value.assign(stored.begin(), stored.end());
    }
    /// Bytes that are the same in every file.
    void constant(std::string_view name, ByteView value, std::string_view meaning)
    {
        self().bytes({name, Encoding::constant, meaning, {value.size(), value.size()}}, value);
    }
    /// An array whose length earlier fields give; when written, `values` must hold that many.
    void f32s(std::string_view name, std::vector<float>& values, Times times, std::string_view meaning)
    {
        reals({.name = name, .encoding = Encoding::f32, .meaning = meaning, .times = times.text}, values, times.count);
    }
    void f64s(std::string_view name, std::vector<double>& values, Times times, std::string_view meaning)
    {
        reals({.name = name, .encoding = Encoding::f64, .meaning = meaning, .times = times.text}, values, times.count);
    }
    /// A count, then that many items, each with fields of its own.
    template <class Item>
    void list(std::string_view name, std::vector<Item>& items, Range counts, std::string_view meaning)
    {
        const std::uint64_t count =
            self().list_count({name, Encoding::count, meaning, counts}, items.size(), sizeof(Item));
        if constexpr (Io::reads) items.resize(count);
        for (std::uint64_t i = 0; i < count && !self().failed(); ++i) {
            self().enter(name, i);
            items[i].fields(self());
            self().leave();
        }
    }
    /// A count, then that many texts.
    void texts(std::string_view name, std::vector<std::string>& items, std::uint64_t longest, std::string_view meaning)
    {
        const std::uint64_t count =
            self().list_count({name, Encoding::count, meaning, {}}, items.size(), sizeof(std::string));
        if constexpr (Io::reads) items.resize(count);
        for (std::uint64_t i = 0; i < count && !self().failed(); ++i) {
            self().enter(name, i);
            text("text", items[i], longest, meaning);
            self().leave();
        }
    }
    /// A struct within a struct.
    template <class Part>
    void part(std::string_view name, Part& value)
    {
        self().enter(name);
        value.fields(self());
        self().leave();
    }
    /// Fields that are there only if earlier ones say so; `text` is the condition in words.
    template <class Body>
    void when(bool condition, std::string_view text, const Body& body)
    {
        if (!self().begin_when(condition, text)) return;
        body();
        self().end_when();
    }
    /// A rule between fields; `rule` completes the sentence "it must be that ...".
    void must(bool holds, std::string_view name, std::string_view rule) { self().rule(holds, name, rule); }

private:
    Io& self() { return static_cast<Io&>(*this); }

    template <class Unsigned>
    void number(const Field& field, Unsigned& value)
    {
        const std::uint64_t stored = self().integer(field, value);
        if constexpr (Io::reads) value = static_cast<Unsigned>(stored);
    }
    template <class Real>
    void reals(const Field& field, std::vector<Real>& values, std::uint64_t count)
    {
        if constexpr (Io::reads) {
            const ByteView stored = self().array(field, {}, count);
            values.resize(stored.size() / sizeof(Real));
            for (std::size_t i = 0; i < values.size(); ++i)
                values[i] = load_real<Real>(stored.data() + i * sizeof(Real));
        } else {
            Bytes stored(values.size() * sizeof(Real));
            for (std::size_t i = 0; i < values.size(); ++i) store_real(values[i], stored.data() + i * sizeof(Real));
            self().array(field, stored, count);
        }
    }
};

/// Builds the bytes of a payload. A value that the Reader would refuse is an error here already.
class Writer : public FieldIo<Writer> {
public:
    static constexpr bool reads = false;

    /// The bytes so far. @fails usage: a value is outside its range, named.
    Result<Bytes> finish() &&;
    bool failed() const { return error_.has_value(); }

    std::uint64_t integer(const Field& field, std::uint64_t value);
    double real(const Field& field, double value);
    ByteView bytes(const Field& field, ByteView value);
    ByteView array(const Field& field, ByteView value, std::uint64_t count);
    std::uint64_t list_count(const Field& field, std::uint64_t count, std::size_t item_size);
    void enter(std::string_view, std::uint64_t = 0) {}
    void leave() {}
    bool begin_when(bool condition, std::string_view) { return condition; }
    void end_when() {}
    void rule(bool holds, std::string_view name, std::string_view rule);
    void fail(std::string_view name, Sentence message);

private:
    Bytes bytes_;
    std::optional<Error> error_;
};

/// Where a payload stands in its file.
struct Source {
    ByteView bytes;
    std::uint64_t offset = 0; ///< of bytes[0] in the file
    std::string name;         ///< of the chunk: the first part of a field's name in an error
};

/// Takes a payload apart, trusting nothing.
class Reader : public FieldIo<Reader> {
public:
    static constexpr bool reads = true;

    /// The bytes must outlive the Reader and whatever views it hands out.
    Reader(Source source, const DecodeLimits& limits) : source_(std::move(source)), limits_(limits) {}

    /// All fields were read: is all well, and nothing left over? @fails bad_input, with byte and field.
    Status finish();
    bool failed() const { return failure_.happened(); }
    const Failure& failure() const { return failure_; }
    std::uint64_t offset() const { return source_.offset + at_; } ///< in the file
    std::uint64_t left() const { return failed() ? 0 : source_.bytes.size() - at_; }
    const DecodeLimits& limits() const { return limits_; }

    std::uint64_t integer(const Field& field, std::uint64_t ignored);
    double real(const Field& field, double ignored);
    ByteView bytes(const Field& field, ByteView expected);
    ByteView array(const Field& field, ByteView ignored, std::uint64_t count);
    std::uint64_t list_count(const Field& field, std::uint64_t ignored, std::size_t item_size);
    void enter(std::string_view name, std::uint64_t index = no_index);
    void leave() { path_.pop_back(); }
    bool begin_when(bool condition, std::string_view) { return condition && !failed(); }
    void end_when() {}
    void rule(bool holds, std::string_view name, std::string_view rule);
    /// Records the first error; `begin` is where its field began, in the file.
    void fail(std::string_view name, const Sentence& message, std::uint64_t begin);
    /// "SEGM.parts[2].step"
    std::string full_name(std::string_view name) const;

    static constexpr std::uint64_t no_index = any.high;

private:
    struct Step {
        std::string_view name;
        std::uint64_t index;
    };
    const std::uint8_t* take(const Field& field, std::uint64_t size);
    std::uint64_t take_varint(const Field& field);
    bool allowed(const Field& field, std::uint64_t value, std::uint64_t begin);
    bool allowed_sign(const Field& field, std::uint64_t value, std::uint64_t begin);

    Source source_;
    DecodeLimits limits_;
    std::uint64_t at_ = 0;
    std::vector<Step> path_;
    Failure failure_; ///< the first
};

/// A struct's bytes. @fails usage: a field is outside its range.
template <class Struct>
Result<Bytes> write_fields(const Struct& value)
{
    Writer writer;
    const_cast<Struct&>(value).fields(writer); // a Writer changes nothing
    return std::move(writer).finish();
}

/// A struct from bytes that hold it and nothing else. @fails bad_input, with byte and field.
template <class Struct>
Result<Struct> read_fields(Source source, const DecodeLimits& limits)
{
    Reader reader(std::move(source), limits);
    Struct value;
    value.fields(reader);
    MESHREEL_CHECK(reader.finish());
    return value;
}

} // namespace meshreel::container
