/// KG error: reference values, and its defined values at the edges.
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "meshreel/metrics/kg.h"
#include "tests/metrics/reference_vectors.h"

using namespace meshreel;

TEST(KgError, ReproducesTheReferenceVectorsToTheDigitsPrinted)
{
    for (const reference::Vector& vector : reference::vectors) {
        const reference::Grid grid = reference::grid(vector);
        EXPECT_NEAR(metrics::kg_error(grid.pair()) / vector.kg, 1.0, 1e-9) << vector.distortion;
    }
}
