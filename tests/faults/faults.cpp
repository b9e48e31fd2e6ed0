/// The faults, and what is demanded of a decoder that meets one.
// SPDX-License-Identifier: MIT
#include "tests/faults/faults.h"

#include <algorithm>
#include <ctime>
#include <iomanip>
#include <sstream>

#include <gtest/gtest.h>

#include "meshreel/coding/varint.h"
#include "meshreel/meshreel.h"
#include "tests/faults/file.h"
#include "tests/faults/memory.h"

namespace meshreel::faults {

namespace {

constexpr std::uint64_t memory_cap = 16u << 20;
constexpr std::size_t slack = 8u << 20; // tables of fixed size
constexpr double most_seconds = 10.0;   // of the processor; a sanitizer takes some

/// One decode after the other.
class Trials {
public:
    void run(ByteView file, const char* fault)
    {
        const std::size_t before = held();
        reset_peak();
        const std::clock_t start = std::clock();
        decode_one(file, fault);
        const double seconds = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
        EXPECT_LE(seconds, most_seconds) << fault;
        EXPECT_LE(peak() - before, memory_cap + slack) << fault;
        EXPECT_LE(held(), before) << fault << " left memory behind";
        tally_.peak = std::max(tally_.peak, peak() - before);
        tally_.longest_s = std::max(tally_.longest_s, seconds);
    }

    const Tally& tally() const { return tally_; }

private:
    void decode_one(ByteView file, const char* fault)
    {
        DecodeOptions options;
        options.threads = {1};
        options.limits.max_memory = memory_cap;
        const Result<Animation> animation = decode(file, options);
        if (!animation.ok()) {
            ++tally_.refused;
            EXPECT_FALSE(animation.error().message.empty()) << fault;
            return;
        }
        ++tally_.valid;
        const Status valid = validate(*animation);
        EXPECT_TRUE(valid.ok()) << fault << ": " << valid.error().sentence();
    }

    Tally tally_;
};

/// A number in all the ways in which a field may hold it.
std::vector<Bytes> wild_values(std::size_t size)
{
    std::vector<Bytes> all;
    for (const std::uint64_t number :
         {std::uint64_t{0}, std::uint64_t{1}, ~std::uint64_t{0} >> 32, ~std::uint64_t{0}, ~std::uint64_t{1}}) {
        Bytes varint;
        coding::put_varint(varint, number);
        all.push_back(varint);
    }
    for (const int first : {0x00, 0x01, 0xfe, 0xff}) {
        Bytes own(size, first < 2 ? 0x00 : 0xff);
        own.front() = static_cast<std::uint8_t>(first);
        all.push_back(own);
        if (first < 2) continue;
        own.back() = 0x7f; // as a varint of this length, or as a signed number, the largest
        all.push_back(own);
    }
    return all;
}

} // namespace

Tally& Tally::operator+=(const Tally& more)
{
    refused += more.refused;
    valid += more.valid;
    peak = std::max(peak, more.peak);
    longest_s = std::max(longest_s, more.longest_s);
    return *this;
}

std::string Tally::sentence() const
{
    std::ostringstream said;
    said << tried() << " tried, " << refused << " refused, " << valid << " valid; at most " << peak / 1024 << " kB, "
         << std::fixed << std::setprecision(3) << longest_s << " s";
    return said.str();
}

Tally truncations(ByteView file, std::size_t stride)
{
    Trials trials;
    for (std::size_t size = 0; size < file.size(); size += stride) trials.run(file.first(size), "a truncation");
    EXPECT_EQ(trials.tally().valid, 0u);
    return trials.tally();
}

Tally truncated_payloads(ByteView file, std::size_t stride)
{
    Trials trials;
    const std::vector<Part> parts = parts_of(file);
    for (std::size_t i = 0; i + 2 < parts.size(); ++i)
        for (std::size_t size = 0; size <= parts[i].payload.size() + 1; size += stride) {
            std::vector<Part> changed = parts;
            changed[i].payload.resize(size);
            trials.run(indexed(changed), "a truncated payload");
        }
    return trials.tally();
}

Tally flipped_bits(ByteView file, std::size_t stride)
{
    Trials trials;
    Bytes changed(file.begin(), file.end());
    for (std::size_t bit = 0; bit < 8 * file.size(); bit += stride) {
        changed[bit / 8] ^= static_cast<std::uint8_t>(1u << bit % 8);
        trials.run(changed, "a flipped bit");
        changed[bit / 8] = file[bit / 8];
    }
    EXPECT_EQ(trials.tally().valid, 0u);
    return trials.tally();
}

Tally flipped_payload_bits(ByteView file, std::size_t stride)
{
    Trials trials;
    std::vector<Part> parts = parts_of(file);
    for (std::size_t i = 0; i + 2 < parts.size(); ++i)
        for (std::size_t bit = 0; bit < 8 * parts[i].payload.size(); bit += stride) {
            std::uint8_t& byte = parts[i].payload[bit / 8];
            byte ^= static_cast<std::uint8_t>(1u << bit % 8);
            trials.run(indexed(parts), "a flipped bit behind its checksum");
            byte ^= static_cast<std::uint8_t>(1u << bit % 8);
        }
    return trials.tally();
}

Tally shuffled_chunks(ByteView file)
{
    Trials trials;
    const std::vector<Part> parts = parts_of(file);
    const auto both = [&](const std::vector<Part>& changed, const char* fault) {
        trials.run(sealed(changed), fault);
        trials.run(indexed(changed), fault);
    };
    for (std::size_t i = 0; i < parts.size(); ++i) {
        for (std::size_t j = 0; j <= parts.size(); ++j) {
            std::vector<Part> changed = parts;
            changed.insert(changed.begin() + static_cast<std::ptrdiff_t>(j), parts[i]);
            both(changed, "a repeated chunk");
            if (j <= i || j == parts.size()) continue;
            changed = parts;
            std::swap(changed[i], changed[j]);
            both(changed, "swapped chunks");
        }
        std::vector<Part> changed = parts;
        changed.erase(changed.begin() + static_cast<std::ptrdiff_t>(i));
        both(changed, "a missing chunk");
    }
    return trials.tally();
}

Tally wild_fields(ByteView file)
{
    Trials trials;
    const std::vector<Part> parts = parts_of(file);
    for (const Field& field : fields_of(file)) {
        if (field.size > 10) continue;
        for (const Bytes& value : wild_values(field.size)) {
            std::vector<Part> changed = parts;
            Bytes& payload = changed[field.part].payload;
            const auto begin = payload.begin() + static_cast<std::ptrdiff_t>(field.begin);
            payload.erase(begin, begin + static_cast<std::ptrdiff_t>(field.size));
            payload.insert(payload.begin() + static_cast<std::ptrdiff_t>(field.begin), value.begin(), value.end());
            trials.run(sealed(changed), field.name.c_str());
            trials.run(indexed(changed), field.name.c_str());
        }
    }
    return trials.tally();
}

} // namespace meshreel::faults
