/// The codecs on a decimated mesh in particular.
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>

#include "meshreel/codecs/average.h"
#include "meshreel/codecs/coddyac.h"
#include "meshreel/codecs/decimated.h"
#include "meshreel/codecs/lsp.h"
#include "meshreel/codecs/rbfp.h"
#include "meshreel/mesh/shapes.h"
#include "meshreel/predict/average.h"
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

TEST(Decimated, SendsWhoGoesInLessThanTwoBitsAVertexOrThreeByHuffmanCodes)
{
    const Prepared prepared = jelly();
    const auto plan = connectivity::plan_decimation(prepared.surface, prepared.frames.row(0),
                                                    [](auto&, std::uint32_t v, auto&) { return v % 7; });
    const codecs::Removals all = codecs::removals(prepared.surface, plan);
    EXPECT_LT(all.decimation.coarse_count(), prepared.surface.vertex_count / 5);
    for (const auto& [entropy, most] : {std::pair{Entropy::range, 2u}, std::pair{Entropy::huffman, 3u}}) {
        const coding::Contexts contexts = codecs::decimated_contexts(entropy, 0);
        const auto code = [&, entropy = entropy](auto& all_) {
            return [&, entropy](auto& coder) { codecs::code_removals(coder, entropy, prepared.surface, all_); };
        };
        const Bytes bits = codecs::written(entropy, contexts, code(all));
        EXPECT_LT(8 * bits.size(), most * prepared.surface.vertex_count);
        codecs::Removals received;
        ASSERT_TRUE(codecs::taken(entropy, bits, contexts, code(received)).ok());
        EXPECT_EQ(received.decimation.rings, all.decimation.rings);
    }
}

TEST(RemovalJudge, CountsTheParallelogramsThatARemovalSaves)
{
    // One vertex is not where all others are: the parallelograms over its spokes and those over its ring miss it by as
    // much as the average of its neighbours does.
    const Animation grid = *shapes::generate(*shapes::find("wave"), {.vertices = 100, .frames = 1});
    const connectivity::Stars stars(100, grid.triangles);
    const connectivity::Mesh mesh{grid.triangles, stars};
    Matrix<float> C(100, 1);
    C(55, 0) = 1;
    codecs::RemovalJudge judge(C.view());
    predict::Average average(judge.step());
    connectivity::Hole hole;
    ASSERT_TRUE(connectivity::find_hole(mesh, 55, hole));
    const double missed = 1 / judge.step(), bits = 0.5 * std::log2(1 + 4 * missed * missed);
    EXPECT_NEAR(judge.price(average, mesh, 55, hole), bits - bits * 2 * static_cast<double>(hole.ring.size()) / 3,
                1e-9);
    EXPECT_EQ(judge.inaccuracy(average, 55, hole.ring), 1);
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
