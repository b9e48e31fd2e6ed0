/// Gram matrices summed over frames, and their eigenvalues.
// SPDX-License-Identifier: MIT
#include "meshreel/linalg/run_spectra.h"

#include <Eigen/Dense>
#include <algorithm>

namespace meshreel::linalg {

namespace {

constexpr std::size_t frames_a_gram = 64;

} // namespace

RunSpectra::RunSpectra(MatrixView<const float> frames) : frames_(frames), N_(frames.cols / 3)
{
    std::vector<double> gram(N_ * N_, 0.0);
    for (std::size_t f = 0; f < frames.rows; ++f) {
        if (f % frames_a_gram == 0) grams_.push_back(gram);
        add_frame(f, gram);
    }
}

void RunSpectra::add_frame(std::size_t f, std::vector<double>& gram) const
{
    using Columns = Eigen::Matrix<double, Eigen::Dynamic, 3>;
    const auto n = static_cast<Eigen::Index>(N_);
    Columns X = Eigen::Map<const Eigen::Matrix<float, 3, Eigen::Dynamic>>(frames_.row(f).data(), 3, n)
                    .transpose()
                    .cast<double>();
    X.rowwise() -= X.colwise().mean().eval();
    Eigen::Map<Eigen::MatrixXd>(gram.data(), n, n).noalias() += X * X.transpose();
}

std::vector<double> RunSpectra::gram_before(std::size_t f) const
{
    const std::size_t whole = std::min(f / frames_a_gram, grams_.size() - 1);
    std::vector<double> gram = grams_[whole];
    for (std::size_t g = whole * frames_a_gram; g < f; ++g) add_frame(g, gram);
    return gram;
}

std::vector<double> RunSpectra::energies(std::size_t first, std::size_t last) const
{
    const auto n = static_cast<Eigen::Index>(N_);
    std::vector<double> low = gram_before(first), high = gram_before(last);
    const Eigen::MatrixXd gram =
        Eigen::Map<Eigen::MatrixXd>(high.data(), n, n) - Eigen::Map<Eigen::MatrixXd>(low.data(), n, n);
    const Eigen::VectorXd values =
        Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(gram, Eigen::EigenvaluesOnly).eigenvalues();
    std::vector<double> energies;
    for (Eigen::Index k = n; k-- > 0;) energies.push_back(std::max(values(k), 0.0));
    return energies;
}

} // namespace meshreel::linalg
