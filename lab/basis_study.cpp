/// Loads a row's sequence; quantises a basis and counts what that harms.
// SPDX-License-Identifier: MIT
#include "lab/basis_study.h"

#include <algorithm>
#include <cmath>

#include "meshreel/io/io.h"

namespace meshreel::lab {

namespace {

/// Of the latest three series of F levels, without the first four of each, which not every predictor predicts.
double squares_of_latest(std::span<const std::int32_t> levels, std::size_t F, coding::Quantiser quantiser)
{
    double squares = 0;
    for (std::size_t j = 0; levels.size() >= 3 * F && j < 3 * F; ++j)
        if (j % F >= predict::linear_orders) squares += std::pow(quantiser.value(levels[levels.size() - 3 * F + j]), 2);
    return squares;
}

} // namespace

Result<Animation> load(const Json& row)
{
    io::LoadOptions options;
    options.mesh = row.at("mesh").get<std::string>();
    return io::load(row.at("motion").get<std::string>(), options);
}

MatrixView<const float> frames_of(const Animation& animation)
{
    return {animation.positions.data(), animation.frame_count(), 3ul * animation.vertex_count};
}

Choose motion_of(int order)
{
    return [order](std::span<const double>, coding::Quantiser) { return codecs::SeriesPredictor{order, false, {}}; };
}

BasisStudy::BasisStudy(const Animation& animation, std::size_t bases)
    : pca_(linalg::pca_of_trajectories(frames_of(animation), bases, {})), vertex_count_(animation.vertex_count)
{
    const auto projection = linalg::project(frames_of(animation), pca_.mean, pca_.basis.view(), {});
    mean_absolute_ = linalg::mean_absolute(projection.C.view());
}

codecs::BasisLaw BasisStudy::law(BasisCoding coding, double mean_step) const
{
    return codecs::basis_law(coding, mean_step, mean_absolute_);
}

codecs::BasisLaw BasisStudy::law_where(BasisCoding coding, double most,
                                       const std::function<double(const codecs::BasisLaw&)>& figure) const
{
    double fine = -60, coarse = 20; // log2 of the mean's step
    while (coarse - fine > 1e-6) {
        const double middle = (fine + coarse) / 2;
        (figure(law(coding, std::exp2(middle))) > most ? coarse : fine) = middle;
    }
    return law(coding, std::exp2(fine));
}

CodedBasis BasisStudy::code(const codecs::BasisLaw& law, const Choose& choose, std::size_t tripled) const
{
    CodedBasis coded;
    Tape tape;
    codecs::SeriesWalk<Tape> walk(tape, {}, pca_.mean.size() / 3);
    for (std::size_t i = 0; i <= bases(); ++i) {
        const std::span<const double> exact = i == 0 ? std::span<const double>(pca_.mean) : pca_.basis.row(i - 1);
        std::vector<double> t(exact.begin(), exact.end());
        const coding::Quantiser quantiser{(i == 0 ? law.mean_step : law.step(i)) * (i > 0 && i == tripled ? 3 : 1)};
        walk.code(t, quantiser, choose(exact, quantiser), 0);
        if (i == 0) tape.levels.clear();
        coded.squares += squares_of_latest(tape.levels, t.size() / 3, quantiser);
        double sum = 0;
        for (std::size_t j = 0; j < t.size(); ++j) sum += (t[j] - exact[j]) * (t[j] - exact[j]);
        coded.harm.push_back(sum);
    }
    coded.levels = std::move(tape.levels);
    return coded;
}

double BasisStudy::kg(std::span<const double> harm) const
{
    double error = pca_.energy, kept = 0;
    for (double s : pca_.singular_values) kept += s * s;
    error = std::max(error - kept, 0.0);
    // Coefficients of different components are uncorrelated and have the mean 0, so the harms add up.
    for (std::size_t i = 0; i < harm.size(); ++i)
        error += harm[i] * (i == 0 ? vertex_count_ : pca_.singular_values[i - 1] * pca_.singular_values[i - 1]);
    return 100 * std::sqrt(error / pca_.energy); // (5.2)
}

} // namespace meshreel::lab
