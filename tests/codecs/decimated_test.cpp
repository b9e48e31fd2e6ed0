/// The codecs on a decimated mesh in particular.
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "meshreel/codecs/average.h"
#include "meshreel/codecs/coddyac.h"
#include "meshreel/codecs/decimated.h"
#include "meshreel/codecs/lsp.h"
#include "meshreel/codecs/rbfp.h"
#include "meshreel/mesh/shapes.h"
#include "tests/codecs/fixture.h"

using namespace meshreel;

namespace {

Prepared jelly()
{
    return Prepared(*shapes::generate(*shapes::find("jelly"), {.vertices = 1000, .frames = 30}));
}

std::size_t size_of(const codecs::Codec& codec, const Prepared& prepared)
{
    return codec.prepare(prepared.sequence(), 90, {})->encode({.step = 2e-3, .entropy = Entropy::range}).payload.size();
}

} // namespace

TEST(Decimated, InterpolationIsSmallerThanExtrapolationAndProgressivePredictorsSmallerYet)
{
    const Prepared prepared = jelly();
    const std::size_t average = size_of(codecs::average(), prepared);
    EXPECT_LT(average, size_of(codecs::coddyac(), prepared));
    EXPECT_LT(size_of(codecs::lsp(), prepared), average);
    EXPECT_LT(size_of(codecs::rbfp(), prepared), average);
}

TEST(Decimated, IsNeverMuchLargerThanCoddyac)
{
    for (const char* shape : {"walker", "cloth", "snake"}) {
        const Prepared prepared(*shapes::generate(*shapes::find(shape), {.vertices = 500, .frames = 20}));
        const std::size_t coddyac = size_of(codecs::coddyac(), prepared);
        for (const codecs::Codec& codec : {codecs::average(), codecs::lsp(), codecs::rbfp()})
            EXPECT_LE(size_of(codec, prepared), coddyac + 2) << codec.name << " of " << shape;
    }
}

TEST(Decimated, SendsLessThanTwoBitsAVertexForWhoGoes)
{
    const Prepared prepared = jelly();
    const auto plan =
        connectivity::plan_decimation(prepared.surface, prepared.frames.row(0),
                                      [](std::uint32_t v, std::span<const std::uint32_t>) { return v % 7; });
    const codecs::Removals all = codecs::removals(prepared.surface, plan);
    const Bytes bits = codecs::written(Entropy::range, codecs::decimated_contexts(Entropy::range, 0), [&](auto& coder) {
        codecs::code_removals(coder, Entropy::range, prepared.surface, all);
    });
    EXPECT_LT(8 * bits.size(), 2 * prepared.surface.vertex_count);
    EXPECT_LT(all.decimation.coarse_count(), prepared.surface.vertex_count / 5);
}

TEST(Decimated, RefusesADecimationThatDoesNotFitInMemory)
{
    const Prepared prepared(test_shapes::torus());
    const auto trial = codecs::average().prepare(prepared.sequence(), 90, {})->encode({.step = 1e-2, .bases = 1});
    const std::uint64_t needed = connectivity::decimation_bytes(prepared.surface);
    const auto refused = decoded(codecs::average(), trial.payload, prepared, {.max_memory = needed});
    ASSERT_FALSE(refused.ok());
    EXPECT_EQ(refused.error().field, "SEGM.residual_bits");
    EXPECT_TRUE(decoded(codecs::average(), trial.payload, prepared, {.max_memory = 2 * needed}).ok());
}
