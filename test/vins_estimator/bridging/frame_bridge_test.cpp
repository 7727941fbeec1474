// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/bridging/frame_bridge.h"

#include <gtest/gtest.h>

namespace plm_vins {
namespace {

using Eigen::Vector3d;

constexpr int64_t kImage_ns = 50'000'000;
constexpr int kLost = 30;  // the first image after the loss

// Flies along x at 2 m/s, with an IMU that measures gravity only.
class FrameBridgeTest : public ::testing::Test {
 protected:
  static std::vector<ImuSample> ImuBefore(int image) {
    std::vector<ImuSample> samples;
    for (int i = -10; i <= 0; ++i) {
      samples.push_back({image * kImage_ns + i * kImage_ns / 10, Vector3d::Zero(), {0, 0, 9.81}});
    }
    return samples;
  }

  UncertainState Estimate(int image) const {
    UncertainState estimate;
    estimate.state.t_ns = image * kImage_ns;
    estimate.state.position() = Vector3d(way_ + 0.1 * image, 0, 0);
    estimate.state.velocity() = Vector3d(2, 0, 0);
    estimate.covariance = deviation_ * deviation_ * Matrix15d::Identity();
    Eigen::Matrix<double, 15, 1> turn = Eigen::Matrix<double, 15, 1>::Zero();
    turn.segment<3>(ImuErrorIndex::kPosition) = Vector3d::UnitZ().cross(estimate.state.position());
    turn.segment<3>(ImuErrorIndex::kRotation) = Vector3d::UnitZ();
    turn.segment<3>(ImuErrorIndex::kVelocity) = Vector3d::UnitZ().cross(estimate.state.velocity());
    estimate.covariance += heading_deviation_ * heading_deviation_ * turn * turn.transpose();
    return estimate;
  }

  void Track(int begin, int end) {
    for (int image = begin; image < end; ++image) {
      const UncertainState estimate = Estimate(image);
      bridge_.AddTracked(ImuBefore(image), estimate.state, estimate.covariance);
    }
  }

  void Lose(int begin, int end) {
    for (int image = begin; image < end; ++image) {
      bridge_.AddLost(ImuBefore(image), image * kImage_ns);
    }
  }

  const ImuNoise noise_;
  double deviation_ = 1e-3;
  double heading_deviation_ = 0;  // of the world, about its origin [rad]
  double way_ = 0;                // from the origin to the first image [m]
  FrameBridge bridge_{noise_, Vector3d(0, 0, -9.81)};
};

TEST_F(FrameBridgeTest, PropagatesFromTheLastHealthyState) {
  Track(0, kLost - 1);
  UncertainState wrong = Estimate(kLost - 1);
  wrong.state.position().y() = 5;
  bridge_.AddTracked(ImuBefore(kLost - 1), wrong.state, wrong.covariance);
  ASSERT_TRUE(bridge_.Begin("why"));
  EXPECT_TRUE(bridge_.begun());
  EXPECT_EQ(bridge_.why(), "why");
  EXPECT_NEAR(bridge_.At((kLost - 1) * kImage_ns)->state.position().y(), 0, 1e-9);
}

TEST_F(FrameBridgeTest, ReachesTheImagesAfterTheLoss) {
  Track(0, kLost);
  ASSERT_TRUE(bridge_.Begin("why"));
  Lose(kLost, 35);
  const auto last = bridge_.At(34 * kImage_ns);
  ASSERT_TRUE(last);
  EXPECT_NEAR(last->state.position().x(), 3.4, 1e-9);
  EXPECT_EQ(last->state.t_ns, 34 * kImage_ns);
  EXPECT_GT(PositionDeviation(*last), deviation_);
  EXPECT_FALSE(bridge_.At(35 * kImage_ns));
}

TEST_F(FrameBridgeTest, RejectsTooRecentOrUnknownStates) {
  EXPECT_FALSE(bridge_.Begin("why"));
  Track(0, 20);
  EXPECT_FALSE(bridge_.Begin("why"));
  bridge_.Clear();
  for (int image = 0; image < kLost; ++image) {
    bridge_.AddTracked(ImuBefore(image), Estimate(image).state, std::nullopt);
  }
  EXPECT_FALSE(bridge_.Begin("why"));
  EXPECT_FALSE(bridge_.begun());
}

TEST_F(FrameBridgeTest, ConnectsAWindowWithinItsReach) {
  Track(0, kLost);
  EXPECT_TRUE(bridge_.CanConnect(std::nullopt));
  ASSERT_TRUE(bridge_.Begin("why"));
  Lose(kLost, 40);
  EXPECT_TRUE(bridge_.CanConnect(std::nullopt));
  Lose(40, 60);  // more than two seconds after the last trustworthy estimate
  EXPECT_FALSE(bridge_.CanConnect(std::nullopt));
  EXPECT_TRUE(bridge_.CanConnect(32 * kImage_ns));
  EXPECT_FALSE(bridge_.CanConnect(55 * kImage_ns));
}

// A heading uncertainty of half a degree moves this position by meters, but is not drift.
TEST_F(FrameBridgeTest, WorksFarFromTheOrigin) {
  heading_deviation_ = 0.01;
  for (const double way : {1000.0, -1000.0}) {
    way_ = way;
    Track(0, kLost);
    ASSERT_TRUE(bridge_.Begin("why")) << way;
    Lose(kLost, 40);
    EXPECT_TRUE(bridge_.At(39 * kImage_ns)) << way;
    bridge_.Clear();
  }
}

TEST_F(FrameBridgeTest, EndsWhenThePositionIsUncertain) {
  deviation_ = 0.006;  // of the inclination as well: twelve centimeters after two seconds
  Track(0, kLost);
  ASSERT_TRUE(bridge_.Begin("why"));
  Lose(kLost, 49);
  EXPECT_TRUE(bridge_.At(32 * kImage_ns));
  EXPECT_FALSE(bridge_.At(48 * kImage_ns));
}

}  // namespace
}  // namespace plm_vins
