/// Feeds any bytes to both entropy decoders, and any symbols made of them through both coders.
// SPDX-License-Identifier: MIT
#include <cstdlib>
#include <cstring>

#include "meshreel/coding/huffman.h"
#include "meshreel/coding/range_symbols.h"

namespace {

using namespace meshreel;
using namespace meshreel::coding;

const Contexts contexts{5, {1, 2, 9, 300}};

template <class Coder>
std::vector<std::int32_t> walk(Coder& coder, ByteView bytes)
{
    std::vector<std::int32_t> found;
    for (std::size_t i = 0; i + 4 < bytes.size(); i += 5) {
        std::int32_t value = 0;
        std::memcpy(&value, bytes.data() + i + 1, sizeof value);
        const std::uint32_t alphabet = contexts.alphabets[i % 4];
        found.push_back(coder.level(bytes[i] % 5u, bytes[i] < 128 ? value % 50 : value));
        found.push_back(coder.symbol(i % 4, static_cast<std::int32_t>(static_cast<std::uint32_t>(value) % alphabet)));
        found.push_back(coder.bits(value & 0x7ff, 11));
    }
    return found;
}

template <class Writer, class Reader>
void check(ByteView bytes)
{
    if (Result<Reader> foreign = Reader::open(bytes, contexts)) walk(*foreign, bytes);
    Writer writer(contexts);
    const std::vector<std::int32_t> written = walk(writer, bytes);
    const Bytes coded = writer.finish();
    Result<Reader> reader = Reader::open(coded, contexts);
    if (!reader || walk(*reader, bytes) != written || reader->overrun()) std::abort();
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    check<RangeWriter, RangeReader>({data, size});
    check<HuffmanWriter, HuffmanReader>({data, size});
    return 0;
}
