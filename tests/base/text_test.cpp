/// Sentences put together from pieces.
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "meshreel/base/text.h"

using namespace meshreel;

TEST(Text, TellsNumbersOfAnySizeInAFewDigits)
{
    EXPECT_EQ(concat("frame ", 7, " of ", -3), "frame 7 of -3");
    EXPECT_EQ(concat(24.0, " ", 0.25, " ", 29.97), "24 0.25 29.97");
    EXPECT_EQ(concat(-1.25e300, " ", 1e-9), "-1.25e+300 1e-09");
    EXPECT_EQ(concat(~std::uint64_t{0}), "18446744073709551615");
}
