/// Cobra: its steps, its predictors, its exactness; LPC: its weights.
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

const coding::Contexts basis_contexts{ContextGrid{}.size(basis_context_rows), {predict::motion_orders}};

/// What a decoder sees of a basis; the basis becomes what the encoder believes that to be.
Basis through_the_coder(const BasisLaw& law, Basis& basis)
{
    coding::RangeWriter writer(basis_contexts);
    code_basis(writer, law, ContextGrid{}, basis);
    const Bytes bits = writer.finish();
    Basis copy{std::vector<double>(basis.mean.size()), Matrix<double>(basis.rows.rows, basis.rows.cols)};
    auto reader = coding::RangeReader::open(bits, basis_contexts);
    code_basis(*reader, law, ContextGrid{}, copy);
    EXPECT_FALSE(reader->overrun());
    return copy;
}

MatrixView<const double> one(const std::vector<double>& t)
{
    return {t.data(), 1, t.size()};
}

/// Three coordinates of a series with v_f = a_0 + a_1 v_(f-1) + a_2 v_(f-2).
std::vector<double> following(double a0, double a1, double a2)
{
    std::vector<double> t;
    for (double start : {1.0, -2.0, 0.5})
        for (std::size_t f = 0; f < 30; ++f)
            t.push_back(f < 2 ? start + static_cast<double>(f) : a0 + a1 * t[t.size() - 1] + a2 * t[t.size() - 2]);
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
    const Basis copy = through_the_coder(law, basis);
    EXPECT_EQ(copy.mean, basis.mean);
    EXPECT_EQ(copy.rows.values, basis.rows.values);
}

TEST(Cobra, EveryValueIsWithinHalfAStep)
{
    const BasisLaw law = basis_law(BasisCoding::cobra, 0.01, std::vector<double>{2.0});
    const Basis original{polynomial(3, 30), Matrix<double>(1, 90)};
    Basis basis = original;
    through_the_coder(law, basis);
    for (std::size_t i = 0; i < 90; ++i) EXPECT_NEAR(basis.mean[i], original.mean[i], 0.005 + 1e-12);
}

TEST(Lpc, TheWeightsOfASeriesThatFollowsALawAreThatLaw)
{
    const std::vector<double> t = following(0.25, 1.6, -0.8);
    const auto weights = lpc_weights(one(t), 2);
    EXPECT_NEAR(weights[0], 0.25, 1e-9);
    EXPECT_NEAR(weights[1], 1.6, 1e-9);
    EXPECT_NEAR(weights[2], -0.8, 1e-9);
}

TEST(Lpc, HasOneSetOfWeightsForAllVectors)
{
    Matrix<double> both(2, 90);
    std::ranges::copy(following(0.0, 0.5, 0.0), both.row(0).begin());
    std::ranges::copy(following(0.0, 0.7, 0.0), both.row(1).begin());
    const double shared = lpc_weights(both.view(), 1)[1];
    EXPECT_GT(shared, 0.5);
    EXPECT_LT(shared, 0.7);
}

TEST(Lpc, OfAHigherOrderNeverLeavesMore)
{
    std::vector<double> t(120);
    for (std::size_t i = 0; i < t.size(); ++i) t[i] = std::sin(0.3 * static_cast<double>(i * i % 37));
    double before = 1e300;
    for (int order = 1; order <= predict::linear_orders; ++order) {
        const auto weights = lpc_weights(one(t), order);
        double sum = 0; // over the same frames for every order
        for (std::size_t c = 0; c < 3; ++c)
            for (std::size_t f = predict::linear_orders; f < 40; ++f)
                sum += std::pow(t[40 * c + f] - predict::linear(&t[40 * c + f], order, weights.data()), 2);
        EXPECT_LT(sum, 1.001 * before);
        before = sum;
    }
}

TEST(Lpc, EncoderAndDecoderSeeTheSameBasisAtEveryOrder)
{
    for (BasisCoding coding : {BasisCoding::lpc1, BasisCoding::lpc2, BasisCoding::lpc3, BasisCoding::lpc4}) {
        const BasisLaw law = basis_law(coding, 0.01, std::vector<double>{3.0});
        Basis basis{polynomial(2, 30), Matrix<double>(1, 90)};
        const std::vector<double> original = following(0.1, 1.5, -0.7);
        basis.rows.values = original;
        const Basis copy = through_the_coder(law, basis);
        EXPECT_EQ(copy.mean, basis.mean);
        EXPECT_EQ(copy.rows.values, basis.rows.values);
        for (std::size_t i = 0; i < 90; ++i) EXPECT_NEAR(copy.rows.values[i], original[i], 0.5 * law.step(1) + 1e-12);
    }
}

TEST(Lpc, AWeightTooLargeToBeSentCostsBitsButNoAccuracy)
{
    Basis basis{polynomial(0, 8), Matrix<double>(1, 24)};
    for (std::size_t i = 0; i < 24; ++i) basis.rows.values[i] = 1e-6 * std::pow(10.0, static_cast<double>(i % 8));
    const std::vector<double> original = basis.rows.values;
    EXPECT_NEAR(lpc_weights(one(original), 1)[1], 10.0, 1e-6);
    const BasisLaw law = basis_law(BasisCoding::lpc1, 0.01, std::vector<double>{10.0});
    const Basis copy = through_the_coder(law, basis);
    for (std::size_t i = 0; i < 24; ++i) EXPECT_NEAR(copy.rows.values[i], original[i], 0.0005 + 1e-12);
}
