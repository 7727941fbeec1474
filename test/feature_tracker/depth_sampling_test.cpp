// SPDX-License-Identifier: BSD-3-Clause
#include "feature_tracker/depth_sampling.h"

#include <gtest/gtest.h>

#include <limits>

namespace plm_vins {
namespace {

const cv::Point2f kPixel(20.3F, 14.8F);  // next to row 15, column 20

std::optional<double> InMillimeters(const cv::Mat& depth, const cv::Point2f& pixel) {
  return DepthAt(depth, pixel, 0.001);
}

cv::Mat Millimeters(int depth) { return {30, 40, CV_16UC1, cv::Scalar(depth)}; }
cv::Mat Meters(float depth) { return {30, 40, CV_32FC1, cv::Scalar(depth)}; }

TEST(DepthSamplingTest, ReadsBothFormats) {
  EXPECT_NEAR(*InMillimeters(Millimeters(2345), kPixel), 2.345, 1e-12);
  EXPECT_NEAR(*InMillimeters(Meters(2.345F), kPixel), 2.345, 1e-6);
}

TEST(DepthSamplingTest, IntegersHaveAUnit) {
  EXPECT_NEAR(*DepthAt(Millimeters(23450), kPixel, 1e-4), 2.345, 1e-12);
  EXPECT_NEAR(*DepthAt(Meters(2.345F), kPixel, 1e-4), 2.345, 1e-6);
  EXPECT_FALSE(InMillimeters(Millimeters(65535), kPixel));
}

TEST(DepthSamplingTest, TakesTheMedian) {
  cv::Mat depth = Millimeters(2000);
  depth.at<uint16_t>(15, 20) = 2060;
  depth.at<uint16_t>(14, 21) = 1950;
  EXPECT_NEAR(*InMillimeters(depth, kPixel), 2.0, 1e-12);
}

TEST(DepthSamplingTest, AllowsForAFewHolesOnly) {
  cv::Mat depth = Millimeters(2000);
  depth.at<uint16_t>(15, 20) = depth.at<uint16_t>(14, 19) = 0;
  EXPECT_TRUE(InMillimeters(depth, kPixel));
  depth.at<uint16_t>(16, 21) = 0;
  EXPECT_FALSE(InMillimeters(depth, kPixel));
  EXPECT_FALSE(InMillimeters(Millimeters(0), kPixel));
  EXPECT_FALSE(InMillimeters(Meters(std::numeric_limits<float>::quiet_NaN()), kPixel));
  EXPECT_FALSE(InMillimeters(Meters(std::numeric_limits<float>::infinity()), kPixel));
  EXPECT_FALSE(InMillimeters(Meters(-1), kPixel));
}

TEST(DepthSamplingTest, GivesNothingAtAnEdge) {
  cv::Mat depth = Millimeters(2000);
  depth.colRange(21, 40).setTo(cv::Scalar(2500));
  EXPECT_FALSE(InMillimeters(depth, kPixel));
  EXPECT_TRUE(InMillimeters(depth, kPixel - cv::Point2f(2, 0)));
  EXPECT_TRUE(InMillimeters(depth, kPixel + cv::Point2f(3, 0)));
}

TEST(DepthSamplingTest, GivesNothingOutsideTheImage) {
  EXPECT_FALSE(InMillimeters(cv::Mat(), kPixel));
  for (const cv::Point2f& pixel : {cv::Point2f(0, 15), cv::Point2f(39, 15), cv::Point2f(20, 0),
                                   cv::Point2f(20, 29), cv::Point2f(-5, 400)}) {
    EXPECT_FALSE(InMillimeters(Millimeters(2000), pixel)) << pixel;
  }
}

}  // namespace
}  // namespace plm_vins
