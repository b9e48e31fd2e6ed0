/// What every codec of the registry promises, on every awkward shape, at every setting.
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "tests/codecs/fixture.h"

using namespace meshreel;

namespace {

class EveryCodec : public testing::TestWithParam<codecs::Codec> {
protected:
    codecs::Trial encoded(const Prepared& prepared, const codecs::Settings& settings) const
    {
        return GetParam().prepare(prepared.sequence(), 1000, settings.threads)->encode(settings);
    }
};

/// A codec that loses something, the more the coarser the step.
class EveryLossyCodec : public EveryCodec {};

INSTANTIATE_TEST_SUITE_P(Registry, EveryLossyCodec,
                         testing::ValuesIn(codecs::of_trajectories().begin(), codecs::of_trajectories().end()),
                         [](const auto& row) { return std::string(row.param.name); });

INSTANTIATE_TEST_SUITE_P(Registry, EveryCodec, testing::ValuesIn(codecs::all().begin(), codecs::all().end()),
                         [](const auto& row) { return std::string(row.param.name); });

} // namespace

TEST_P(EveryCodec, DecodesToTheErrorThatTheEncoderReports)
{
    for (const auto& [name, animation] : test_shapes::all())
        for (const codecs::Settings& settings : settings_of(GetParam(), 0.003)) {
            const Prepared prepared(animation);
            const codecs::Trial trial = encoded(prepared, settings);
            const auto frames = decoded(GetParam(), trial.payload, prepared);
            ASSERT_TRUE(frames.ok()) << name << ": " << frames.error().sentence();
            const double floor = 1e-10 * static_cast<double>(prepared.frames.values.size());
            EXPECT_NEAR(squared_difference(prepared.frames, *frames), trial.squared_error,
                        floor + 0.01 * trial.squared_error)
                << name;
        }
}

TEST_P(EveryCodec, WritesTheSameBytesForAnyNumberOfThreads)
{
    const Prepared prepared(test_shapes::torus());
    for (codecs::Settings settings : settings_of(GetParam(), 0.01)) {
        settings.threads = {1};
        const Bytes one = encoded(prepared, settings).payload;
        settings.threads = {3};
        EXPECT_EQ(one, encoded(prepared, settings).payload);
    }
}

TEST_P(EveryLossyCodec, IsMoreAccurateWithAFinerStep)
{
    const Prepared prepared(test_shapes::double_torus());
    for (const codecs::Settings& coarse : all_settings(0.03)) {
        codecs::Settings fine = coarse;
        fine.step = coarse.step / 4;
        EXPECT_LT(encoded(prepared, fine).squared_error, encoded(prepared, coarse).squared_error);
    }
}

TEST_P(EveryLossyCodec, KeepsTheMeanWhereTheStepIsTooCoarseForAnyComponent)
{
    const Prepared prepared(test_shapes::torus());
    for (const codecs::Settings& settings : all_settings(1e6)) {
        const codecs::Trial trial = encoded(prepared, settings);
        EXPECT_EQ(trial.bases, 0u);
        const auto frames = decoded(GetParam(), trial.payload, prepared);
        ASSERT_TRUE(frames.ok()) << frames.error().sentence();
        EXPECT_FLOAT_EQ(frames->values.front(), frames->values[3]);
    }
}

TEST_P(EveryCodec, RefusesEveryTruncation)
{
    const Prepared prepared(test_shapes::two_components());
    for (const codecs::Settings& settings : settings_of(GetParam(), 0.01)) {
        const Bytes payload = encoded(prepared, settings).payload;
        for (std::size_t size = 0; size < payload.size(); ++size) {
            const auto frames = decoded(GetParam(), ByteView(payload).first(size), prepared);
            ASSERT_FALSE(frames.ok()) << size << " of " << payload.size();
            EXPECT_FALSE(frames.error().field.empty());
        }
    }
}

TEST_P(EveryCodec, SurvivesEveryFlippedBit)
{
    const Prepared prepared(test_shapes::tetrahedron());
    for (const codecs::Settings& settings : settings_of(GetParam(), 0.01)) {
        const Bytes payload = encoded(prepared, settings).payload;
        for (std::size_t bit = 0; bit < 8 * payload.size(); ++bit) {
            Bytes broken = payload;
            broken[bit / 8] ^= static_cast<std::uint8_t>(1u << bit % 8);
            const auto frames = decoded(GetParam(), broken, prepared, {.max_memory = 1 << 24});
            if (frames.ok()) {
                EXPECT_EQ(frames->values.size(), prepared.frames.values.size());
            }
        }
    }
}
