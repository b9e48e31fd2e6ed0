/// zstd's outer layers: a frame of blocks, a block of literals and sequences.
// SPDX-License-Identifier: MIT
#include "unzstd.h"

#include "zstd_tables.h"

namespace meshreel::wasm {

namespace {

constexpr std::size_t largest_block = 128u << 10;

/// One stream of literals, which must be used up to its first bit.
bool read_literals(const Huffman& table, ByteView stream, std::span<std::uint8_t> out)
{
    auto bits = BackBits::open(stream);
    if (!bits) return false;
    const std::uint32_t mask = (1u << table.log) - 1;
    std::uint32_t state = bits->read(table.log);
    for (std::uint8_t& literal : out) {
        const Huffman::Cell cell = table.cells[state];
        literal = cell.symbol;
        state = ((state << cell.bits) + bits->read(cell.bits)) & mask;
    }
    return bits->at == -static_cast<std::int64_t>(table.log);
}

/// Extra bits of the codes of lengths, and from them the first length of each code.
constexpr std::array<std::uint8_t, 36> literal_extra{0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0,  0,  0,  0,  0,  1,  1,
                                                     1, 1, 2, 2, 3, 3, 4, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16};
constexpr std::array<std::uint8_t, 53> match_extra{0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0,  0,  0,  0,  0,  0,  0, 0,
                                                   0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0,  0,  0,  0,  1,  1,  1, 1,
                                                   2, 2, 3, 3, 4, 4, 5, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16};
constexpr std::array<std::int16_t, 36> literal_shares{4, 3, 2, 2, 2, 2, 2, 2, 2, 2, 2, 2, 2, 1, 1,  1,  2,  2,
                                                      2, 2, 2, 2, 2, 2, 2, 3, 2, 1, 1, 1, 1, 1, -1, -1, -1, -1};
constexpr std::array<std::int16_t, 53> match_shares{1, 4, 3, 2, 2, 2, 2, 2, 2, 1, 1,  1,  1,  1,  1,  1,  1, 1,
                                                    1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1,  1,  1,  1,  1,  1,  1, 1,
                                                    1, 1, 1, 1, 1, 1, 1, 1, 1, 1, -1, -1, -1, -1, -1, -1, -1};
constexpr std::array<std::int16_t, 29> offset_shares{1, 1, 1, 1, 1, 1, 2, 2, 2, 1,  1,  1,  1,  1, 1,
                                                     1, 1, 1, 1, 1, 1, 1, 1, 1, -1, -1, -1, -1, -1};

/// A length: the first that its code means, and so many more.
std::uint32_t read_length(std::span<const std::uint8_t> extra, std::uint32_t code, BackBits& bits)
{
    std::uint32_t first = 0;
    for (std::uint32_t c = 0; c < code; ++c) first += 1u << extra[c];
    return first + bits.read(extra[code]);
}

/// One kind of code of sequences.
struct CodeKind {
    std::uint32_t default_log;
    std::span<const std::int16_t> default_shares;
    FseBounds bounds;
};
constexpr std::array<CodeKind, 3> code_kinds{{{6, literal_shares, {9, 36}},
                                              {5, offset_shares, {8, 32}},
                                              {6, match_shares, {9, 53}}}}; // in the order of their descriptions

/// What goes on from block to block, and what has come out.
class Unpacker {
public:
    explicit Unpacker(std::span<std::uint8_t> out) : out_(out), literals_(largest_block) {}

    bool full() const { return written_ == out_.size(); }

    bool copy(ByteView bytes)
    {
        if (bytes.size() > out_.size() - written_) return false;
        std::copy(bytes.begin(), bytes.end(), out_.begin() + static_cast<std::ptrdiff_t>(written_));
        written_ += bytes.size();
        return true;
    }

    bool repeat(std::uint8_t byte, std::size_t count)
    {
        if (count > out_.size() - written_) return false;
        std::fill_n(out_.data() + written_, count, byte);
        written_ += count;
        return true;
    }

    bool block(ByteView bytes)
    {
        Front front{bytes};
        return take_literals(front) && take_sequences(front) && copy(left_);
    }

private:
    bool take_literals(Front& front)
    {
        if (front.left.empty()) return false;
        const std::uint32_t kind = front.left[0] & 3u, format = front.left[0] >> 2 & 3u;
        if (kind >= 2) return take_packed_literals(front, kind, format);
        const std::size_t head = format == 1 ? 2 : format == 3 ? 3 : 1;
        const auto size = static_cast<std::size_t>(front.number(head) >> (head == 1 ? 3 : 4));
        if (front.failed || size > largest_block) return false;
        const ByteView bytes = front.take(kind == 0 ? size : 1);
        if (front.failed) return false;
        if (kind == 0)
            std::copy(bytes.begin(), bytes.end(), literals_.begin());
        else
            std::fill_n(literals_.begin(), size, bytes[0]);
        left_ = ByteView(literals_).first(size);
        return true;
    }

    bool take_packed_literals(Front& front, std::uint32_t kind, std::uint32_t format)
    {
        const std::uint32_t width = format == 3 ? 18 : format == 2 ? 14 : 10;
        const std::uint64_t head = front.number(format < 2 ? 3 : format + 2) >> 4, mask = (1u << width) - 1;
        const auto size = static_cast<std::size_t>(head & mask);
        Front packed{front.take(head >> width & mask)};
        if (front.failed || size > largest_block) return false;
        if (kind == 2) huffman_ = read_huffman(packed);
        if (huffman_.cells.empty() || packed.failed) return false;
        left_ = ByteView(literals_).first(size);
        const std::span<std::uint8_t> out = std::span(literals_).first(size);
        return format == 0 ? read_literals(huffman_, packed.left, out) : take_four_streams(packed, out);
    }

    bool take_four_streams(Front& packed, std::span<std::uint8_t> out)
    {
        const ByteView sizes = packed.take(6);
        const std::size_t quarter = (out.size() + 3) / 4;
        if (packed.failed || 3 * quarter > out.size()) return false;
        for (std::size_t s = 0; s < 4; ++s) {
            const ByteView stream = s < 3 ? packed.take(little(sizes.data() + 2 * s, 2)) : packed.left;
            const std::span<std::uint8_t> part = s < 3 ? out.subspan(s * quarter, quarter) : out.subspan(3 * quarter);
            if (packed.failed || !read_literals(huffman_, stream, part)) return false;
        }
        return true;
    }

    static std::uint32_t sequence_count(Front& front)
    {
        const auto first = static_cast<std::uint32_t>(front.number(1));
        if (first < 128) return first;
        if (first < 255) return ((first - 128) << 8) + static_cast<std::uint32_t>(front.number(1));
        return static_cast<std::uint32_t>(front.number(2)) + 0x7f00;
    }

    bool take_sequences(Front& front)
    {
        const std::uint32_t count = sequence_count(front);
        if (front.failed || count == 0) return !front.failed && front.left.empty();
        const auto modes = static_cast<std::uint32_t>(front.number(1));
        for (std::size_t i = 0; i < 3; ++i)
            if (!take_table(front, i, modes >> (6 - 2 * i) & 3)) return false;
        auto bits = BackBits::open(front.left);
        if (front.failed || (modes & 3) != 0 || !bits) return false;
        std::array<std::uint32_t, 3> states{};
        for (std::size_t i = 0; i < 3; ++i) states[i] = tables_[i].start(*bits);
        for (std::uint32_t n = count; n > 0; --n) {
            if (!take_sequence(states, *bits)) return false;
            if (n > 1) // lengths first, then the offset
                for (const std::size_t i : {0, 2, 1}) states[i] = tables_[i].next(states[i], *bits);
        }
        return bits->at == 0;
    }

    bool take_table(Front& front, std::size_t i, std::uint32_t mode)
    {
        const CodeKind& kind = code_kinds[i];
        if (mode == 0) tables_[i] = fse_of(kind.default_log, kind.default_shares);
        if (mode == 1) {
            const auto symbol = static_cast<std::uint8_t>(front.number(1));
            if (symbol >= kind.bounds.symbols) return false;
            tables_[i] = one_symbol(symbol);
        }
        if (mode == 2) tables_[i] = read_fse(front, kind.bounds);
        return !tables_[i].cells.empty() && !front.failed;
    }

    /// So many literals, then a match of what has come out already.
    bool take_sequence(const std::array<std::uint32_t, 3>& states, BackBits& bits)
    {
        const auto code = [&](std::size_t i) { return tables_[i].cells[states[i]].symbol; };
        const std::uint64_t offset_value = (std::uint64_t{1} << code(1)) + bits.read(code(1));
        const std::uint32_t match = 3 + read_length(match_extra, code(2), bits);
        const std::uint32_t literals = read_length(literal_extra, code(0), bits);
        if (bits.at < 0 || literals > left_.size() || !copy(left_.first(literals))) return false;
        left_ = left_.subspan(literals);
        const std::uint64_t offset = offset_of(offset_value, literals == 0);
        if (offset == 0 || offset > written_ || match > out_.size() - written_) return false;
        std::uint8_t* to = out_.data() + written_;
        const std::uint8_t* from = to - offset;
        for (std::uint32_t i = 0; i < match; ++i) to[i] = from[i]; // they may overlap
        written_ += match;
        return true;
    }

    /// The first three values mean offsets used of late.
    std::uint64_t offset_of(std::uint64_t value, bool no_literals)
    {
        const std::uint64_t place = value > 3 ? 3 : value - (no_literals ? 0 : 1);
        if (place == 0) return late_[0];
        const std::uint64_t offset = value > 3 ? value - 3 : place < 3 ? late_[place] : late_[0] - 1;
        if (place > 1) late_[2] = late_[1];
        late_[1] = late_[0];
        return late_[0] = offset;
    }

    std::span<std::uint8_t> out_;
    std::size_t written_ = 0;
    std::vector<std::uint8_t> literals_;
    ByteView left_; ///< literals of this block not used yet
    Huffman huffman_;
    std::array<Fse, 3> tables_; ///< of literal lengths, offsets, match lengths
    std::array<std::uint64_t, 3> late_{1, 4, 8};
};

struct Block {
    bool last;
    std::uint32_t kind; ///< 0 as they are, 1 one byte again and again, 2 packed
    std::size_t size;   ///< of the first two kinds: unpacked

    static Block of(std::uint64_t head)
    {
        return {(head & 1) != 0, static_cast<std::uint32_t>(head >> 1 & 3), static_cast<std::size_t>(head >> 3)};
    }
    std::size_t stored() const { return kind == 1 ? 1 : size; }
};

/// The frame's head: all but compressed_size. checksum: whether one follows.
std::optional<ZstdFrame> read_head(Front& front, bool& checksum)
{
    const std::size_t all = front.left.size();
    if (front.number(4) != 0xfd2fb528) return {};
    const auto says = static_cast<std::uint32_t>(front.number(1));
    const bool single = (says & 0x20) != 0;
    constexpr std::array<std::size_t, 4> sizes{0, 2, 4, 8};
    if (!single) front.take(1);
    if ((says & 0x0b) != 0) return {}; // a dictionary, or a bit of the future
    checksum = (says & 4) != 0;
    const std::uint32_t width = says >> 6;
    ZstdFrame frame;
    if (width > 0 || single) frame.content_size = front.number(width == 0 ? 1 : sizes[width]) + (width == 1 ? 256 : 0);
    frame.head_size = all - front.left.size();
    if (front.failed) return {};
    return frame;
}

} // namespace

std::optional<ZstdFrame> look_at_zstd(ByteView bytes)
{
    Front front{bytes};
    bool checksum = false;
    std::optional<ZstdFrame> frame = read_head(front, checksum);
    if (!frame) return {};
    for (bool last = false; !last;) {
        const Block block = Block::of(front.number(3));
        front.take(block.stored());
        if (front.failed || block.kind == 3 || block.size > largest_block) return {};
        last = block.last;
    }
    front.take(checksum ? 4 : 0);
    if (front.failed) return {};
    frame->compressed_size = bytes.size() - front.left.size();
    return frame;
}

bool unpack_zstd(ByteView bytes, std::span<std::uint8_t> out)
{
    const auto frame = look_at_zstd(bytes);
    if (!frame) return false;
    Front front{bytes.subspan(static_cast<std::size_t>(frame->head_size))};
    Unpacker unpacker(out);
    for (bool last = false; !last;) {
        const Block block = Block::of(front.number(3));
        const ByteView stored = front.take(block.stored());
        const bool fine = block.kind == 0   ? unpacker.copy(stored)
                          : block.kind == 1 ? unpacker.repeat(stored[0], block.size)
                                            : unpacker.block(stored);
        if (!fine) return false;
        last = block.last;
    }
    return unpacker.full();
}

} // namespace meshreel::wasm
