// SPDX-License-Identifier: BSD-3-Clause
#include "feature_tracker/following/corner_patch.h"

#include <gtest/gtest.h>

#include <opencv2/imgproc.hpp>
#include <vector>

#include "test/feature_tracker/textured_scene.h"

namespace plm_vins {
namespace {

const Eigen::Vector2d kCenter(180, 120);

Eigen::Matrix2d Linear(double turn, double growth, double shear) {
  Eigen::Matrix2d sheared;
  sheared << 1, shear, 0, 1;
  return growth * Eigen::Rotation2Dd(turn).toRotationMatrix() * sheared;
}

// Homography that maps the surroundings of kCenter to `pose`.
cv::Matx33d Warp(const PatchPose& pose) {
  const Eigen::Matrix2d& A = pose.linear;
  const Eigen::Vector2d t = pose.center - A * kCenter;
  return {A(0, 0), A(0, 1), t.x(), A(1, 0), A(1, 1), t.y(), 0, 0, 1};
}

class CornerPatchTest : public testing::Test {
 protected:
  TexturedScene scene_;
  CornerPatch patch_ = *CornerPatch::Cut(scene_.View(), kCenter);
};

TEST_F(CornerPatchTest, FindsAnAffineWarp) {
  const std::vector<PatchPose> poses{{Linear(0, 1, 0), {180.4, 119.3}},
                                     {Linear(0.3, 1, 0), {176.2, 126.9}},
                                     {Linear(0, 1.3, 0), {190.7, 110.1}},
                                     {Linear(0, 0.8, 0), {180.1, 120.2}},
                                     {Linear(-0.2, 1.1, 0.25), {150.6, 98.8}}};
  for (const PatchPose& truth : poses) {
    PatchPose start = truth;
    start.center += Eigen::Vector2d(0.5, -0.4);
    start.linear = Linear(0.05, 1.05, -0.05) * truth.linear;
    const auto found = patch_.Align(scene_.View(Warp(truth)), start);
    ASSERT_TRUE(found) << truth.center.transpose();
    EXPECT_LT((found->center - truth.center).norm(), 0.03) << truth.center.transpose();
    EXPECT_LT((found->linear - truth.linear).norm(), 0.02) << truth.center.transpose();
  }
}

TEST_F(CornerPatchTest, IsInvariantToGainAndOffset) {
  const PatchPose truth{Linear(0.1, 1.05, 0), {181.3, 121.8}};
  cv::Mat darker;
  scene_.View(Warp(truth)).convertTo(darker, CV_8U, 0.6, 20);
  const auto found = patch_.Align(darker, {truth.linear, {181, 122}});
  ASSERT_TRUE(found);
  EXPECT_LT((found->center - truth.center).norm(), 0.03);
}

TEST_F(CornerPatchTest, RejectsDifferentPatches) {
  EXPECT_FALSE(patch_.Align(TexturedScene(2).View(), {Linear(0, 1, 0), kCenter}));
  cv::Mat inverted = 255 - scene_.View();
  EXPECT_FALSE(patch_.Align(inverted, {Linear(0, 1, 0), kCenter}));
}

TEST_F(CornerPatchTest, RejectsLargeMotion) {
  const PatchPose start{Linear(0, 1, 0), kCenter};
  EXPECT_TRUE(patch_.Align(scene_.View(Translation(1.2, 0)), start));
  EXPECT_FALSE(patch_.Align(scene_.View(Translation(1.8, 0)), start));
}

TEST_F(CornerPatchTest, StaysInsideOfTheImage) {
  const cv::Mat view = scene_.View();
  EXPECT_TRUE(CornerPatch::Cut(view, {8.5, 8.5}));
  EXPECT_TRUE(CornerPatch::Cut(view, {kWidth - 9.5, kHeight - 9.5}));
  for (const Eigen::Vector2d& outside :
       {Eigen::Vector2d(7.5, 100), Eigen::Vector2d(100, 7.5), Eigen::Vector2d(kWidth - 8.5, 100),
        Eigen::Vector2d(100, kHeight - 8.5), Eigen::Vector2d(-50, 1e6)}) {
    EXPECT_FALSE(CornerPatch::Cut(view, outside)) << outside.transpose();
    EXPECT_FALSE(patch_.Align(view, {Linear(0, 1, 0), outside})) << outside.transpose();
  }
  // The scaled patch leaves the image, although its center is where the unscaled one would fit.
  EXPECT_FALSE(patch_.Align(view, {Linear(0, 1.6, 0), {10, 100}}));
}

TEST(CornerPatch, NeedsTextureInBothDirections) {
  EXPECT_FALSE(CornerPatch::Cut(cv::Mat(100, 100, CV_8UC1, cv::Scalar(90)), {50, 50}));
  cv::Mat edge(100, 100, CV_8UC1, cv::Scalar(90));
  edge.colRange(50, 100).setTo(200);
  EXPECT_FALSE(CornerPatch::Cut(edge, {50, 50}));
}

}  // namespace
}  // namespace plm_vins
