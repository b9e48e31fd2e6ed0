/// A struct that lists its fields once is written, read and refused as it says.
// SPDX-License-Identifier: MIT
#include "meshreel/container/fields.h"

#include <gmock/gmock.h>

namespace meshreel::container {
namespace {

enum class Colour : std::uint8_t { red, green };

struct Item {
    std::int32_t delta = 0;
    void fields(auto& io) { io.signed_varint("delta", delta, {-1000, 1000}, "a small number"); }
};

struct Sample {
    std::uint8_t tiny = 3;
    std::uint16_t small = 500;
    std::uint32_t frames = 12;
    std::uint64_t big = 1ull << 60;
    float ratio = 0.5f;
    double step = 1e-300;
    bool loop = true;
    Colour colour = Colour::green;
    std::string name = "walk";
    std::vector<float> mean = {1.0f, -2.0f};
    std::vector<Item> items = {{-1000}, {1000}, {0}};
    std::vector<std::string> words = {"a", ""};
    Bytes tail = {1, 2, 3};

    void fields(auto& io)
    {
        io.u8("tiny", tiny, {1, 9}, "");
        io.u16("small", small, any, "");
        io.varint("frames", frames, up_to(Limit::frames, 1), "F");
        io.varint("big", big, any, "");
        io.f32("ratio", ratio, {0.0, 1.0}, "");
        io.f64("step", step, positive, "");
        io.flag("loop", loop, "");
        io.choice("colour", colour, {"red", "green"}, "");
        io.text("name", name, 10, "");
        io.when(tiny > 2, "tiny > 2", [&] { io.f32s("mean", mean, {2, "2"}, ""); });
        io.list("items", items, any, "");
        io.texts("words", words, 10, "");
        io.must(frames % 2 == 0, "frames", "frames is even");
        io.rest("tail", tail, "");
    }
};

Bytes written(const Sample& sample)
{
    return *write_fields(sample);
}

Error error_of(const Bytes& bytes, const DecodeLimits& limits = {})
{
    const auto read = read_fields<Sample>({bytes, 100, "TEST"}, limits);
    return read.ok() ? Error{ErrorCode::runtime, "no error"} : read.error();
}

TEST(Fields, come_back_as_they_were_written)
{
    const Bytes bytes = written({});
    const auto back = read_fields<Sample>({bytes, 0, "TEST"}, {});
    ASSERT_TRUE(back.ok()) << back.error().sentence();
    EXPECT_EQ(written(*back), bytes);
    EXPECT_EQ(back->items[0].delta, -1000);
    EXPECT_EQ(back->mean, (std::vector<float>{1.0f, -2.0f}));
    EXPECT_EQ(back->step, 1e-300);
    EXPECT_EQ(back->tail, (Bytes{1, 2, 3}));
}

TEST(Fields, name_the_byte_in_the_file_and_the_field_where_the_data_end)
{
    const Bytes bytes = written({});
    for (std::size_t size = 0; size + 3 < bytes.size(); ++size) {
        const Error error = error_of({bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(size)});
        ASSERT_EQ(error.code, ErrorCode::bad_input) << size;
        EXPECT_THAT(error.field, testing::StartsWith("TEST.")) << size;
        ASSERT_TRUE(error.place.has_value()) << size;
        EXPECT_LE(error.place->number, 100 + size);
    }
}

TEST(Fields, refuse_a_value_outside_its_range)
{
    Bytes bytes = written({});
    bytes[0] = 10;
    EXPECT_EQ(error_of(bytes).sentence(), "byte 100: TEST.tiny: 10 is not in 1 .. 9");
}

TEST(Fields, refuse_a_number_above_the_limits_of_the_reader)
{
    EXPECT_EQ(error_of(written({}), {.max_frames = 11}).sentence(),
              "byte 103: TEST.frames: 12 is above the limit of 11");
}

TEST(Fields, name_an_item_of_a_list_by_its_number)
{
    Bytes bytes = written({}); // ... items: count, -1000 (2 bytes), 1000 (2 bytes), 0; 4 bytes of words; 3 of tail
    bytes[bytes.size() - 10] = 0xff;
    bytes[bytes.size() - 9] = 0x7f;
    EXPECT_THAT(error_of(bytes).sentence(), testing::HasSubstr("TEST.items[1].delta: -8192 is not in -1000 .. 1000"));
}

TEST(Fields, refuse_a_number_in_more_bytes_than_it_needs)
{
    Bytes bytes = written({});
    bytes[3] = 0x8c;
    bytes.insert(bytes.begin() + 4, 0x00);
    EXPECT_THAT(error_of(bytes).message, testing::HasSubstr("more bytes than it needs"));
}

TEST(Fields, refuse_a_broken_rule_between_fields)
{
    Bytes bytes = written({});
    bytes[3] = 13;
    EXPECT_THAT(error_of(bytes).message, testing::HasSubstr("frames is even"));
}

TEST(Fields, are_checked_when_written_too)
{
    Sample sample;
    sample.step = -1.0;
    const auto bytes = write_fields(sample);
    ASSERT_FALSE(bytes.ok());
    EXPECT_EQ(bytes.error().field, "step");
}

struct Big {
    std::vector<Item> items;
    std::vector<double> numbers;
    void fields(auto& io)
    {
        io.list("items", items, any, "");
        io.f64s("numbers", numbers, {1ull << 61, "2^61"}, "");
    }
};

TEST(Fields, refuse_counts_that_the_bytes_cannot_hold_before_allocating)
{
    const Bytes list = {0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0x01};
    const auto first = read_fields<Big>({list, 0, "BIG"}, {});
    ASSERT_FALSE(first.ok());
    EXPECT_EQ(first.error().field, "BIG.items");
    const Bytes array = {0x00, 1, 2, 3, 4, 5, 6, 7, 8, 9};
    const auto second = read_fields<Big>({array, 0, "BIG"}, {});
    ASSERT_FALSE(second.ok());
    EXPECT_EQ(second.error().field, "BIG.numbers");
}

TEST(Fields, refuse_a_list_above_the_memory_limit)
{
    Big big;
    big.items.resize(1000);
    Writer writer;
    writer.list("items", big.items, any, "");
    const Bytes bytes = *std::move(writer).finish();
    Reader reader({bytes, 0, "BIG"}, {.max_memory = 1000});
    reader.list("items", big.items, any, "");
    ASSERT_TRUE(reader.failed());
    EXPECT_THAT((*reader.failure()).message, testing::HasSubstr("memory limit"));
}

} // namespace
} // namespace meshreel::container
