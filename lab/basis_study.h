/// A sequence's exact basis and coefficients, and what quantising the basis does to them.
// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <vector>

#include "lab/experiments.h"
#include "meshreel/codecs/basis.h"
#include "meshreel/linalg/pca.h"
#include "meshreel/mesh/animation.h"

namespace meshreel::lab {

/// The animation of a row's "motion" and "mesh".
Result<Animation> load(const Json& row);

/// Every position of an animation, [F x 3V].
MatrixView<const float> frames_of(const Animation& animation);

/// Keeps the levels that a walk codes.
struct Tape {
    static constexpr bool writes = true;
    std::vector<std::int32_t> levels;

    std::int32_t level(std::uint32_t, std::int32_t wanted)
    {
        levels.push_back(wanted);
        return wanted;
    }
    std::int32_t symbol(std::uint32_t, std::int32_t wanted) { return wanted; }
    std::int32_t bits(std::int32_t value, int) { return value; }
};

/// Chooses what predicts a trajectory.
using Choose = std::function<codecs::SeriesPredictor(std::span<const double> t, coding::Quantiser quantiser)>;

/// Predicts by pred_order of (8.18)-(8.22).
Choose motion_of(int order);

/// What coding a basis leaves.
struct CodedBasis {
    std::vector<std::int32_t> levels; ///< residuals of all basis vectors; not of the mean
    double squares = 0.0;             ///< sum of (level times step)^2 where every order has its values before
    std::vector<double> harm;         ///< [1 + K] |m' - m|^2, then |B'_i - B_i|^2 for each i
};

class BasisStudy {
public:
    BasisStudy(const Animation& animation, std::size_t bases);

    std::size_t bases() const { return pca_.basis.rows; }
    MatrixView<const double> basis() const { return pca_.basis.view(); }
    /// The law of the steps with the mean's step Q_m.
    codecs::BasisLaw law(BasisCoding coding, double mean_step) const;
    /// The law with the coarsest steps whose figure is at most `most`; the figure rises with the steps.
    codecs::BasisLaw law_where(BasisCoding coding, double most,
                               const std::function<double(const codecs::BasisLaw&)>& figure) const;

    /// tripled: the vector, from 1, whose step is three times that of the law; 0: none.
    CodedBasis code(const codecs::BasisLaw& law, const Choose& choose, std::size_t tripled = 0) const;

    /// KG error, percent, of the exact coefficients on a basis that is harmed so. Empty: on the exact basis.
    double kg(std::span<const double> harm) const;

private:
    linalg::Pca pca_;
    std::vector<double> mean_absolute_; ///< a_i of (8.24)
    double vertex_count_;
};

} // namespace meshreel::lab
