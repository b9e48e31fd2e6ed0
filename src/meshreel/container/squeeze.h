/// Bytes through zstd, where it helps; back again with the size known and checked beforehand.
// SPDX-License-Identifier: MIT
#pragma once

#include "meshreel/container/fields.h"

namespace meshreel::container {

/// What unpacking may still allocate: one budget a file, so that many small promises cannot add up to a large one.
class Budget {
public:
    explicit Budget(std::uint64_t bytes) : left_(bytes) {}
    /// Takes `bytes` off. @fails bad_input: more than is left.
    Status take(std::uint64_t bytes, std::string_view field);
    /// Whether `bytes` that are given back at once would fit. @fails bad_input: they would not.
    Status lend(std::uint64_t bytes, std::string_view field) const;

private:
    std::uint64_t left_;
};

/// Bytes as they are, or as one zstd frame.
struct Squeezed {
    enum class Method : std::uint8_t { stored, zstd } method = Method::stored;
    std::uint64_t size = 0; ///< of the bytes, unpacked
    Bytes kept;             ///< written: the bytes that `data` views
    ByteView data;          ///< read: a view into the file

    void fields(auto& io)
    {
        io.choice("method", method, {"stored", "zstd"},
                  "how data stands for the bytes: itself, or one zstd frame (RFC 8878)");
        io.when(method == Method::zstd, "method = zstd", [&] {
            io.varint("size", size, up_to(Limit::memory), "bytes after unpacking; the frame must say the same");
        });
        io.blob("data", data, any, "the bytes");
    }
    Squeezed() = default;
    Squeezed(Squeezed&&) = default; // a moved vector keeps its place, so `data` stays true
    Squeezed& operator=(Squeezed&&) = default;
    Squeezed(const Squeezed&) = delete;
    Squeezed& operator=(const Squeezed&) = delete;
};

/// zstd at this level (1 .. 19), or stored where that is not smaller. Encoder side.
Squeezed squeeze(Bytes bytes, int level = 19);

/// The bytes again. `exact`: how many there must be. @fails bad_input: another size, a damaged frame, beyond the budget.
Result<Bytes> unsqueeze(const Squeezed& squeezed, std::uint64_t exact, Budget& budget);
/// The same where only the file knows how many.
Result<Bytes> unsqueeze(const Squeezed& squeezed, Budget& budget);

} // namespace meshreel::container
