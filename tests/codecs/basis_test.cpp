/// Cobra: its steps, its predictors, its exactness.
// SPDX-License-Identifier: MIT
#include <cmath>
#include <gtest/gtest.h>

#include "meshreel/codecs/basis.h"
#include "meshreel/coding/range_symbols.h"

using namespace meshreel;
using namespace meshreel::codecs;

namespace {

/// One coordinate each of constant, linear, quadratic motion; F frames.
std::vector<double> polynomial(int degree, std::size_t F)
{
    std::vector<double> t(3 * F);
    for (std::size_t i = 0; i < t.size(); ++i) t[i] = std::pow(static_cast<double>(i % F) / 8.0, degree);
    return t;
}

} // namespace

TEST(Cobra, TheStepOfTheFirstVectorIsExact)
{
    const std::vector<double> a{50, 20, 9, 6, 2, 1.5, 0.7};
    const BasisLaw law = basis_law(BasisCoding::cobra, 0.01, a);
    EXPECT_NEAR(law.step(1), 0.01 / 50, 1e-15); // (8.27)
}

TEST(Cobra, StepsFollowInverseMeanCoefficientsWhereThoseAreAPowerOfTheIndex)
{
    std::vector<double> a;
    for (int i = 1; i <= 30; ++i) a.push_back(100.0 / std::pow(i, 1.5));
    const BasisLaw law = basis_law(BasisCoding::cobra, 0.02, a);
    for (std::size_t i = 1; i <= 30; ++i) EXPECT_NEAR(law.step(i), 0.02 / a[i - 1], 1e-4 * 0.02 / a[i - 1]); // (8.25)
}

TEST(Cobra, ChoosesThePredictorThatThePolynomialAsksFor)
{
    EXPECT_EQ(best_motion_order(polynomial(0, 40), {1.0 / 1024}), 1); // rest
    EXPECT_EQ(best_motion_order(polynomial(1, 40), {1.0 / 1024}), 2); // speed
    EXPECT_EQ(best_motion_order(polynomial(2, 40), {1.0 / 1024}), 3); // acceleration
    EXPECT_EQ(best_motion_order(polynomial(3, 40), {1.0 / 1024}), 4); // its change
}

TEST(Cobra, EncoderAndDecoderSeeTheSameBasis)
{
    const BasisLaw law = basis_law(BasisCoding::cobra, 0.01, std::vector<double>{3.0, 1.0});
    Basis basis{polynomial(2, 20), Matrix<double>(2, 60)};
    for (std::size_t i = 0; i < 120; ++i) basis.rows.values[i] = std::sin(0.1 * static_cast<double>(i));
    const coding::Contexts contexts{ContextGrid{}.size(basis_context_rows), {predict::motion_orders}};
    coding::RangeWriter writer(contexts);
    code_basis(writer, law, ContextGrid{}, basis);
    const Bytes bits = writer.finish();
    Basis copy{std::vector<double>(60), Matrix<double>(2, 60)};
    auto reader = coding::RangeReader::open(bits, contexts);
    code_basis(*reader, law, ContextGrid{}, copy);
    EXPECT_EQ(copy.mean, basis.mean);
    EXPECT_EQ(copy.rows.values, basis.rows.values);
}

TEST(Cobra, EveryValueIsWithinHalfAStep)
{
    const BasisLaw law = basis_law(BasisCoding::cobra, 0.01, std::vector<double>{2.0});
    const Basis original{polynomial(3, 30), Matrix<double>(1, 90)};
    Basis basis = original;
    coding::RangeWriter writer({ContextGrid{}.size(basis_context_rows), {predict::motion_orders}});
    code_basis(writer, law, ContextGrid{}, basis);
    for (std::size_t i = 0; i < 90; ++i) EXPECT_NEAR(basis.mean[i], original.mean[i], 0.005 + 1e-12);
}
