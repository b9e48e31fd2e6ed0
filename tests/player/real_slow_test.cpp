/// The player against the exact decode on real sequences, where they are at hand.
// SPDX-License-Identifier: MIT
#include <filesystem>
#include <gtest/gtest.h>

#include "tests/player/fixture.h"

using namespace meshreel;

TEST(PlayerOfRealData, StaysWithinAMillionthOfTheBodyDiagonalOfTheExactDecode)
{
    int found = 0;
    for (const char* name : {"dance", "chicken", "cow", "snake", "bone", "dolphin"}) {
        const std::string folder = std::string(MESHREEL_SOURCE_DIR "/../shared/data/") + name;
        if (!std::filesystem::exists(folder + "/motion.pc2")) continue;
        ++found;
        io::LoadOptions options;
        options.mesh = folder + "/mesh.obj";
        const Bytes reel = reel_of(*io::load(folder + "/motion.pc2", options), with_bases(80));
        const double distance = farthest(*decode(reel), played(*player::Player::open(reel)));
        RecordProperty(name, std::to_string(distance));
        std::printf("%-10s %.2e body diagonals\n", name, distance);
        EXPECT_LE(distance, 1e-6) << name;
    }
    if (found == 0) GTEST_SKIP() << "no ../shared/data";
}
