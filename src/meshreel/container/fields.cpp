/// Writing and reading single fields, with every check.
// SPDX-License-Identifier: MIT
#include "meshreel/container/fields.h"

#include <cmath>

#include "meshreel/base/text.h"

namespace meshreel::container {

namespace {

std::size_t fixed_size(Encoding encoding)
{
    switch (encoding) {
    case Encoding::u8:
        return 1;
    case Encoding::u16:
        return 2;
    case Encoding::u32:
    case Encoding::f32:
    case Encoding::tag:
        return 4;
    case Encoding::u64:
    case Encoding::f64:
        return 8;
    default:
        return 0;
    }
}

void put(Bytes& bytes, std::uint64_t value, std::size_t size)
{
    for (std::size_t i = 0; i < size; ++i) bytes.push_back(static_cast<std::uint8_t>(value >> (8 * i)));
}

void put_varint(Bytes& bytes, std::uint64_t value)
{
    for (; value >= 0x80; value >>= 7) bytes.push_back(static_cast<std::uint8_t>(value | 0x80));
    bytes.push_back(static_cast<std::uint8_t>(value));
}

std::uint64_t most(const DecodeLimits& limits, Limit limit)
{
    switch (limit) {
    case Limit::vertices:
        return limits.max_vertices;
    case Limit::triangles:
        return limits.max_triangles;
    case Limit::frames:
        return limits.max_frames;
    case Limit::memory:
        return limits.max_memory;
    default:
        return any.high;
    }
}

/// What is wrong with an integer, or nothing.
Sentence complaint(const Field& field, std::uint64_t value)
{
    if (field.encoding == Encoding::zigzag) {
        const std::int64_t n = unzigzag(value);
        if (n >= field.whole.low && n <= field.whole.high) return {};
        return concat(n, " is not in ", field.whole.low, " .. ", field.whole.high);
    }
    if (value >= field.range.low && value <= field.range.high) return {};
    if (field.range.high == any.high) return concat(value, " is below ", field.range.low);
    return concat(value, " is not in ", field.range.low, " .. ", field.range.high);
}

Sentence complaint(const Field& field, double value)
{
    if (!std::isfinite(value)) return std::isnan(value) ? "not a number" : "infinite";
    if (value >= field.real.low && value <= field.real.high) return {};
    return concat(value, value < field.real.low ? " is below what is allowed" : " is above what is allowed");
}

double real_at(const std::uint8_t* bytes, Encoding encoding)
{
    return encoding == Encoding::f32 ? static_cast<double>(load_real<float>(bytes)) : load_real<double>(bytes);
}

bool has_length(Encoding encoding)
{
    return encoding == Encoding::text || encoding == Encoding::bytes;
}

} // namespace

std::string name_of(Tag tag)
{
    std::string name;
    for (int shift = 0; shift < 32; shift += 8) {
        const char letter = static_cast<char>(tag >> shift);
        name += (letter >= 'A' && letter <= 'Z') || (letter >= 'a' && letter <= 'z') ? letter : '?';
    }
    return name;
}

// ---- Writer

Result<Bytes> Writer::finish() &&
{
    if (error_) return *std::move(error_);
    return std::move(bytes_);
}

void Writer::fail(std::string_view name, Sentence message)
{
    if (!error_) error_ = Error{ErrorCode::usage, std::move(message), std::string(name), {}, {}};
}

void Writer::rule(bool holds, std::string_view name, std::string_view rule)
{
    if (!holds) fail(name, concat("it must be that ", rule));
}

std::uint64_t Writer::integer(const Field& field, std::uint64_t value)
{
    if (Sentence wrong = complaint(field, value); !wrong.empty()) fail(field.name, std::move(wrong));
    if (const std::size_t size = fixed_size(field.encoding); size != 0)
        put(bytes_, value, size);
    else
        put_varint(bytes_, value);
    return value;
}

double Writer::real(const Field& field, double value)
{
    if (Sentence wrong = complaint(field, value); !wrong.empty()) fail(field.name, std::move(wrong));
    const std::size_t size = fixed_size(field.encoding);
    bytes_.resize(bytes_.size() + size);
    std::uint8_t* end = bytes_.data() + bytes_.size();
    if (field.encoding == Encoding::f32)
        store_real(static_cast<float>(value), end - size);
    else
        store_real(value, end - size);
    return value;
}

ByteView Writer::bytes(const Field& field, ByteView value)
{
    if (Sentence wrong = complaint(field, std::uint64_t{value.size()}); !wrong.empty())
        fail(field.name, concat("its length ", wrong));
    if (has_length(field.encoding)) put_varint(bytes_, value.size());
    bytes_.insert(bytes_.end(), value.begin(), value.end());
    return value;
}

ByteView Writer::array(const Field& field, ByteView value, std::uint64_t count)
{
    const std::size_t size = fixed_size(field.encoding);
    if (value.size() / size != count) fail(field.name, concat(value.size() / size, " items, not ", count));
    for (std::size_t i = 0; i < value.size(); i += size)
        if (!std::isfinite(real_at(value.data() + i, field.encoding)))
            fail(field.name, concat("item ", i / size, " is not finite"));
    bytes_.insert(bytes_.end(), value.begin(), value.end());
    return value;
}

std::uint64_t Writer::list_count(const Field& field, std::uint64_t count, std::size_t /*item_size*/)
{
    return integer(field, count);
}

// ---- Reader

void Reader::fail(std::string_view name, const Sentence& message, std::uint64_t begin)
{
    if (!failed()) failure_ = bad_input(message, full_name(name), at_byte(begin));
}

std::string Reader::full_name(std::string_view name) const
{
    std::string all = source_.name;
    for (const Step& step : path_) {
        all += joined(".", step.name);
        if (step.index != no_index) all += joined("[", step.index, "]");
    }
    return joined(all, all.empty() || name.empty() ? "" : ".", name);
}

void Reader::enter(std::string_view name, std::uint64_t index)
{
    path_.push_back({name, index});
}

Status Reader::finish()
{
    if (left() != 0) fail("", concat(left(), " bytes are left over after its last field"), offset());
    if (failed()) return failure_;
    return Ok{};
}

void Reader::rule(bool holds, std::string_view name, std::string_view rule)
{
    if (!holds && !failed()) fail(name, concat("it must be that ", rule), offset());
}

const std::uint8_t* Reader::take(const Field& field, std::uint64_t size)
{
    if (failed()) return nullptr;
    if (size > left()) {
        fail(field.name, concat("the data end after ", left(), " of its ", size, " bytes"), offset());
        return nullptr;
    }
    const std::uint8_t* here = source_.bytes.data() + at_;
    at_ += size;
    return here;
}

std::uint64_t Reader::take_varint(const Field& field)
{
    const std::uint64_t begin = offset();
    std::uint64_t value = 0;
    for (unsigned shift = 0; shift < 64; shift += 7) {
        const std::uint8_t* byte = take(field, 1);
        if (byte == nullptr) return 0;
        const std::uint64_t bits = *byte & 0x7fu;
        if (shift == 63 && bits > 1) break;
        value |= bits << shift;
        if (*byte < 0x80) {
            if (shift != 0 && bits == 0) fail(field.name, "a number in more bytes than it needs", begin);
            return failed() ? 0 : value;
        }
    }
    fail(field.name, "a number of more than 64 bits", begin);
    return 0;
}

bool Reader::allowed(const Field& field, std::uint64_t value, std::uint64_t begin)
{
    if (failed()) return false;
    Sentence wrong = complaint(field, value);
    const std::uint64_t limit = most(limits_, field.range.limit);
    if (wrong.empty() && value > limit) wrong = concat(value, " is above the limit of ", limit);
    if (!wrong.empty()) fail(field.name, wrong, begin);
    return !failed();
}

std::uint64_t Reader::integer(const Field& field, std::uint64_t /*ignored*/)
{
    const std::uint64_t begin = offset();
    std::uint64_t value = 0;
    if (const std::size_t size = fixed_size(field.encoding); size == 0)
        value = take_varint(field);
    else if (const std::uint8_t* here = take(field, size))
        for (std::size_t i = 0; i < size; ++i) value |= static_cast<std::uint64_t>(here[i]) << (8 * i);
    return allowed(field, value, begin) ? value : 0;
}

double Reader::real(const Field& field, double /*ignored*/)
{
    const std::uint64_t begin = offset();
    const std::uint8_t* here = take(field, fixed_size(field.encoding));
    if (here == nullptr) return 0.0;
    const double value = real_at(here, field.encoding);
    if (Sentence wrong = complaint(field, value); !wrong.empty()) fail(field.name, wrong, begin);
    return failed() ? 0.0 : value;
}

ByteView Reader::bytes(const Field& field, ByteView expected)
{
    const std::uint64_t begin = offset();
    std::uint64_t size = field.encoding == Encoding::constant ? expected.size() : left();
    if (has_length(field.encoding)) size = take_varint(field);
    if (!allowed(field, size, begin)) return {};
    const std::uint8_t* here = take(field, size);
    if (here == nullptr) return {};
    const ByteView found{here, static_cast<std::size_t>(size)};
    if (field.encoding == Encoding::constant && std::memcmp(here, expected.data(), expected.size()) != 0) {
        fail(field.name, "not the bytes that every file has here", begin);
        return {};
    }
    return found;
}

ByteView Reader::array(const Field& field, ByteView /*ignored*/, std::uint64_t count)
{
    const std::size_t size = fixed_size(field.encoding);
    if (failed()) return {};
    if (count > left() / size) {
        fail(field.name, concat(count, " items do not fit in the ", left(), " bytes that are left"), offset());
        return {};
    }
    const std::uint64_t begin = offset();
    const std::uint8_t* here = take(field, count * size);
    for (std::uint64_t i = 0; i < count; ++i)
        if (!std::isfinite(real_at(here + i * size, field.encoding)))
            fail(field.name, concat("item ", i, " is not finite"), begin + i * size);
    return failed() ? ByteView{} : ByteView{here, static_cast<std::size_t>(count * size)};
}

std::uint64_t Reader::list_count(const Field& field, std::uint64_t ignored, std::size_t item_size)
{
    const std::uint64_t begin = offset();
    const std::uint64_t count = integer(field, ignored);
    if (failed()) return 0;
    if (count > left()) // an item takes a byte at least
        fail(field.name, concat(count, " items do not fit in the ", left(), " bytes that are left"), begin);
    else if (count > limits_.max_memory / item_size)
        fail(field.name, concat(count, " items do not fit in the memory limit of ", limits_.max_memory, " bytes"),
             begin);
    return failed() ? 0 : count;
}

} // namespace meshreel::container
