// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/solver/ceres_manifold.h"

#include <ceres/solver.h>
#include <gtest/gtest.h>

#include <Eigen/Core>

#include "simulator/random.h"
#include "test/testing/numeric_jacobian.h"
#include "vins_estimator/factors/manifolds.h"
#include "vins_estimator/factors/zero_velocity_factor.h"
#include "vins_estimator/solver/factor_cost.h"

namespace plm_vins {
namespace {

using Pose = Eigen::Matrix<double, kPoseSize, 1>;
using Tangent = Eigen::Matrix<double, kPoseTangentSize, 1>;

Pose RandomPose(simulator::Random* random) {
  Pose identity, pose;
  identity << 0, 0, 0, 0, 0, 0, 1;
  Tangent delta;
  delta << random->UniformInBox({1.7, 1.7, 1.7}), random->UniformInBox({1.7, 1.7, 1.7});
  PosePlus(identity.data(), delta.data(), pose.data());
  return pose;
}

// Ceres multiplies a cost function's padded Jacobian by PlusJacobian, which must preserve the
// tangent part.
TEST(TangentManifold, CeresSolvesWithTangentJacobians) {
  simulator::Random random(6);
  Pose fixed = RandomPose(&random);
  Pose free = RandomPose(&random);
  ceres::Problem problem;
  const SamePoseFactor factor(0.1, 0.1);
  problem.AddResidualBlock(new FactorCost(&factor, {kPoseSize, kPoseSize}), nullptr, fixed.data(),
                           free.data());
  SetManifold(&problem, fixed.data(), PoseVariable());
  SetManifold(&problem, free.data(), PoseVariable());
  problem.SetParameterBlockConstant(fixed.data());
  ceres::Solver::Options options;
  options.function_tolerance = options.gradient_tolerance = options.parameter_tolerance = 1e-16;
  ceres::Solver::Summary summary;
  ceres::Solve(options, &problem, &summary);
  Tangent difference;
  PoseMinus(free.data(), fixed.data(), difference.data());
  EXPECT_MATRIX_NEAR(difference, Tangent::Zero(), 1e-9);
  EXPECT_LT(summary.iterations.size(), 15u);
}

#if PLM_CERES_HAS_MANIFOLD
TEST(TangentManifold, JacobiansAreTheStatedIdentities) {
  simulator::Random random(7);
  const Pose x = RandomPose(&random);
  const TangentManifold manifold(PoseVariable());
  Eigen::Matrix<double, 7, 6, Eigen::RowMajor> plus;
  Eigen::Matrix<double, 6, 7, Eigen::RowMajor> minus;
  ASSERT_TRUE(manifold.PlusJacobian(x.data(), plus.data()));
  ASSERT_TRUE(manifold.MinusJacobian(x.data(), minus.data()));
  EXPECT_MATRIX_NEAR(plus.topRows<6>(), (Eigen::Matrix<double, 6, 6>::Identity()), 0.0);
  EXPECT_TRUE(plus.bottomRows<1>().isZero(0.0));
  EXPECT_MATRIX_NEAR(minus * plus, (Eigen::Matrix<double, 6, 6>::Identity()), 0.0);
}
#endif

}  // namespace
}  // namespace plm_vins
