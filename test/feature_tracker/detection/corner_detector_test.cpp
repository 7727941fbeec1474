// SPDX-License-Identifier: BSD-3-Clause
#include "feature_tracker/detection/corner_detector.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "feature_tracker/detection/corner_refinement.h"
#include "test/feature_tracker/textured_scene.h"

namespace plm_vins {
namespace {

PointTrackerConfig TestConfig(CornerDetectorType type) {
  PointTrackerConfig config;
  config.corner_detector = type;
  config.max_cnt = 60;
  config.min_dist = 15;
  return config;
}

void ExpectSpacing(const std::vector<cv::Point2f>& corners, double min_distance) {
  for (size_t i = 0; i < corners.size(); ++i) {
    for (size_t j = 0; j < i; ++j) EXPECT_GE(cv::norm(corners[i] - corners[j]), min_distance);
  }
}

// Squares of 20 px with sides at multiples of 40 px.
cv::Mat Squares() {
  cv::Mat image(kHeight, kWidth, CV_8UC1, cv::Scalar(60));
  for (int y = 40; y + 40 < kHeight; y += 40) {
    for (int x = 40; x + 40 < kWidth; x += 40) image({x, y, 20, 20}).setTo(200);
  }
  return image;
}

class CornerDetectorTest : public testing::TestWithParam<CornerDetectorType> {
 protected:
  PointTrackerConfig config_ = TestConfig(GetParam());
};

TEST_P(CornerDetectorTest, FindsCornersOfSquares) {
  config_.max_cnt = 120;
  const auto corners = CornerDetector(config_, {}).Detect({Squares()}, {}, 120);
  EXPECT_GT(corners.size(), 80U);
  for (const cv::Point2f& corner : corners) {
    for (const float value : {corner.x, corner.y}) {
      // Edges lie between the pixels 39 and 40, or 59 and 60.
      const float nearest = 20 * std::round((value + 0.5F) / 20) - 0.5F;
      EXPECT_NEAR(value, nearest, 0.5);
    }
  }
}

TEST_P(CornerDetectorTest, KeepsCountSpacingAndBorder) {
  const cv::Mat image = TexturedScene().View();
  const std::vector<cv::Point2f> existing{{100, 100}, {200, 50}};
  auto corners = CornerDetector(config_, {}).Detect({image}, existing, 40);
  EXPECT_EQ(corners.size(), 40U);
  for (const cv::Point2f& corner : corners) {
    EXPECT_TRUE(IsRefinementWindowInside(image.size(), corner));
  }
  corners.insert(corners.end(), existing.begin(), existing.end());
  ExpectSpacing(corners, config_.min_dist);
}

TEST_P(CornerDetectorTest, RefillsWhereCornersAreMissing) {
  const cv::Mat image = TexturedScene().View();
  const CornerDetector detector(config_, {});
  std::vector<cv::Point2f> left_half;
  for (const cv::Point2f& corner : detector.Detect({image}, {}, 60)) {
    if (corner.x < 0.5F * kWidth) left_half.push_back(corner);
  }
  const auto refill = detector.Detect({image}, left_half, 60 - static_cast<int>(left_half.size()));
  const auto in_right_half = std::count_if(
      refill.begin(), refill.end(), [](const auto& corner) { return corner.x >= 0.5F * kWidth; });
  EXPECT_GT(in_right_half, 0.9 * static_cast<double>(refill.size()));
}

TEST_P(CornerDetectorTest, SpreadsOverStrongAndWeakTexture) {
  cv::Mat image = TexturedScene().View();
  cv::Mat right = image.colRange(kWidth / 2, kWidth);
  right.convertTo(right, CV_8U, 0.5, 60);
  const auto corners = CornerDetector(config_, {}).Detect({image}, {}, 60);
  const auto in_right_half = std::count_if(
      corners.begin(), corners.end(), [](const auto& corner) { return corner.x >= 0.5F * kWidth; });
  EXPECT_NEAR(static_cast<double>(in_right_half), 30, 8);
}

TEST_P(CornerDetectorTest, ObeysTheMask) {
  cv::Mat mask(kHeight, kWidth, CV_8UC1, cv::Scalar(0));
  cv::circle(mask, {kWidth / 2, kHeight / 2}, 80, 255, cv::FILLED);
  const auto corners = CornerDetector(config_, mask).Detect({TexturedScene().View()}, {}, 60);
  EXPECT_GT(corners.size(), 20U);
  for (const cv::Point2f& corner : corners) {
    EXPECT_NE(mask.at<uint8_t>(cv::Point(corner)), 0);
  }
}

TEST_P(CornerDetectorTest, FindsNothingInBlankOrNoisyDarkImages) {
  const CornerDetector detector(config_, {});
  for (const int gray : {0, 128, 255}) {
    const cv::Mat blank(kHeight, kWidth, CV_8UC1, cv::Scalar(gray));
    EXPECT_TRUE(detector.Detect({blank}, {}, 60).empty());
  }
  cv::Mat noise(kHeight, kWidth, CV_8UC1);
  cv::RNG(3).fill(noise, cv::RNG::NORMAL, 10, 1);
  EXPECT_TRUE(detector.Detect({noise}, {}, 60).empty());
}

TEST_P(CornerDetectorTest, FindsNothingIfZeroAreRequested) {
  EXPECT_TRUE(CornerDetector(config_, {}).Detect({TexturedScene().View()}, {}, 0).empty());
}

INSTANTIATE_TEST_SUITE_P(Types, CornerDetectorTest,
                         testing::Values(CornerDetectorType::kShiTomasi,
                                         CornerDetectorType::kHarris));

TEST(CornerDetector, WithoutSubpixelsCornersArePixels) {
  PointTrackerConfig config = TestConfig(CornerDetectorType::kShiTomasi);
  config.corner_subpixel = false;
  const auto corners = CornerDetector(config, {}).Detect({TexturedScene().View()}, {}, 40);
  EXPECT_EQ(corners.size(), 40U);
  for (const cv::Point2f& corner : corners) {
    EXPECT_EQ(corner, cv::Point2f(std::round(corner.x), std::round(corner.y)));
  }
}

// Four regions of 100 x 100 px.
RegionQueue FourRegions() { return {{199, 199}, 4}; }

TEST(RegionQueue, ServesThePoorestRegionFirst) {
  RegionQueue queue = FourRegions();
  queue.AddCandidate({10, 10});  // better, but its region has points already
  queue.AddCandidate({150, 150});
  queue.CountPoint({50, 50});
  EXPECT_EQ(queue.Pop(), cv::Point2f(150, 150));
  EXPECT_EQ(queue.Pop(), cv::Point2f(10, 10));
  EXPECT_FALSE(queue.Pop());
}

TEST(RegionQueue, KeepsTheOrderWithinARegion) {
  RegionQueue queue = FourRegions();
  queue.AddCandidate({30, 10});
  queue.AddCandidate({10, 10});
  EXPECT_EQ(queue.Pop(), cv::Point2f(30, 10));
  EXPECT_EQ(queue.Pop(), cv::Point2f(10, 10));
}

TEST(RegionQueue, TakesTurnsAsPointsAreCounted) {
  RegionQueue queue = FourRegions();
  for (const float x : {10.F, 30.F, 150.F, 170.F}) queue.AddCandidate({x, 10});
  std::vector<float> order;
  while (const auto point = queue.Pop()) {
    queue.CountPoint(*point);
    order.push_back(point->x);
  }
  EXPECT_EQ(order, (std::vector<float>{10, 150, 30, 170}));
}

}  // namespace

}  // namespace plm_vins
