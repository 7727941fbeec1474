// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/geometry/point_triangulation.h"

#include <gtest/gtest.h>

#include <cmath>

#include "common/geometry/so3.h"
#include "simulator/random.h"
#include "test/testing/numeric_jacobian.h"

namespace plm_vins {
namespace {

using Eigen::Quaterniond;
using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kMinAngle = 0.01;

PosedPointObservation See(const Vector3d& p_W, const Rigid3d& T_W_C) {
  return {T_W_C, (T_W_C.Inverse() * p_W).hnormalized()};
}

PosedPointObservation SeeFrom(const Vector3d& p_W, const Vector3d& position) {
  return See(p_W, {Quaterniond::Identity(), position});
}

TEST(TriangulatePoint, FindsTheCrossingOfTwoRays) {
  const Vector3d p_W(0.5, -0.3, 4);
  const auto found =
      TriangulatePoint({SeeFrom(p_W, {0, 0, 0}), SeeFrom(p_W, {1, 0, 0})}, kMinAngle);
  ASSERT_TRUE(found);
  EXPECT_MATRIX_NEAR(*found, p_W, 1e-9);
}

TEST(TriangulatePoint, WorksForAnyCameraPoses) {
  simulator::Random random(1);
  for (int trial = 0; trial < 50; ++trial) {
    const Rigid3d T_W_A(SO3Exp(random.NormalVector3()), random.NormalVector3());
    const Vector3d p_W = T_W_A * Vector3d(random.Normal(), random.Normal(), random.Uniform(4, 8));
    std::vector<PosedPointObservation> observations;
    for (int i = 0; i < 4; ++i) {
      const Rigid3d T_A_C(SO3Exp(0.1 * random.NormalVector3()), 0.5 * random.NormalVector3());
      observations.push_back(See(p_W, T_W_A * T_A_C));
    }
    const auto found = TriangulatePoint(observations, kMinAngle);
    ASSERT_TRUE(found);
    EXPECT_MATRIX_NEAR(*found, p_W, 1e-6);
  }
}

// The error equals the propagated noise, which is the lower bound of any estimator.
TEST(TriangulatePoint, ErrorMatchesTheNoise) {
  constexpr double kNoise = 0.5 / 460;
  constexpr int kTrials = 400;
  const Vector3d p_W(0.4, 0.2, 5);
  const std::vector<Vector3d> positions = {{0, 0, 0}, {0.2, 0.1, 0}, {0.4, 0, 0.1}, {0.6, 0.1, 0}};
  Eigen::Matrix3d information = Eigen::Matrix3d::Zero();
  for (const Vector3d& position : positions) {
    const Eigen::MatrixXd J = testing::NumericJacobian(
        [&position](const Vector3d& p) { return Eigen::VectorXd(SeeFrom(p, position).xy); }, p_W);
    information += J.transpose() * J / (kNoise * kNoise);
  }
  simulator::Random random(2);
  double nees = 0;
  for (int trial = 0; trial < kTrials; ++trial) {
    std::vector<PosedPointObservation> observations;
    for (const Vector3d& position : positions) {
      observations.push_back(SeeFrom(p_W, position));
      observations.back().xy += kNoise * Vector2d(random.Normal(), random.Normal());
    }
    const auto found = TriangulatePoint(observations, kMinAngle);
    ASSERT_TRUE(found);
    const Vector3d error = *found - p_W;
    nees += error.dot(information * error) / kTrials;
  }
  EXPECT_NEAR(nees, 3.0, 0.5);  // four standard deviations of the mean
}

TEST(TriangulatePoint, RejectsRaysThatAreTooParallel) {
  const Vector3d p_W(0, 0, 100);  // subtends 0.01 rad from one meter
  const auto observations = [&p_W](double baseline) {
    return std::vector<PosedPointObservation>{SeeFrom(p_W, {0, 0, 0}),
                                              SeeFrom(p_W, {baseline, 0, 0})};
  };
  EXPECT_FALSE(TriangulatePoint(observations(0.9), kMinAngle));
  EXPECT_TRUE(TriangulatePoint(observations(1.1), kMinAngle));
  EXPECT_FALSE(TriangulatePoint(observations(0.0), kMinAngle));
  EXPECT_FALSE(TriangulatePoint({SeeFrom(p_W, {0, 0, 0})}, kMinAngle));
  EXPECT_FALSE(TriangulatePoint({}, kMinAngle));
}

TEST(TriangulatePoint, RejectsPointsBehindACamera) {
  // The rays diverge; they would intersect behind both cameras.
  const std::vector<PosedPointObservation> diverging = {
      {{Quaterniond::Identity(), {0, 0, 0}}, {-0.1, 0}},
      {{Quaterniond::Identity(), {1, 0, 0}}, {0.1, 0}},
  };
  EXPECT_FALSE(TriangulatePoint(diverging, kMinAngle));
  // A third camera looks the other way.
  const Vector3d p_W(0, 0, 5);
  const Rigid3d turned(SO3Exp({0, M_PI, 0}), Vector3d::Zero());
  EXPECT_FALSE(TriangulatePoint(
      {SeeFrom(p_W, {0, 0, 0}), SeeFrom(p_W, {1, 0, 0}), {turned, {0, 0}}}, kMinAngle));
}

}  // namespace
}  // namespace plm_vins
