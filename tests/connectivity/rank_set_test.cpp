/// A set with ranks against a sorted list.
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>
#include <set>

#include "meshreel/base/random.h"
#include "meshreel/connectivity/rank_set.h"

using namespace meshreel;
using connectivity::RankSet;

namespace {

void expect_answers(const RankSet& set, const std::set<std::uint32_t>& sorted, std::uint32_t n)
{
    ASSERT_EQ(set.size(), sorted.size());
    if (!sorted.empty()) {
        EXPECT_EQ(set.first(), *sorted.begin());
    }
    std::uint32_t rank = 0;
    for (const std::uint32_t x : sorted) EXPECT_EQ(set.at(rank++), x);
    for (std::uint32_t x = 0; x <= n; ++x) {
        const auto here = sorted.lower_bound(x), above = sorted.upper_bound(x);
        EXPECT_EQ(set.rank(x), std::distance(sorted.begin(), here));
        EXPECT_EQ(set.after(x), above == sorted.end() ? RankSet::nobody : *above);
        EXPECT_EQ(set.before(x), here == sorted.begin() ? RankSet::nobody : *std::prev(here));
    }
}

} // namespace

TEST(RankSet, AnswersAsASortedListWould)
{
    for (const std::uint32_t n : {1u, 64u, 700u}) {
        RankSet set(n, true);
        std::set<std::uint32_t> sorted;
        for (std::uint32_t x = 0; x < n; ++x) sorted.insert(sorted.end(), x);
        Random random(n);
        for (std::uint32_t step = 0; step < 3 * n; ++step) {
            const std::uint32_t x = static_cast<std::uint32_t>(random.below(n));
            sorted.erase(x) > 0 ? set.erase(x) : (sorted.insert(x), set.insert(x));
            if (step % 97 == 0) expect_answers(set, sorted, n);
        }
        while (!sorted.empty()) {
            set.erase(*sorted.begin());
            sorted.erase(sorted.begin());
        }
        expect_answers(set, sorted, n);
    }
}
