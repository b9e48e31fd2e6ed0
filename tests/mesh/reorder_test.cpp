/// Attribute tables in a new order.
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "meshreel/mesh/reorder.h"

using namespace meshreel;

namespace {

Attribute bytes_of(Domain domain, Bytes values, std::vector<std::uint32_t> indices = {})
{
    Attribute attribute;
    attribute.domain = domain;
    attribute.type = Scalar::u8;
    attribute.values = std::move(values);
    attribute.indices = std::move(indices);
    return attribute;
}

const std::vector<std::uint32_t> vertex_of{2, 0, 1};
const std::vector<std::uint32_t> corner_of{4, 5, 3, 0, 1, 2};

Attribute reordered_one(const Attribute& attribute)
{
    return reordered(Appearance{{attribute}, {}, {}, {}}, {vertex_of, corner_of}).attributes[0];
}

} // namespace

TEST(Reorder, ValuesFollowTheirVertices)
{
    EXPECT_EQ(reordered_one(bytes_of(Domain::vertex, {10, 11, 12})).values, (Bytes{12, 10, 11}));
}

TEST(Reorder, ValuesFollowTheirCornersAndTriangles)
{
    EXPECT_EQ(reordered_one(bytes_of(Domain::corner, {0, 1, 2, 3, 4, 5})).values, (Bytes{4, 5, 3, 0, 1, 2}));
    EXPECT_EQ(reordered_one(bytes_of(Domain::triangle, {7, 8})).values, (Bytes{8, 7}));
}

TEST(Reorder, OfAnIndexedTableOnlyTheIndicesMove)
{
    const Attribute result = reordered_one(bytes_of(Domain::vertex, {5, 6}, {0, 1, 1}));
    EXPECT_EQ(result.values, (Bytes{5, 6}));
    EXPECT_EQ(result.indices, (std::vector<std::uint32_t>{1, 0, 1}));
}

TEST(Reorder, PositionsFollowTheirVertices)
{
    const std::vector<float> frame{0, 0, 0, 1, 1, 1, 2, 2, 2};
    std::vector<float> result(9);
    reorder_frame(frame, vertex_of, result);
    EXPECT_EQ(result, (std::vector<float>{2, 2, 2, 0, 0, 0, 1, 1, 1}));
}
