// SPDX-License-Identifier: BSD-3-Clause
#include "feature_tracker/detection/ray_mask.h"

#include <gtest/gtest.h>

#include "test/feature_tracker/textured_scene.h"

namespace plm_vins {
namespace {

// Barrel distortion with k1 alone folds at a distorted radius of 0.54, 125 px from the center.
std::unique_ptr<const CameraModel> FoldedCamera() {
  CameraParameters parameters = TestCameraParameters();
  parameters.distortion[0] = -0.5;
  return CameraModel::Create(parameters);
}

TEST(RayMask, KeepsTheMaskIfAllPixelsHaveRays) {
  EXPECT_TRUE(WithinRays(*TestCamera(), {}).empty());
  const cv::Mat mask(kHeight, kWidth, CV_8UC1, cv::Scalar(255));
  EXPECT_EQ(WithinRays(*TestCamera(), mask).data, mask.data);
}

TEST(RayMask, MasksPixelsWithoutARay) {
  const auto camera = FoldedCamera();
  const cv::Mat mask = WithinRays(*camera, {});
  ASSERT_EQ(mask.size(), cv::Size(kWidth, kHeight));
  int with_ray = 0, allowed = 0;
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      const bool has_ray = RayOf(*camera, {x, y}).has_value();
      const bool is_allowed = mask.at<uint8_t>(y, x) != 0;
      EXPECT_TRUE(has_ray || !is_allowed) << x << " " << y;
      with_ray += has_ray ? 1 : 0;
      allowed += is_allowed ? 1 : 0;
    }
  }
  EXPECT_LT(with_ray, 0.6 * kWidth * kHeight);
  EXPECT_GT(allowed, 0.95 * with_ray);
}

TEST(RayMask, KeepsWhatTheMaskForbids) {
  cv::Mat mask(kHeight, kWidth, CV_8UC1, cv::Scalar(255));
  mask.colRange(0, kWidth / 2).setTo(0);
  const cv::Mat both = WithinRays(*FoldedCamera(), mask);
  EXPECT_EQ(cv::countNonZero(both.colRange(0, kWidth / 2)), 0);
  EXPECT_EQ(cv::countNonZero(both.colRange(kWidth / 2, kWidth)),
            cv::countNonZero(WithinRays(*FoldedCamera(), {}).colRange(kWidth / 2, kWidth)));
}

// The ray of column 271 of this fisheye is perpendicular to the optical axis.
TEST(RayMask, MasksRaysCloseToTheImagePlane) {
  CameraParameters parameters = TestCameraParameters();
  parameters.model = CameraParameters::Model::kPinholeEquidistant;
  parameters.fx = parameters.fy = 1000;
  parameters.cx = -1300;
  const auto camera = CameraModel::Create(parameters);
  const Eigen::Vector2d pixel(268, parameters.cy);
  ASSERT_TRUE(camera->Unproject(pixel));
  EXPECT_FALSE(RayOf(*camera, pixel));
  EXPECT_TRUE(RayOf(*camera, {240, parameters.cy}));
}

}  // namespace
}  // namespace plm_vins
