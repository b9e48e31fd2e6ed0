/// Bytes that are fetched piece by piece: from a file, from memory, from a server.
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstdint>

#include "meshreel/base/result.h"
#include "meshreel/base/views.h"

namespace meshreel {

/// Something of known size that gives any part of itself.
class ByteSource {
public:
    virtual ~ByteSource() = default;
    virtual std::uint64_t size() const = 0;
    /// The bytes offset .. offset + count - 1, which must be there. @fails io.
    virtual Result<Bytes> fetch(std::uint64_t offset, std::size_t count) = 0;
};

/// Bytes in memory, which must outlive it.
class MemorySource : public ByteSource {
public:
    explicit MemorySource(ByteView bytes) : bytes_(bytes) {}

    std::uint64_t size() const override { return bytes_.size(); }
    Result<Bytes> fetch(std::uint64_t offset, std::size_t count) override
    {
        const ByteView part = bytes_.subspan(static_cast<std::size_t>(offset), count);
        return Bytes(part.begin(), part.end());
    }

private:
    ByteView bytes_;
};

} // namespace meshreel
