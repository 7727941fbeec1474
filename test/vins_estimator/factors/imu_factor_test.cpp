// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/factors/imu_factor.h"

#include <gtest/gtest.h>

#include "common/geometry/so3.h"
#include "simulator/imu_simulator.h"
#include "simulator/random.h"
#include "test/testing/cost_function_check.h"

namespace plm_vins {
namespace {

using Eigen::Vector3d;
using testing::Block;

const Vector3d kGravity_W(0, 0, -9.81);

Preintegration Integrate(const std::vector<ImuSample>& samples, const ImuBias& bias) {
  Preintegration preintegration(ImuNoise(), bias);
  for (const ImuSample& sample : samples) preintegration.Append(sample);
  return preintegration;
}

// Two seconds of noise-free flight with known biases; long enough for large rotations.
class ImuFactorTest : public ::testing::Test {
 protected:
  static constexpr double kStart = 3.0, kEnd = 5.0;  // [s]

  ImuFactorTest() : trajectory_(Options()), bias_{{0.1, -0.2, 0.05}, {0.01, 0.02, -0.03}} {
    simulator::ImuSimulationOptions options;
    options.add_noise = false;
    options.rate_hz = 1000;
    options.initial_bias = bias_;
    for (const ImuSample& sample : simulator::SimulateImu(trajectory_, options).samples) {
      const double t = ToSeconds(sample.t_ns);
      if (t > kStart - 1e-6 && t < kEnd + 1e-6) samples_.push_back(sample);
    }
  }

  static simulator::TrajectoryOptions Options() {
    simulator::TrajectoryOptions options;
    options.motion = simulator::Motion::kFast;
    options.duration = 6.0;
    return options;
  }

  FrameState TrueState(double t) const {
    const simulator::BodyState body = trajectory_.At(t);
    FrameState state;
    state.t_ns = ToNanoseconds(t);
    state.SetPose(body.T_W_B);
    state.velocity() = body.v_W;
    state.SetBias(bias_);
    return state;
  }

  // The parameter blocks in the order of the factor.
  static std::vector<Block> Blocks(const FrameState& i, const FrameState& j) {
    return {Eigen::Map<const Block>(i.pose.data(), 7), Eigen::Map<const Block>(i.motion.data(), 9),
            Eigen::Map<const Block>(j.pose.data(), 7), Eigen::Map<const Block>(j.motion.data(), 9)};
  }

  simulator::Trajectory trajectory_;
  ImuBias bias_;
  std::vector<ImuSample> samples_;
};

TEST_F(ImuFactorTest, VanishesAtTheTruth) {
  const Preintegration preintegration = Integrate(samples_, bias_);
  const Vector15d residual =
      ImuResidual(preintegration, kGravity_W, TrueState(kStart), TrueState(kEnd), nullptr);
  EXPECT_LT(residual.norm(), 1e-4);
  const ImuFactor factor(&preintegration, kGravity_W);
  EXPECT_LT(testing::Residual(factor, Blocks(TrueState(kStart), TrueState(kEnd))).norm(), 0.1);
}

TEST_F(ImuFactorTest, VanishesAtThePredictionForAnyBias) {
  const Preintegration preintegration = Integrate(samples_, ImuBias());
  FrameState start = TrueState(kStart);
  start.SetBias({{0.02, 0.01, -0.03}, {0.002, -0.001, 0.003}});
  const FrameState end = preintegration.Predict(start, kGravity_W);
  EXPECT_LT(ImuResidual(preintegration, kGravity_W, start, end, nullptr).norm(), 1e-12);
}

TEST_F(ImuFactorTest, RowsAreTheStatedDifferences) {
  const Preintegration preintegration = Integrate(samples_, bias_);
  const FrameState start = TrueState(kStart);
  FrameState end = preintegration.Predict(start, kGravity_W);
  const Vector3d dp(0.1, 0.2, 0.3), dv(-0.3, 0.1, 0.2), dba(1, 2, 3), dbg(4, 5, 6);
  const Vector3d angle(0.3, -0.2, 0.1);
  end.position() += start.rotation() * dp;
  end.rotation() = end.rotation() * SO3Exp(angle);
  end.velocity() += start.rotation() * dv;
  end.accel_bias() += dba;
  end.gyro_bias() += dbg;
  Vector15d expected;
  expected << dp, angle, dv, dba, dbg;
  EXPECT_MATRIX_NEAR(ImuResidual(preintegration, kGravity_W, start, end, nullptr), expected, 1e-12);
}

TEST_F(ImuFactorTest, JacobiansAreExactFarFromTheTruth) {
  // The bias of linearization differs from the states', and residuals are far from zero in every
  // row.
  ImuNoise noise;  // of order one, like the whitened entries
  noise.gyro_density = noise.accel_density = noise.gyro_walk = noise.accel_walk = 1.0;
  Preintegration preintegration(noise, {{0.3, 0.1, 0.2}, {0.1, -0.1, 0.05}});
  for (const ImuSample& sample : samples_) preintegration.Append(sample);
  const ImuFactor factor(&preintegration, kGravity_W);
  simulator::Random random(1);
  for (int trial = 0; trial < 10; ++trial) {
    std::vector<Block> blocks = Blocks(TrueState(kStart), TrueState(kEnd));
    for (Block& block : blocks) {
      Block delta(testing::TangentSize(block));
      for (Eigen::Index k = 0; k < delta.size(); ++k) delta[k] = 0.3 * random.Normal();
      block = testing::BlockPlus(block, delta);
    }
    testing::ExpectTangentJacobians(factor, blocks, 2e-7);
  }
}

TEST_F(ImuFactorTest, IsWhitenedByThePreintegratedCovariance) {
  const Preintegration preintegration = Integrate(samples_, bias_);
  const ImuFactor factor(&preintegration, kGravity_W);
  const FrameState start = TrueState(kStart);
  FrameState end = TrueState(kEnd);
  end.position() += Vector3d(0.01, 0, 0);
  end.gyro_bias() += Vector3d(0, 1e-4, 0);
  const Vector15d residual = ImuResidual(preintegration, kGravity_W, start, end, nullptr);
  const double mahalanobis = residual.dot(preintegration.Covariance().ldlt().solve(residual));
  EXPECT_NEAR(testing::Residual(factor, Blocks(start, end)).squaredNorm() / mahalanobis, 1.0, 1e-6);
}

}  // namespace
}  // namespace plm_vins
