// SPDX-License-Identifier: BSD-3-Clause
#include "pose_graph/map/map_trajectory.h"

#include <gtest/gtest.h>

namespace plm_vins {
namespace {

// Two keyframes a second and a meter apart; the second has been corrected.
KeyframeMap TwoKeyframes() {
  KeyframeMap map;
  for (int i = 0; i < 2; ++i) {
    Keyframe& keyframe = map.keyframes.emplace_back();
    keyframe.t_ns = i * int64_t{1'000'000'000};
    keyframe.T_O_B.translation = {1.0 * i, 0, 0};
    map.graph.AddNode({0.2 * i, {1.0 * i, 0.4 * i, 0}});
  }
  return map;
}

OdometryPose At(double t, int keyframe) {
  return {static_cast<int64_t>(t * 1e9),
          {Eigen::Quaterniond(Eigen::AngleAxisd(0.5, Eigen::Vector3d::UnitX())), {t, 0, 0}},
          keyframe};
}

TEST(PoseInMap, InterpolatesBetweenCorrections) {
  const KeyframeMap map = TwoKeyframes();
  EXPECT_TRUE(PoseInMap(map, At(0, 0)).translation.isApprox(Eigen::Vector3d(0, 0, 0), 1e-9));
  // There is no step at the keyframe.
  EXPECT_TRUE(PoseInMap(map, At(1, 0)).translation.isApprox(Eigen::Vector3d(1, 0.4, 0), 1e-9));
  EXPECT_TRUE(PoseInMap(map, At(1, 1)).translation.isApprox(Eigen::Vector3d(1, 0.4, 0), 1e-9));
  const Rigid3d between = PoseInMap(map, At(0.5, 0));
  EXPECT_NEAR(between.translation.y(), 0.5 * (0 + 0.4 - 0.5 * std::sin(0.2)), 1e-9);
  EXPECT_NEAR(between.rotation.angularDistance(Eigen::AngleAxisd(0.1, Eigen::Vector3d::UnitZ()) *
                                               At(0.5, 0).T_O_B.rotation),
              0, 1e-9);
}

TEST(PoseInMap, KeepsTheLastCorrectionAfterTheLastKeyframe) {
  const Rigid3d pose = PoseInMap(TwoKeyframes(), At(2, 1));
  EXPECT_NEAR(pose.translation.y(), 0.4 + std::sin(0.2), 1e-9);
}

TEST(PoseInMap, DoesNotInterpolateAcrossWorlds) {
  KeyframeMap map = TwoKeyframes();
  map.keyframes[1].world = 1;
  EXPECT_NEAR(PoseInMap(map, At(0.5, 0)).translation.y(), 0, 1e-12);
}

}  // namespace
}  // namespace plm_vins
