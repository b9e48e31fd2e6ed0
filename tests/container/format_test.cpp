/// docs/format.md says what the code does, and version 1 stays as it is.
// SPDX-License-Identifier: MIT
#include "meshreel/container/explain.h"
#include "meshreel/container/table.h"

#include "tests/container/clip.h"
#include "tests/container/generated.h"

namespace meshreel::container {
namespace {

const std::string document = "docs/format.md";

std::string hex(std::uint8_t byte)
{
    constexpr char digits[] = "0123456789abcdef";
    return {digits[byte >> 4], digits[byte & 15]};
}

/// Sixteen bytes a line: offset, bytes, letters.
std::string hex_dump(const Bytes& bytes)
{
    std::string text;
    for (std::size_t line = 0; line < bytes.size(); line += 16) {
        std::string letters;
        text += hex(static_cast<std::uint8_t>(line >> 8)) + hex(static_cast<std::uint8_t>(line)) + " ";
        for (std::size_t i = line; i < line + 16; ++i) {
            text += i < bytes.size() ? " " + hex(bytes[i]) : "   ";
            if (i < bytes.size()) letters += bytes[i] >= 0x20 && bytes[i] < 0x7f ? static_cast<char>(bytes[i]) : '.';
        }
        text += "  " + letters + "\n";
    }
    return text;
}

TEST(Format, tables_of_the_specification_are_those_of_the_code)
{
    expect_section(document, "preamble", table_of<Preamble>());
    expect_section(document, "chunk head", table_of<ChunkHead>());
    expect_section(document, "chunk end", table_of<ChunkEnd>());
    expect_section(document, "HEAD", table_of<Header>());
    expect_section(document, "TIME", table_of<TimeChunk>());
    expect_section(document, "meta", table_of<MetaChunk>());
    expect_section(document, "SEGM", table_of<Segment>());
    expect_section(document, "attr", table_of<AttributeChunk>());
    expect_section(document, "names", table_of<NamesChunk>());
    expect_section(document, "aset", table_of<AssetChunk>());
    expect_section(document, "INDX", table_of<Index>());
    expect_section(document, "TAIL", table_of<Tail>());
}

TEST(Format, the_worked_example_of_the_specification_is_a_real_file)
{
    const Bytes bytes = Clip().file();
    expect_section(document, "dump", "```\n" + hex_dump(bytes) + "```\n");
    expect_section(document, "explained", "```\n" + *explain(*StreamReader::open(bytes)) + "```\n");
}

TEST(Format, a_file_of_version_1_is_written_as_ever_and_still_read)
{
    expect_file("tests/golden/container_v1.hex", hex_dump(Clip().file()));
}

} // namespace
} // namespace meshreel::container
