/// Cobra's predictors of motion: rest, speed, acceleration and change of acceleration, on one coordinate in time.
// SPDX-License-Identifier: MIT
#pragma once

namespace meshreel::predict {

constexpr int motion_orders = 4; ///< pred_1 .. pred_4

/// The value after v[-1], v[-2], ..., v[-order]; v points one past the latest known value, 0 <= order <= motion_orders.
/// Order 0 predicts 0, for the first value of a series.  @source thesis (8.18)-(8.22)
inline double motion(const double* v, int order)
{
    switch (order) {
    case 0:
        return 0.0;
    case 1:
        return v[-1]; // (8.18)
    case 2:
        return 2 * v[-1] - v[-2]; // (8.19)
    case 3:
        return 3 * v[-1] - 3 * v[-2] + v[-3]; // (8.20), (8.21)
    default:
        return 4 * v[-1] - 6 * v[-2] + 4 * v[-3] - v[-4]; // (8.22)
    }
}

} // namespace meshreel::predict
