// SPDX-License-Identifier: BSD-3-Clause
// Checks a cost function's Jacobians against the convention of factors/manifolds.h.
#pragma once

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <cmath>
#include <string>
#include <vector>

#include "test/testing/numeric_jacobian.h"
#include "vins_estimator/factors/manifolds.h"
#include "vins_estimator/geometry/plucker.h"

namespace plm_vins::testing {

// One parameter block: size 7 is a pose, 5 with a unit quaternion a line, all others a vector
// space.
using Block = Eigen::VectorXd;
using RowMajorMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

inline bool IsLine(const Block& block) {
  return block.size() == kLineSize && std::abs(block.head<4>().norm() - 1) < 1e-6;
}

inline int TangentSize(const Block& block) {
  if (block.size() == kPoseSize) return kPoseTangentSize;
  if (IsLine(block)) return kLineTangentSize;
  return static_cast<int>(block.size());
}

inline Block BlockPlus(const Block& block, const Eigen::VectorXd& delta) {
  Block moved = block;
  if (block.size() == kPoseSize) {
    PosePlus(block.data(), delta.data(), moved.data());
  } else if (IsLine(block)) {
    LinePlus(block.data(), delta.data(), moved.data());
  } else {
    moved += delta;
  }
  return moved;
}

inline std::vector<const double*> Pointers(const std::vector<Block>& blocks) {
  std::vector<const double*> pointers;
  for (const Block& block : blocks) pointers.push_back(block.data());
  return pointers;
}

// `Cost` is a Factor or a ceres::CostFunction.
template <typename Cost>
Eigen::VectorXd Residual(const Cost& cost, const std::vector<Block>& blocks) {
  Eigen::VectorXd residual(cost.num_residuals());
  EXPECT_TRUE(cost.Evaluate(Pointers(blocks).data(), residual.data(), nullptr));
  return residual;
}

// Expects that every Jacobian of `cost`, evaluated together and separately, is the derivative
// through Plus, padded with zeros. `tolerance` is per entry.
template <typename Cost>
void ExpectTangentJacobians(const Cost& cost, const std::vector<Block>& blocks, double tolerance,
                            double step = 1e-6) {
  const int rows = cost.num_residuals();
  std::vector<RowMajorMatrix> jacobians;
  std::vector<double*> all;
  for (const Block& block : blocks) jacobians.emplace_back(rows, block.size());
  for (RowMajorMatrix& jacobian : jacobians) all.push_back(jacobian.data());
  Eigen::VectorXd residual(rows);
  ASSERT_TRUE(cost.Evaluate(Pointers(blocks).data(), residual.data(), all.data()));
  EXPECT_MATRIX_NEAR(residual, Residual(cost, blocks), 0.0);

  for (size_t i = 0; i < blocks.size(); ++i) {
    SCOPED_TRACE("parameter block " + std::to_string(i));
    const auto function = [&](const Block& block) {
      std::vector<Block> moved = blocks;
      moved[i] = block;
      return Residual(cost, moved);
    };
    const int tangent = TangentSize(blocks[i]);
    const Eigen::MatrixXd numeric = NumericJacobian(function, blocks[i], tangent, BlockPlus, step);
    EXPECT_MATRIX_NEAR(jacobians[i].leftCols(tangent), numeric, tolerance);
    EXPECT_TRUE(jacobians[i].rightCols(blocks[i].size() - tangent).isZero(0.0));

    RowMajorMatrix alone(rows, blocks[i].size());
    std::vector<double*> only(blocks.size(), nullptr);
    only[i] = alone.data();
    ASSERT_TRUE(cost.Evaluate(Pointers(blocks).data(), residual.data(), only.data()));
    EXPECT_MATRIX_NEAR(alone, jacobians[i], 0.0);
  }
}

}  // namespace plm_vins::testing
