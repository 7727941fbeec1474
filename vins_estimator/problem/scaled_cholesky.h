// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <vector>

namespace plm_vins {

// Cholesky factors of a symmetric, positive definite S, scaled to a diagonal of ones first: its
// variables differ by many orders of magnitude.
class ScaledCholesky {
 public:
  explicit ScaledCholesky(const Eigen::MatrixXd& S)
      : scale_(S.diagonal().cwiseMax(kMinDiagonal).cwiseSqrt().cwiseInverse()),
        factor_(scale_.asDiagonal() * S * scale_.asDiagonal()) {}

  // S is positive definite; else nothing below has a meaning.
  bool success() const { return factor_.info() == Eigen::Success; }

  // S^-1 b.
  Eigen::VectorXd Solve(const Eigen::VectorXd& b) const {
    return scale_.asDiagonal() * factor_.solve(scale_.asDiagonal() * b);
  }

  // These rows and columns of S^-1.
  Eigen::MatrixXd InverseBlock(const std::vector<int>& rows) const {
    Eigen::MatrixXd selection = Eigen::MatrixXd::Zero(scale_.size(), rows.size());
    for (size_t i = 0; i < rows.size(); ++i) selection(rows[i], i) = scale_[rows[i]];
    const Eigen::MatrixXd half = factor_.matrixL().solve(selection);
    return half.transpose() * half;
  }

 private:
  static constexpr double kMinDiagonal = 1e-12;

  Eigen::VectorXd scale_;
  Eigen::LLT<Eigen::MatrixXd> factor_;
};

}  // namespace plm_vins
