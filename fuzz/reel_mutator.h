/// Changes a .reel file behind its checksums: what chunks hold and which there are; lengths, checksums and index then hold.
// SPDX-License-Identifier: MIT
//
// Included once by a target; libFuzzer finds the last function by its name. What is no .reel file yet is mutated as bytes.
#pragma once

#include <cstring>
#include <random>

#include "meshreel/container/stream.h"

extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t max_size);

namespace meshreel::fuzz {

struct Part {
    container::Tag type;
    Bytes payload;
};

/// The chunks but INDX and TAIL; none: not a whole file.
inline std::vector<Part> parts_of(ByteView bytes)
{
    std::vector<Part> parts;
    try {
        const auto file = container::StreamReader::open(bytes, {});
        if (!file.ok()) return parts;
        for (const container::Chunk& chunk : file->chunks())
            parts.push_back({chunk.type, Bytes(chunk.payload.begin(), chunk.payload.end())});
    } catch (...) { // of the target that stands for a browser, where an error is raised
    }
    return parts;
}

/// @return the size; 0: it has no room.
inline std::size_t put_together(const std::vector<Part>& parts, std::uint8_t* data, std::size_t max_size)
{
    container::MemoryWriter writer;
    for (const Part& part : parts) writer.add(part.type, part.payload);
    const Bytes file = std::move(writer).finish();
    if (file.size() > max_size) return 0;
    std::copy(file.begin(), file.end(), data);
    return file.size();
}

inline void mutate_payload(Bytes& payload)
{
    constexpr std::size_t growth = 64;
    const std::size_t size = payload.size();
    payload.resize(size + growth);
    payload.resize(LLVMFuzzerMutate(payload.data(), size, payload.size()));
}

inline void mutate_parts(std::vector<Part>& parts, std::minstd_rand& random)
{
    const std::size_t i = random() % parts.size(), j = random() % parts.size();
    const auto at = [&](std::size_t k) { return parts.begin() + static_cast<std::ptrdiff_t>(k); };
    switch (random() % 16) {
    case 0:
        std::swap(parts[i], parts[j]);
        break;
    case 1:
        parts.insert(at(j), Part(parts[i]));
        break;
    case 2:
        if (parts.size() > 1) parts.erase(at(i));
        break;
    default:
        mutate_payload(parts[i].payload);
    }
}

} // namespace meshreel::fuzz

extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t max_size,
                                               unsigned seed)
{
    std::minstd_rand random(seed);
    auto parts = meshreel::fuzz::parts_of({data, size});
    if (parts.empty() || random() % 64 == 0) return LLVMFuzzerMutate(data, size, max_size);
    meshreel::fuzz::mutate_parts(parts, random);
    const std::size_t changed = meshreel::fuzz::put_together(parts, data, max_size);
    return changed != 0 ? changed : size;
}
