// SPDX-License-Identifier: BSD-3-Clause
#include "pose_graph/ros/keyframe_images.h"

#include <gtest/gtest.h>

namespace plm_vins {
namespace {

cv::Mat Gray(int value) { return {48, 64, CV_8UC1, cv::Scalar(value)}; }

TEST(KeyframeImages, ShowsAKeyframeAtHalfResolution) {
  KeyframeImages images;
  images.Add({3, 0}, Gray(200));
  images.Add({4, 0}, Gray(100));
  const cv::Mat image = images.Find({3, 0});
  ASSERT_EQ(image.size(), cv::Size(32, 24));
  ASSERT_EQ(image.type(), CV_8UC1);
  EXPECT_NEAR(image.at<uint8_t>(10, 10), 200, 2);
}

TEST(KeyframeImages, DropsOldKeyframes) {
  KeyframeImages images;
  for (int keyframe = 0; keyframe < 4; ++keyframe) images.Add({keyframe, 0}, Gray(100));
  images.Keep([](int keyframe) { return keyframe == 2; });
  EXPECT_TRUE(images.Find({1, 0}).empty());
  EXPECT_FALSE(images.Find({2, 0}).empty());
  EXPECT_TRUE(images.Find({3, 0}).empty());
}

}  // namespace
}  // namespace plm_vins
