/// A file in memory that counts what is fetched of it.
// SPDX-License-Identifier: MIT
#pragma once

#include "meshreel/base/file.h"

namespace meshreel {

class CountedSource : public MemorySource {
public:
    using MemorySource::MemorySource;
    Result<Bytes> fetch(std::uint64_t offset, std::size_t count) override
    {
        fetched += count;
        return MemorySource::fetch(offset, count);
    }
    std::uint64_t fetched = 0;
};

} // namespace meshreel
