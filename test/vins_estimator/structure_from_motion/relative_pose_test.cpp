// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/structure_from_motion/relative_pose.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/geometry/so3.h"
#include "simulator/random.h"
#include "test/vins_estimator/initialization/simulated_frames.h"

namespace plm_vins {
namespace {

using ::testing::HasSubstr;

using Eigen::Quaterniond;
using Eigen::Vector3d;

constexpr double kNoise = 0.5 / 460;

// Two images of points 2 to 8 m away, or on a plane 5 m away.
struct TwoViews {
  Quaterniond R_now_then;
  Vector3d t_now_then;

  std::vector<Correspondence> Observe(int count, double noise, double outlier_ratio, uint64_t seed,
                                      bool planar = false) const {
    simulator::Random random(seed);
    std::vector<Correspondence> result;
    while (static_cast<int>(result.size()) < count) {
      const Eigen::Vector2d xy(random.Uniform(-0.7, 0.7), random.Uniform(-0.5, 0.5));
      const double depth = planar ? 5 : random.Uniform(2, 8);
      const Vector3d p_C1 = R_now_then * (depth * xy.homogeneous()) + t_now_then;
      Correspondence c{xy, p_C1.hnormalized()};
      c.xy0 += noise * Eigen::Vector2d(random.Normal(), random.Normal());
      c.xy1 += noise * Eigen::Vector2d(random.Normal(), random.Normal());
      if (random.Uniform(0, 1) < outlier_ratio) {
        c.xy1 += Eigen::Vector2d(random.Uniform(-0.2, 0.2), random.Uniform(-0.2, 0.2));
      }
      result.push_back(c);
    }
    return result;
  }
};

// Typical motion of a quarter of a second of hovering and rotating.
const TwoViews kTwoViews{SO3Exp({0.05, -0.1, 0.03}), {0.3, -0.05, 0.1}};
// The gyroscope's rotation, with the error of a bias of 0.1 rad/s over that time.
const Quaterniond kGyro = SO3Exp({0.02, -0.01, 0.01}) * kTwoViews.R_now_then;

TEST(RelativePoseTest, FindsRotationAndDirectionUnderNoiseAndOutliers) {
  for (uint64_t seed = 1; seed <= 20; ++seed) {
    std::string reason;
    const auto pose =
        EstimateRelativePose(kTwoViews.Observe(120, kNoise, 0.2, seed), kGyro, kNoise, &reason);
    ASSERT_TRUE(pose) << "seed " << seed << ": " << reason;
    EXPECT_LT(pose->R_now_then.angularDistance(kTwoViews.R_now_then), 0.004) << "seed " << seed;
    EXPECT_LT(testing::AngleBetween(pose->t_now_then, kTwoViews.t_now_then), 0.05)
        << "seed " << seed;
    EXPECT_GT(pose->num_inliers, 80) << "seed " << seed;
  }
}

TEST(RelativePoseTest, ExactPointsGiveThePose) {
  std::string reason;
  const auto pose = EstimateRelativePose(kTwoViews.Observe(60, 0, 0, 1), kGyro, kNoise, &reason);
  ASSERT_TRUE(pose) << reason;
  // The remaining error is caused by the gyroscope prior.
  EXPECT_LT(pose->R_now_then.angularDistance(kTwoViews.R_now_then), 1e-4);
  EXPECT_LT(testing::AngleBetween(pose->t_now_then, kTwoViews.t_now_then), 1e-4);
  EXPECT_NEAR(pose->t_now_then.norm(), 1, 1e-12);
}

TEST(RelativePoseTest, StatedInformationMatchesTheSpread) {
  double normalized = 0;
  constexpr int kRuns = 50;
  for (uint64_t seed = 1; seed <= kRuns; ++seed) {
    std::string reason;
    const auto pose =
        EstimateRelativePose(kTwoViews.Observe(120, kNoise, 0, seed), kGyro, kNoise, &reason);
    ASSERT_TRUE(pose) << reason;
    const Vector3d error = SO3Log(pose->R_now_then * kTwoViews.R_now_then.conjugate());
    normalized += error.dot(pose->rotation_information * error) / 3 / kRuns;
  }
  // Cauchy weights make the estimated information slightly too small.
  EXPECT_GT(normalized, 0.3);
  EXPECT_LT(normalized, 1.5);
}

TEST(RelativePoseTest, PureRotationStillGivesTheRotation) {
  const TwoViews turning{kTwoViews.R_now_then, Vector3d::Zero()};
  std::string reason;
  const auto pose =
      EstimateRelativePose(turning.Observe(120, kNoise, 0, 1), kGyro, kNoise, &reason);
  ASSERT_TRUE(pose) << reason;
  EXPECT_LT(pose->R_now_then.angularDistance(turning.R_now_then), 0.005);
}

// A plane has two solutions, and with noise the wrong one may fit better; the gyroscope decides.
TEST(RelativePoseTest, GyroResolvesThePlanarAmbiguity) {
  constexpr int kRuns = 40;
  int right = 0;
  for (int seed = 1; seed <= kRuns; ++seed) {
    std::string reason;
    const auto pose = EstimateRelativePose(kTwoViews.Observe(120, kNoise, 0, seed, /*planar=*/true),
                                           kGyro, kNoise, &reason);
    ASSERT_TRUE(pose) << reason;
    right += pose->R_now_then.angularDistance(kTwoViews.R_now_then) < 0.03;
  }
  EXPECT_EQ(right, kRuns);
}

TEST(RelativePoseTest, RejectsFewOrUnrelatedPointsWithReason) {
  std::string reason;
  EXPECT_FALSE(EstimateRelativePose(kTwoViews.Observe(14, 0, 0, 1), kGyro, kNoise, &reason));
  EXPECT_THAT(reason, HasSubstr("14 of 15"));
  EXPECT_FALSE(EstimateRelativePose(kTwoViews.Observe(100, 0.2, 1.0, 1), kGyro, kNoise, &reason));
  EXPECT_THAT(reason, HasSubstr("inliers"));
}

TEST(RelativePoseTest, ParallaxIgnoresRotation) {
  const auto points = TwoViews{kTwoViews.R_now_then, Vector3d::Zero()}.Observe(50, 0, 0, 1);
  EXPECT_NEAR(MedianParallax(points, kTwoViews.R_now_then), 0, 1e-12);
  EXPECT_GT(MedianParallax(points, Quaterniond::Identity()), 0.05);
  EXPECT_EQ(MedianParallax({}, kTwoViews.R_now_then), 0);
}

}  // namespace
}  // namespace plm_vins
