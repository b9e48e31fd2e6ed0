/// The decoder's own std::vector does what the library's does, and stops where a size cannot be.
// SPDX-License-Identifier: MIT
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "meshreel/base/random.h"

namespace meshreel::wasm_std {
using namespace std;
template <class T, class Allocator = void>
class vector;
} // namespace meshreel::wasm_std
#define _LIBCPP_BEGIN_NAMESPACE_STD namespace meshreel::wasm_std {
#define _LIBCPP_END_NAMESPACE_STD }
#include "wasm/libcxx/vector"
#undef _LIBCPP_BEGIN_NAMESPACE_STD
#undef _LIBCPP_END_NAMESPACE_STD

using namespace meshreel;
using testing::ElementsAre;

namespace {

template <class T>
using OwnVector = wasm_std::vector<T>;

/// One change out of all that the decoder makes, by three numbers.
template <class Vector>
void change_vector(Vector& v, std::uint64_t kind, std::size_t a, std::size_t count)
{
    using T = typename Vector::value_type;
    const auto at = v.begin() + static_cast<std::ptrdiff_t>(a % (v.size() + 1));
    switch (kind) {
    case 0:
        return v.push_back(T(a));
    case 1:
        return v.resize(count);
    case 2:
        return v.resize(count, T(a));
    case 3:
        return void(v.insert(at, count, T(a)));
    case 4: {
        const Vector other(count, T(a + 1));
        return void(v.insert(at, other.begin(), other.end()));
    }
    case 5:
        return void(v.erase(at, v.end()));
    case 6: {
        Vector other = v;
        other.emplace_back(T(a));
        v = std::move(other);
        return;
    }
    default:
        v.assign(count, T(a));
    }
}

/// What must be made and ended, not copied as bytes.
struct VectorText {
    VectorText() : VectorText(7) {}
    explicit VectorText(std::size_t n) : letters(std::make_shared<std::string>(n % 40, 'x')) {}
    bool operator==(const VectorText& other) const { return *letters == *other.letters; }
    std::shared_ptr<std::string> letters;
};

template <class T>
void change_both(std::uint64_t seed)
{
    Random random(seed);
    OwnVector<T> own;
    std::vector<T> theirs;
    for (int i = 0; i < 2000; ++i) {
        const std::uint64_t kind = random.bits() % 8;
        const std::size_t a = random.bits() % 1000, count = random.bits() % 100;
        change_vector(own, kind, a, count);
        change_vector(theirs, kind, a, count);
        ASSERT_EQ(own.size(), theirs.size());
        ASSERT_TRUE(std::equal(own.begin(), own.end(), theirs.begin())) << "change " << kind;
    }
}

TEST(WasmVector, does_as_the_librarys_whatever_is_done_to_it)
{
    change_both<std::uint8_t>(1);
    change_both<double>(2);
    change_both<VectorText>(3);
}

TEST(WasmVector, takes_items_of_its_own)
{
    OwnVector<std::uint32_t> v{1, 2, 3};
    v.push_back(v[0]);
    v.insert(v.begin() + 1, 3, v[2]);
    EXPECT_THAT(std::vector<std::uint32_t>(v.begin(), v.end()), ElementsAre(1u, 3u, 3u, 3u, 2u, 3u, 1u));
}

TEST(WasmVector, stops_at_a_size_that_cannot_be)
{
    OwnVector<std::uint32_t> v(100);
    EXPECT_DEATH(v.resize(std::size_t{1} << 30), "");
    EXPECT_DEATH(v.reserve(0xffffffff), "");
    EXPECT_DEATH(v.insert(v.end(), 0xfffffff0, 1u), "");
    EXPECT_EQ(v.size(), 100u);
}

} // namespace
