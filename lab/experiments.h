/// The lab's measurements that the command does not show. Each takes a row of a plan and gives its figures.
// SPDX-License-Identifier: MIT
#pragma once

#include <nlohmann/json.hpp>

#include "meshreel/base/result.h"

namespace meshreel::lab {

using Json = nlohmann::ordered_json;

// Every row holds "motion" and "mesh", paths as for `meshreel encode MOTION --mesh MESH`.

/// The variances along the eigentrajectories (thesis table 8.2).
/// Row: "count". Gives "eigenvalues" [count], "sum", "all" (how many there are), "vertices".
Result<Json> eigenvalues(const Json& row);

/// What each predictor of the basis leaves (thesis table 9.2): entropy and sum of squares of the residuals of all basis
/// vectors in one histogram, at the non-uniform steps that leave cob1 a given entropy.
/// Row: "bases" K, "cob1" bits. Gives "kg" percent of the exact coefficients on this basis, "kg_of_exact_basis", and for
/// cob1 .. cob4, lpc1 .. lpc4 (one set of weights for all vectors), own_lpc1 .. (a set a vector) "entropy", bits, and
/// "squares", the sum of squared residuals from the fifth frame on.
Result<Json> predictors(const Json& row);

/// The KG error where the step of one basis vector is tripled (thesis figures 9.49, 9.50), for uniform and non-uniform
/// steps, the coefficients exact.
/// Row: "bases" K, "kg" percent before. Gives "frames", "kg_of_exact_basis", and for "uniform" and "non_uniform" "before" and
/// "after" [K], percent, and "steps" [K] before they are tripled.
Result<Json> tripled(const Json& row);

/// Rates and errors of a codec on a grid of settings (thesis table 9.3), its preparation shared.
/// Row: "codec", "basis", "entropy", "bases" [list of K], "bits" [list; steps are 2^-bits of the body diagonal].
/// Gives "points": each "bases", "bits", "bytes" of a whole file without the order, "kg" percent.
Result<Json> sweep(const Json& row);

} // namespace meshreel::lab
