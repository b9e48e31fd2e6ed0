/// A file is told field by field, from its first byte to its last.
// SPDX-License-Identifier: MIT
#include "meshreel/container/explain.h"

#include <sstream>

#include <gmock/gmock.h>

#include "tests/container/clip.h"

namespace meshreel::container {
namespace {

using testing::HasSubstr;

std::string told(const Bytes& bytes, const ExplainPayload& payloads = {})
{
    const auto lines = explain(*StreamReader::open(bytes), payloads);
    return lines.ok() ? *lines : lines.error().sentence();
}

TEST(Explain, tells_every_byte_once_and_in_order)
{
    const Bytes bytes = Clip().file();
    std::istringstream lines(told(bytes));
    std::string line;
    std::getline(lines, line); // the heading
    std::uint64_t next = 0, offset = 0, size = 0;
    while (lines >> offset >> size && std::getline(lines, line)) {
        EXPECT_EQ(offset, next) << line;
        next = offset + size;
    }
    EXPECT_EQ(next, bytes.size());
}

TEST(Explain, gives_values_names_and_meanings)
{
    const std::string text = told(Clip().file());
    EXPECT_THAT(text, HasSubstr("HEAD.codec                     \"none\""));
    EXPECT_THAT(text, HasSubstr("HEAD.order                     0 (keep)"));
    EXPECT_THAT(text, HasSubstr("TIME.fps                       24 "));
    EXPECT_THAT(text, HasSubstr("meta.metres_per_unit           0.01 "));
    EXPECT_THAT(text, HasSubstr("matl.names[1].text             \"cloth\""));
    EXPECT_THAT(text, HasSubstr("CONN.payload                   2 bytes: c0 0c"));
    EXPECT_THAT(text, HasSubstr("INDX.chunks[0].type            HEAD"));
}

struct Payload {
    std::uint8_t kind = 0;
    ByteView bits;
    void fields(auto& io)
    {
        io.u8("kind", kind, any, "of the bits");
        io.rest("bits", bits, "the bits");
    }
};

TEST(Explain, asks_the_codec_about_its_own_bytes)
{
    const Bytes bytes = Clip().file();
    const std::string text = told(bytes, [](const Header& header, Tag, Source source, std::string& lines) {
        EXPECT_EQ(header.codec, "none");
        return explain_fields<Payload>(std::move(source), {}, lines);
    });
    EXPECT_THAT(text, HasSubstr("CONN.kind                      192 "));
    EXPECT_THAT(text, HasSubstr("SEGM.payload.kind              240 "));
    EXPECT_THAT(text, HasSubstr("SEGM.payload.bits              2 bytes: 0f ff"));
}

TEST(Explain, tells_only_the_beginning_of_a_long_list_and_reads_it_all)
{
    Clip clip;
    clip.appearance.materials.assign(250, "m");
    const std::string text = told(clip.file());
    EXPECT_THAT(text, HasSubstr("250 items, the first 100 told"));
    EXPECT_THAT(text, HasSubstr("matl.names[99]"));
    EXPECT_THAT(text, testing::Not(HasSubstr("matl.names[100]")));
    EXPECT_THAT(text, HasSubstr("matl.checksum"));
}

TEST(Explain, names_the_field_that_is_wrong)
{
    MemoryWriter file;
    file.add(type::head, ByteView(Bytes{1, 'x', 0}));
    file.add(type::time, ByteView{});
    file.add(type::conn, ByteView{});
    file.add(type::segm, ByteView{});
    EXPECT_EQ(told(std::move(file).finish()), "byte 23: HEAD.vertex_count: 0 is not in 1 .. 4294967295");
}

} // namespace
} // namespace meshreel::container
