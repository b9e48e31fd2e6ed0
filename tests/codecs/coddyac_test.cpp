/// Coddyac in particular.
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "meshreel/codecs/coddyac.h"
#include "meshreel/mesh/shapes.h"
#include "tests/codecs/fixture.h"

using namespace meshreel;

namespace {

Animation cloth()
{
    return *shapes::generate(*shapes::find("wave"), {.vertices = 900, .frames = 30});
}

} // namespace

TEST(Coddyac, ARankOneMotionNeedsOneMoreComponentThanItsShape)
{
    const Prepared prepared(cloth());
    const auto encoder = codecs::coddyac().prepare(prepared.sequence(), 90, {});
    EXPECT_LE(encoder->encode({.step = 1e-4}).bases, 4u); // x, y and z of the rest shape, and the wave
}

TEST(Coddyac, UsesTheNumberOfBasesAskedFor)
{
    const Prepared prepared(test_shapes::torus());
    const auto encoder = codecs::coddyac().prepare(prepared.sequence(), 90, {});
    EXPECT_EQ(encoder->encode({.step = 1e-3, .bases = 3}).bases, 3u);
}

TEST(Coddyac, ChoosesAStepWhereOnlyBasesAreAskedFor)
{
    const Prepared prepared(test_shapes::torus());
    const auto encoder = codecs::coddyac().prepare(prepared.sequence(), 90, {});
    EXPECT_GT(encoder->encode({.bases = 2}).step, encoder->encode({.bases = 4}).step);
}

TEST(Coddyac, CobraIsSmallerThanARawBasis)
{
    const Prepared prepared(cloth());
    const auto encoder = codecs::coddyac().prepare(prepared.sequence(), 90, {});
    const auto size = [&](BasisCoding basis) { return encoder->encode({.step = 1e-3, .basis = basis}).payload.size(); };
    EXPECT_LT(size(BasisCoding::cobra), size(BasisCoding::uniform));
    EXPECT_LT(size(BasisCoding::uniform), size(BasisCoding::raw));
}

TEST(Coddyac, RefusesMoreBasesThanMemoryAllows)
{
    const Prepared prepared(test_shapes::torus());
    const auto trial = codecs::coddyac().prepare(prepared.sequence(), 90, {})->encode({.step = 1e-4});
    const auto frames = decoded(codecs::coddyac(), trial.payload, prepared, {.max_memory = 1000});
    ASSERT_FALSE(frames.ok());
    EXPECT_EQ(frames.error().field, "SEGM.bases");
}
