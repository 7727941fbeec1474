// SPDX-License-Identifier: BSD-3-Clause
#include "map_bundle/bundle_problem.h"

#include <gtest/gtest.h>

#include "simulator/random.h"

namespace plm_vins {
namespace {

// Keyframes side by side that observe some landmarks, without IMU samples in between.
BundleState SmallBundle() {
  simulator::Random random(5);
  BundleState bundle;
  for (int i = 0; i < 3; ++i) {
    BundleKeyframe& keyframe = bundle.keyframes[i];
    keyframe.state.SetPose({Eigen::Quaterniond::Identity(), {0.3 * i, 0, 0}});
    keyframe.start = keyframe.state;
    keyframe.noise = ImuNoise{};
  }
  for (int i = 0; i < 20; ++i) {
    LandmarkTrack& landmark = bundle.landmarks.emplace_back();
    landmark.p_M = {random.Uniform(-2, 2), random.Uniform(-1, 1), random.Uniform(3, 6)};
    for (int k = 0; k < 3; ++k) {
      const Eigen::Vector3d p_C = bundle.T_M_C(k, 0).Inverse() * landmark.p_M;
      landmark.observations.push_back({k, 0, p_C.hnormalized()});
    }
  }
  return bundle;
}

TEST(BundleProblemTest, KeepsUnobservableStatesAtTheirStart) {
  BundleState bundle = SmallBundle();
  const Eigen::Vector3d shift(0.2, -0.1, 0.3);
  for (auto& [number, keyframe] : bundle.keyframes) keyframe.state.position() += shift;
  for (LandmarkTrack& landmark : bundle.landmarks) landmark.p_M += shift;
  bundle.keyframes[0].state.accel_bias() = Eigen::Vector3d::Constant(0.5);
  BundleOptions options;
  options.noise = {1e-3, 1e-3, 1e-3};

  ASSERT_TRUE(AdjustBundle(ImuHistory(), options, &bundle));

  const BundleKeyframe& first = bundle.keyframes[0];
  EXPECT_LT((first.state.position() - first.start.position()).norm(), 1e-4);
  EXPECT_LT((first.state.accel_bias() - first.start.accel_bias()).norm(), 1e-4);
}

}  // namespace
}  // namespace plm_vins
