/// Spectra of runs of frames are those that a PCA of the run finds.
// SPDX-License-Identifier: MIT
#include <cmath>
#include <gtest/gtest.h>

#include "meshreel/base/random.h"
#include "meshreel/linalg/pca.h"
#include "meshreel/linalg/run_spectra.h"

using namespace meshreel;

TEST(RunSpectra, OfAnyRunAreThoseOfItsPca)
{
    Random random(3);
    Matrix<float> frames(150, 3 * 20);
    for (float& value : frames.values) value = static_cast<float>(random.uniform(-1.0, 1.0));
    const linalg::RunSpectra spectra(frames.view());
    for (const auto& [first, last] : {std::pair<std::size_t, std::size_t>{0, 150}, {3, 61}, {64, 128}, {100, 104}}) {
        const std::vector<double> energies = spectra.energies(first, last);
        const linalg::Pca pca =
            linalg::pca_of_trajectories({frames.row(first).data(), last - first, frames.cols}, 20, {});
        for (std::size_t k = 0; k < std::min<std::size_t>(12, pca.singular_values.size()); ++k)
            EXPECT_NEAR(std::sqrt(energies[k]) / pca.singular_values[k], 1.0, 1e-9);
    }
}
