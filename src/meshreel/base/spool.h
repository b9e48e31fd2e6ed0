/// Bytes that grow at their end and can be read back while they do: in memory, or in a file (base/file.h).
// SPDX-License-Identifier: MIT
#pragma once

#include <utility>

#include "meshreel/base/byte_source.h"

namespace meshreel {

/// What is written now and read later.
class Spool : public ByteSource {
public:
    /// Appends. @fails io: there is no room, or no way to it.
    virtual Status write(ByteView bytes) = 0;
};

/// Bytes in memory.
class MemorySpool : public Spool {
public:
    Status write(ByteView bytes) override
    {
        bytes_.insert(bytes_.end(), bytes.begin(), bytes.end());
        return Ok{};
    }
    std::uint64_t size() const override { return bytes_.size(); }
    Result<Bytes> fetch(std::uint64_t offset, std::size_t count) override
    {
        return MemorySource(bytes_).fetch(offset, count);
    }

    Bytes take() && { return std::move(bytes_); }

private:
    Bytes bytes_;
};

} // namespace meshreel
