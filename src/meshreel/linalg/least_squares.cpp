/// Least squares by a complete orthogonal decomposition, which bears columns that nearly agree.
// SPDX-License-Identifier: MIT
#include "meshreel/linalg/least_squares.h"

#include <Eigen/Dense>

namespace meshreel::linalg {

std::vector<double> least_squares(MatrixView<const double> A, std::span<const double> b)
{
    using Rows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
    const Eigen::Map<const Rows> matrix(A.data, static_cast<Eigen::Index>(A.rows), static_cast<Eigen::Index>(A.cols));
    const Eigen::Map<const Eigen::VectorXd> right(b.data(), static_cast<Eigen::Index>(b.size()));
    const Eigen::VectorXd x = Eigen::MatrixXd(matrix).completeOrthogonalDecomposition().solve(right);
    return {x.data(), x.data() + x.size()};
}

} // namespace meshreel::linalg
