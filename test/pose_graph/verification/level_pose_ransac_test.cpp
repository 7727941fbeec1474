// SPDX-License-Identifier: BSD-3-Clause
#include "pose_graph/verification/level_pose_ransac.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "simulator/random.h"
#include "test/pose_graph/two_visits.h"

namespace plm_vins {
namespace {

using testing::kFocalLength;

double Difference(const LevelTransform& a, const LevelTransform& b) {
  return (a.translation - b.translation).norm() + std::abs(WrapAngle(a.yaw - b.yaw));
}

LevelTransform RandomPose(simulator::Random* random) {
  return {random->Uniform(-M_PI, M_PI), random->UniformInBox({2, 2, 2})};
}

TEST(SolveTwoPoints, FindsTheTruth) {
  simulator::Random random(1);
  for (int i = 0; i < 200; ++i) {
    const LevelTransform T_O_G = RandomPose(&random);
    const Eigen::Vector3d p_G1 = random.UniformInBox({5, 5, 5});
    const Eigen::Vector3d p_G2 = random.UniformInBox({5, 5, 5});
    // The lengths of the rays do not matter.
    const auto poses = SolveTwoPoints(0.3 * p_G1, T_O_G * p_G1, 2.0 * p_G2, T_O_G * p_G2);
    double best = std::numeric_limits<double>::infinity();
    for (const LevelTransform& pose : poses) best = std::min(best, Difference(pose, T_O_G));
    EXPECT_LT(best, 1e-6) << i;
    EXPECT_LE(poses.size(), 2u);
  }
}

TEST(SolveTwoPoints, HasNoSolutionForContradictingHeights) {
  // Both are observed at the height of the camera, but one is higher than the other.
  EXPECT_TRUE(SolveTwoPoints({1, 0, 0}, {3, 0, 0}, {0, 1, 0}, {0, 3, 1}).empty());
}

// Observations from a pose, a share of which is wrong.
std::vector<SeenPoint> See(const LevelTransform& T_O_G, const Eigen::Quaterniond& R_G_C, int count,
                           double wrong_share, double noise, simulator::Random* random) {
  std::vector<SeenPoint> observations;
  for (int i = 0; i < count; ++i) {
    const Eigen::Vector3d p_C(random->Uniform(-2, 2), random->Uniform(-1, 1),
                              random->Uniform(2, 6));
    Eigen::Vector2d xy = p_C.hnormalized();
    xy += noise * Eigen::Vector2d(random->Normal(), random->Normal());
    if (i < wrong_share * count) xy = {random->Uniform(-0.8, 0.8), random->Uniform(-0.5, 0.5)};
    observations.push_back({T_O_G * (R_G_C * p_C), xy});
  }
  return observations;
}

class FindLevelPoseTest : public ::testing::Test {
 protected:
  simulator::Random random_{3};
  LevelTransform T_O_G_ = RandomPose(&random_);
  Eigen::Quaterniond R_G_C_ =
      testing::LookingAhead().rotation *
      Eigen::Quaterniond(Eigen::AngleAxisd(0.3, Eigen::Vector3d(0.6, 0, 0.8)));
};

TEST_F(FindLevelPoseTest, ToleratesSixtyPercentOutliers) {
  const auto observations = See(T_O_G_, R_G_C_, 100, 0.6, 0.5 / kFocalLength, &random_);
  const auto pose = FindLevelPose(LevelPoseRansacOptions(kFocalLength), observations, R_G_C_);
  ASSERT_TRUE(pose);
  EXPECT_LT(Difference(pose->T_O_G, T_O_G_), 0.1);
  EXPECT_GE(pose->inliers.size(), 36u);
  EXPECT_GE(pose->inliers.front(), 60u - 6);  // hardly any of the wrong ones
}

TEST_F(FindLevelPoseTest, ReturnsAllInliers) {
  const auto observations = See(T_O_G_, R_G_C_, 60, 0.5, 2.0 / kFocalLength, &random_);
  const LevelPoseRansacOptions options(kFocalLength);
  const auto pose = FindLevelPose(options, observations, R_G_C_);
  ASSERT_TRUE(pose);
  const Viewpoint viewpoint(pose->T_O_G, R_G_C_);
  std::vector<size_t> agree;
  for (size_t i = 0; i < observations.size(); ++i) {
    if (viewpoint.Error(observations[i]) <= options.max_error) agree.push_back(i);
  }
  EXPECT_EQ(pose->inliers, agree);
}

TEST_F(FindLevelPoseTest, NeedsMoreThanOneObservation) {
  const auto observations = See(T_O_G_, R_G_C_, 1, 0, 0, &random_);
  EXPECT_FALSE(FindLevelPose(LevelPoseRansacOptions(kFocalLength), observations, R_G_C_));
}

TEST_F(FindLevelPoseTest, NeedsMoreThanTwoInliers) {
  const auto observations = See(T_O_G_, R_G_C_, 2, 0, 0, &random_);
  EXPECT_FALSE(FindLevelPose(LevelPoseRansacOptions(kFocalLength), observations, R_G_C_));
}

}  // namespace
}  // namespace plm_vins
