// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <opencv2/imgproc.hpp>

#include "pose_graph/keyframes/keyframe.h"
#include "pose_graph/keyframes/keyframe_maker.h"
#include "pose_graph/keyframes/keyframe_policy.h"
#include "pose_graph/keyframes/odometry_noise.h"
#include "test/pose_graph/two_visits.h"

namespace plm_vins {
namespace {

constexpr double kDegree = M_PI / 180;

TEST(KeyframeSpacing, NeedsTranslationRotationOrTime) {
  const auto is_apart = [](double distance, double degrees, double seconds) {
    const Rigid3d T_O_B(
        Eigen::Quaterniond(Eigen::AngleAxisd(degrees * kDegree, Eigen::Vector3d::UnitY())),
        {0, distance, 0});
    return IsApart(KeyframeSpacing(), 0, Rigid3d(), ToNanoseconds(seconds), T_O_B);
  };
  EXPECT_FALSE(is_apart(0.19, 11, 1.9));
  EXPECT_TRUE(is_apart(0.21, 0, 0.1));
  EXPECT_TRUE(is_apart(0, 12, 0.1));
  EXPECT_TRUE(is_apart(0, 0, 2.1));
}

TEST(NumbersAround, StayInOneWorldAndInRange) {
  std::vector<Keyframe> keyframes(8);
  for (int i = 5; i < 8; ++i) keyframes[i].world = 1;
  EXPECT_EQ(NumbersAround(keyframes, 1, 2), std::vector<int>({0, 1, 2, 3}));
  EXPECT_EQ(NumbersAround(keyframes, 4, 2), std::vector<int>({2, 3, 4}));
  EXPECT_EQ(NumbersAround(keyframes, 6, 2), std::vector<int>({5, 6, 7}));
}

TEST(StepCovariance, IsTheGrowthOfThePoseCovariance) {
  const Matrix4d growth = Vector4d(0.5, 0, 0, 0.2).asDiagonal();
  const Matrix4d step = StepCovariance(OdometryNoise(), Eigen::Vector3d::Zero(), growth);
  EXPECT_NEAR(step(0, 0), 0.5, 1e-12);
  EXPECT_NEAR(step(3, 3), 0.2, 1e-12);
}

// A decrease of the pose covariance stems from a correction of that size.
TEST(StepCovariance, HasTheCorrectionsOfOdometry) {
  const Matrix4d growth = Vector4d(-0.4, 0, 0, -0.1).asDiagonal();
  const Matrix4d step = StepCovariance(OdometryNoise(), Eigen::Vector3d::Zero(), growth);
  EXPECT_NEAR(step(0, 0), 0.4, 1e-12);
  EXPECT_NEAR(step(3, 3), 0.1, 1e-12);
}

TEST(LevelCovariance, HasYawAboutTheVerticalOfABodyThatIsNotLevel) {
  OdometryFrame frame;
  frame.T_O_B.rotation = Eigen::AngleAxisd(M_PI / 2, Eigen::Vector3d::UnitY());  // x is down
  frame.covariance.diagonal() << 0, 0, 0.2, 0.3, 0, 0;
  frame.covariance(2, 3) = frame.covariance(3, 2) = 0.1;
  const Matrix4d covariance = LevelCovariance(frame.T_O_B, frame.covariance);
  EXPECT_NEAR(covariance(2, 2), 0.2, 1e-9);
  EXPECT_NEAR(covariance(3, 3), 0.3, 1e-9);
  EXPECT_NEAR(covariance(2, 3), -0.1, 1e-9);  // x of B is opposite to z of O
}

TEST(StepCovariance, HasALowerBoundByPathLength) {
  const OdometryNoise noise;
  const double expected = noise.position_floor + 3 * noise.position_rate;
  EXPECT_NEAR(StepCovariance(noise, {0, 3, 0}, Matrix4d::Zero())(2, 2), expected * expected, 1e-12);
}

// Random gray levels, smoothed by the resize only.
cv::Mat Noise() {
  cv::Mat small(60, 94, CV_8UC1);
  cv::RNG random(3);
  random.fill(small, cv::RNG::UNIFORM, 0, 256);
  cv::Mat gray;
  cv::resize(small, gray, cv::Size(752, 480), 0, 0, cv::INTER_CUBIC);
  return gray;
}

TEST(MakeKeyframe, DescribesFollowedCornersAndFillsUp) {
  const std::shared_ptr<const CameraModel> camera = testing::SimpleCamera();
  OdometryFrame frame;
  frame.T_B_C = {testing::LookingAhead()};
  frame.images[0].gray = Noise();
  TrackedCorner corner;
  corner.observation.id = 17;
  corner.observation.uv_px = {300, 200};
  corner.p_O = Eigen::Vector3d(4, 1, 2);
  frame.corners.push_back(corner);
  corner.observation.uv_px = {-2, 200};  // a predicted track may be outside
  frame.corners.push_back(corner);
  const Keyframe keyframe = MakeKeyframe(CornerSelectionOptions(), {camera}, frame);
  ASSERT_GT(keyframe.corners.size(), 100u);
  EXPECT_LE(keyframe.corners.size(), 300u);
  EXPECT_EQ(keyframe.corners[0].track, 17);
  EXPECT_EQ(*keyframe.corners[0].p_O, Eigen::Vector3f(4, 1, 2));
  EXPECT_EQ(keyframe.corners[1].track, -1);
  EXPECT_FALSE(keyframe.corners[1].p_O);
}

TEST(MakeKeyframe, UsesRefinedIntrinsicsForAllRays) {
  const std::shared_ptr<const CameraModel> camera = testing::SimpleCamera();
  OdometryFrame frame;
  frame.T_B_C = {testing::LookingAhead()};
  frame.images[0].gray = Noise();
  TrackedCorner& corner = frame.corners.emplace_back();
  corner.observation.uv_px = {300, 200};
  corner.observation.xy = *camera->Unproject(corner.observation.uv_px);
  const Eigen::Vector2d start_px(100, 50), end_px(400, 420);
  TrackedSegment& segment = frame.segments.emplace_back();
  segment.observation.start = *camera->Unproject(start_px);
  segment.observation.end = *camera->Unproject(end_px);
  frame.refined = {camera->parameters()};
  frame.refined[0].fx *= 1.01;
  frame.refined[0].cy += 3;
  const auto refined = CameraModel::Create(frame.refined[0]);

  const Keyframe keyframe = MakeKeyframe(CornerSelectionOptions(), {camera}, frame);
  ASSERT_GT(keyframe.corners.size(), 100u);
  for (const DescribedCorner& seen : keyframe.corners) {
    const Eigen::Vector2d ray = *refined->Unproject(seen.uv_px.cast<double>());
    EXPECT_LT((seen.xy.cast<double>() - ray).norm(), 1e-6);
  }
  EXPECT_LT((keyframe.segments[0].observation.start - *refined->Unproject(start_px)).norm(), 1e-9);
  EXPECT_LT((keyframe.segments[0].observation.end - *refined->Unproject(end_px)).norm(), 1e-9);
}

}  // namespace
}  // namespace plm_vins
