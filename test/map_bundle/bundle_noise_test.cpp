// SPDX-License-Identifier: BSD-3-Clause
#include "map_bundle/bundle_noise.h"

#include <gtest/gtest.h>

#include "simulator/random.h"

namespace plm_vins {
namespace {

constexpr ObservationNoise kConfigured = {1e-3, 1e-3, 1e-3};

// Eight keyframes with known poses that observe landmarks with noise: six by the track, of which
// the second one is by another camera, and two by loops.
BundleState BundleWith(int landmarks, double followed, double again, double matched = 1e-3) {
  simulator::Random random(3);
  BundleState bundle;
  bundle.T_B_C.push_back({Eigen::Quaterniond::Identity(), {0.1, 0, 0}});
  for (int i = 0; i < 8; ++i) {
    FrameState state;
    state.SetPose({Eigen::Quaterniond::Identity(), {0.3 * i, 0, 0}});
    bundle.keyframes[i].state = state;
  }
  for (int i = 0; i < landmarks; ++i) {
    LandmarkTrack landmark;
    landmark.p_M = {random.Uniform(-2, 2), random.Uniform(-1, 1), random.Uniform(3, 6)};
    for (int k = 0; k < 8; ++k) {
      LandmarkTrack::Observation observation;
      observation.keyframe = k;
      observation.camera = k == 1;
      observation.again = k >= 6;
      const double noise = observation.again ? again : observation.camera ? matched : followed;
      const Eigen::Vector3d p_C = bundle.T_M_C(k, observation.camera).Inverse() * landmark.p_M;
      const Eigen::Vector2d error(noise * random.Normal(), noise * random.Normal());
      observation.xy = p_C.hnormalized() + error;
      landmark.observations.push_back(observation);
    }
    bundle.landmarks.push_back(landmark);
  }
  return bundle;
}

// Landmarks are not adjusted here, so residuals of tracked corners exceed the assumption by
// 10 / 7.
TEST(BundleNoiseTest, SeparatesTheKindsOfNoise) {
  const ObservationNoise noise = EstimateNoise(BundleWith(400, 5e-4, 2e-3, 1e-3), kConfigured);
  EXPECT_NEAR(noise.followed, 5e-4 * std::sqrt(10.0 / 7.0), 3e-5);
  EXPECT_NEAR(noise.matched, 1e-3, 8e-5);
  EXPECT_NEAR(noise.again, 2e-3, 1.5e-4);
}

TEST(BundleNoiseTest, KeepsTheConfiguredNoiseWithFewResiduals) {
  const ObservationNoise noise = EstimateNoise(BundleWith(10, 5e-4, 2e-3), kConfigured);
  EXPECT_EQ(noise.followed, kConfigured.followed);
  EXPECT_EQ(noise.again, kConfigured.again);
}

TEST(BundleNoiseTest, HasBounds) {
  const ObservationNoise small = EstimateNoise(BundleWith(100, 1e-9, 1e-9), kConfigured);
  EXPECT_DOUBLE_EQ(small.followed, 1e-3 / 8);
  const ObservationNoise large = EstimateNoise(BundleWith(100, 1, 1), kConfigured);
  EXPECT_DOUBLE_EQ(large.again, 8e-3);
}

}  // namespace
}  // namespace plm_vins
