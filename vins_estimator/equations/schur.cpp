// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/equations/schur.h"

#include <Eigen/Cholesky>

namespace plm_vins {

Quadratic MarginalizeFirst(const Quadratic& quadratic, int count) {
  const int rest = static_cast<int>(quadratic.b.size()) - count;
  // Eigen's solver accesses the first element, so empty systems are handled separately.
  if (count == 0) return quadratic;
  if (rest == 0) return {Eigen::MatrixXd(0, 0), Eigen::VectorXd(0)};
  const auto H_mr = quadratic.H.topRightCorner(count, rest);

  // Scaled to a unit diagonal: meters, radians and biases differ by many orders of magnitude.
  const Eigen::VectorXd diagonal = quadratic.H.diagonal().head(count);
  const Eigen::VectorXd scale =
      (diagonal.array() > 0).select(diagonal.array().max(1e-300).rsqrt(), 0.0);
  const Eigen::MatrixXd H_mm =
      scale.asDiagonal() * quadratic.H.topLeftCorner(count, count) * scale.asDiagonal();
  const Eigen::LDLT<Eigen::MatrixXd> factor(H_mm);
  const Eigen::MatrixXd scaled_H_mr = scale.asDiagonal() * H_mr;
  const Eigen::VectorXd scaled_b_m = scale.asDiagonal() * quadratic.b.head(count);

  Quadratic result;
  result.H = quadratic.H.bottomRightCorner(rest, rest) -
             scaled_H_mr.transpose() * factor.solve(scaled_H_mr);
  result.H = 0.5 * (result.H + result.H.transpose()).eval();
  result.b = quadratic.b.tail(rest) - scaled_H_mr.transpose() * factor.solve(scaled_b_m);
  return result;
}

Quadratic Permute(const Quadratic& quadratic, const std::vector<int>& new_position) {
  const int size = static_cast<int>(quadratic.b.size());
  Quadratic result{Eigen::MatrixXd(size, size), Eigen::VectorXd(size)};
  for (int j = 0; j < size; ++j) {
    for (int i = 0; i < size; ++i) {
      result.H(new_position[i], new_position[j]) = quadratic.H(i, j);
    }
    result.b[new_position[j]] = quadratic.b[j];
  }
  return result;
}

}  // namespace plm_vins
