// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/geometry/line_fit.h"

#include <gtest/gtest.h>

#include "common/geometry/so3.h"
#include "simulator/random.h"
#include "test/testing/numeric_jacobian.h"

namespace plm_vins {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using Eigen::Vector4d;

constexpr double kNoise = 1.0 / 460.0;

// A line four meters ahead of cameras that move sideways, observed with noise at its endpoints.
struct Scene {
  explicit Scene(uint64_t seed, double noise = kNoise) {
    simulator::Random random(seed);
    start_W = {-1, 0.3 * random.Normal(), 4};
    end_W = {1, 0.5 * random.Normal(), 4 + 0.5 * random.Normal()};
    for (int i = 0; i < 8; ++i) {
      const Rigid3d T_W_C(SO3Exp(0.05 * random.NormalVector3()),
                          Vector3d(0.1 * i, 0.1 * i, 0) + 0.05 * random.NormalVector3());
      const auto see = [&](const Vector3d& p_W) -> Vector2d {
        const Vector2d error(random.Normal(), random.Normal());
        return (T_W_C.Inverse() * p_W).hnormalized() + noise * error;
      };
      observations.push_back({T_W_C, {see(start_W), see(end_W)}});
    }
    truth = ToOrthonormal(observations.front().T_W_C.Inverse() * LineThrough(start_W, end_W));
  }

  double DirectionError(const OrthonormalLine& line) const {
    const PluckerLine line_W = observations.front().T_W_C * ToPlucker(line.data());
    const Vector3d direction = (end_W - start_W).normalized();
    return std::asin(line_W.direction.normalized().cross(direction).norm());
  }

  Vector3d start_W, end_W;
  std::vector<PosedLineObservation> observations;
  OrthonormalLine truth;
};

TEST(EvaluateLine, IsZeroAtTheTruth) {
  const Scene scene(1, /*noise=*/0);
  const auto fit = EvaluateLine(scene.observations, kNoise, scene.truth);
  ASSERT_TRUE(fit);
  EXPECT_NEAR(fit->cost, 0, 1e-9);
  EXPECT_NEAR(fit->gradient.norm(), 0, 1e-6);
}

TEST(EvaluateLine, GivesTheGradientOfTheCost) {
  const Scene scene(2);
  const auto half_cost = [&](const Vector4d& delta) {
    OrthonormalLine moved;
    LinePlus(scene.truth.data(), delta.data(), moved.data());
    const double cost = EvaluateLine(scene.observations, kNoise, moved)->cost;
    return Eigen::Matrix<double, 1, 1>(0.5 * cost);
  };
  const Vector4d zero = Vector4d::Zero();
  const Eigen::MatrixXd numeric = testing::NumericJacobian(half_cost, zero);
  const auto fit = EvaluateLine(scene.observations, kNoise, scene.truth);
  EXPECT_MATRIX_NEAR(fit->gradient, numeric.transpose(), 1e-4 * numeric.norm());
}

TEST(EvaluateLine, FailsWhereTheLinePassesThroughACamera) {
  Scene scene(3);
  const Vector3d camera = scene.observations[1].T_W_C.translation;
  const Rigid3d T_C0_W = scene.observations[0].T_W_C.Inverse();
  const PluckerLine line = T_C0_W * LineThrough(camera, camera + Vector3d::UnitX());
  const auto fit = EvaluateLine(scene.observations, kNoise, ToOrthonormal(line));
  EXPECT_TRUE(!fit || fit->cost > 1e3);
}

TEST(FitLine, FindsTheTruthFromNearby) {
  for (uint64_t seed = 1; seed <= 20; ++seed) {
    const Scene scene(seed, /*noise=*/0);
    simulator::Random random(seed);
    Vector4d delta(random.Normal(), random.Normal(), random.Normal(), random.Normal());
    delta *= 0.03;
    OrthonormalLine initial;
    LinePlus(scene.truth.data(), delta.data(), initial.data());
    const auto fit = FitLine(scene.observations, kNoise, initial);
    ASSERT_TRUE(fit);
    EXPECT_NEAR(fit->cost, 0, 1e-6);
    EXPECT_NEAR(scene.DirectionError(fit->line), 0, 1e-6);
  }
}

// Over many noisy lines, the cost equals its degrees of freedom, and the direction errors agree
// with their standard deviation, which bounds both components; one is by far the larger.
TEST(FitLine, StatesItsNoise) {
  double cost = 0, squared_ratio = 0;
  constexpr int kScenes = 400;
  for (uint64_t seed = 1; seed <= kScenes; ++seed) {
    const Scene scene(seed);
    const auto fit = FitLine(scene.observations, kNoise, scene.truth);
    ASSERT_TRUE(fit);
    cost += fit->cost / kScenes;
    const double ratio = scene.DirectionError(fit->line) / DirectionDeviation(*fit);
    squared_ratio += ratio * ratio / kScenes;
  }
  EXPECT_NEAR(cost, 2 * 8 - 4, 1.0);
  EXPECT_GT(squared_ratio, 0.8);
  EXPECT_LT(squared_ratio, 1.4);
}

TEST(DirectionDeviation, IsLargeForASingleObservation) {
  Scene scene(1);
  scene.observations.resize(1);
  const auto fit = EvaluateLine(scene.observations, kNoise, scene.truth);
  EXPECT_GT(DirectionDeviation(*fit), 0.5);
  EXPECT_LE(DirectionDeviation(*fit), 1.0);
}

}  // namespace
}  // namespace plm_vins
