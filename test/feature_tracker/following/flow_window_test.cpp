// SPDX-License-Identifier: BSD-3-Clause
#include "feature_tracker/following/flow_window.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <opencv2/imgproc.hpp>

namespace plm_vins {
namespace {

constexpr int kSize = 160;
const cv::Point2f kFlowCenter(80.3F, 75.6F);

// Adds the border that the window requires.
cv::Mat Bordered(const cv::Mat& image, int side) {
  const int border = FlowWindow::Border(side);
  cv::Mat whole;
  cv::copyMakeBorder(image, whole, border, border, border, border, cv::BORDER_REFLECT_101);
  return whole(cv::Rect(border, border, image.cols, image.rows));
}

// Two waves, translated by `shift`.
cv::Mat Waves(int side, const cv::Point2d& shift = {}, double height = 60) {
  cv::Mat image(kSize, kSize, CV_8UC1);
  for (int y = 0; y < kSize; ++y) {
    for (int x = 0; x < kSize; ++x) {
      const double value =
          128 + height * std::sin((x - shift.x) / 4.0) + height * std::cos((y - shift.y) / 5.0);
      image.at<uint8_t>(y, x) = cv::saturate_cast<uint8_t>(value);
    }
  }
  return Bordered(image, side);
}

class FlowWindowTest : public testing::TestWithParam<int> {
 protected:
  FlowWindow window_{GetParam()};
};

TEST_P(FlowWindowTest, StaysAtItsOrigin) {
  const cv::Mat image = Waves(GetParam());
  ASSERT_TRUE(window_.Cut(image, kFlowCenter));
  const auto step = window_.Step(image, kFlowCenter);
  ASSERT_TRUE(step);
  EXPECT_LT(cv::norm(*step), 0.002);
}

TEST_P(FlowWindowTest, IgnoresAnOffsetOfTheBrightness) {
  const cv::Point2d shift(0.37, -0.22);
  const cv::Mat moved = Waves(GetParam(), shift, 40), brighter = moved + 40;
  ASSERT_TRUE(window_.Cut(Waves(GetParam(), {}, 40), kFlowCenter));
  const auto step = window_.Step(moved, kFlowCenter);
  const auto step_when_brighter = window_.Step(Bordered(brighter, GetParam()), kFlowCenter);
  ASSERT_TRUE(step && step_when_brighter);
  EXPECT_LT(cv::norm(*step - *step_when_brighter), 0.005);
}

TEST_P(FlowWindowTest, StepsToTheMotion) {
  const cv::Point2d shift(0.37, -0.22);
  ASSERT_TRUE(window_.Cut(Waves(GetParam()), kFlowCenter));
  const cv::Mat moved = Waves(GetParam(), shift);
  const auto first = window_.Step(moved, kFlowCenter);
  ASSERT_TRUE(first);
  EXPECT_LT(cv::norm(cv::Point2d(*first) - shift), 0.1 * cv::norm(shift));
  cv::Point2f center = kFlowCenter;
  for (int i = 0; i < 4; ++i) center += window_.Step(moved, center).value();
  // In a small window, the gradient is nearly constant, and an offset looks like motion.
  const double tolerance = GetParam() < 8 ? 0.03 : 0.02;
  EXPECT_LT(cv::norm(cv::Point2d(center - kFlowCenter) - shift), tolerance);
}

TEST_P(FlowWindowTest, IgnoresPixelsBeyondItsSide) {
  const int side = GetParam();
  const cv::Mat image = Waves(side);
  const cv::Point2f center(80, 80);
  ASSERT_TRUE(window_.Cut(image, center));
  const cv::Point2f guess = center + cv::Point2f(0.4F, 0.3F);
  const auto step = window_.Step(image, guess);
  cv::Mat changed = Waves(side);
  // The pixels that the samples at `guess` interpolate; all others are replaced by noise.
  const int first = cvFloor(80 - 0.5 * (side - 1) + 0.3), pixels = side + 2;
  const cv::Rect inside(first, first, pixels, pixels);
  cv::Mat noise(changed.size(), CV_8UC1);
  cv::randu(noise, 0, 256);
  image(inside).copyTo(noise(inside));
  noise.copyTo(changed);
  EXPECT_EQ(window_.Step(changed, guess), step);
}

// Tests for overflow with the largest difference and the steepest gradients.
TEST_P(FlowWindowTest, DoesNotOverflowAtFullContrast) {
  cv::Mat squares(kSize, kSize, CV_8UC1), inverse;
  for (int y = 0; y < kSize; ++y) {
    for (int x = 0; x < kSize; ++x) {
      squares.at<uint8_t>(y, x) = x / 4 % 2 == y / 4 % 2 ? 255 : 0;
    }
  }
  cv::bitwise_not(squares, inverse);
  const cv::Mat image = Bordered(squares, GetParam());
  ASSERT_TRUE(window_.Cut(image, {80, 80}));
  EXPECT_LT(cv::norm(window_.Step(image, {80, 80}).value()), 0.002);
  const auto step = window_.Step(Bordered(inverse, GetParam()), {80.5F, 80.25F});
  ASSERT_TRUE(step);
  EXPECT_LT(cv::norm(*step), 8);
}

TEST_P(FlowWindowTest, NeedsTextureInBothDirections) {
  const cv::Mat flat(kSize, kSize, CV_8UC1, cv::Scalar(90));
  EXPECT_FALSE(window_.Cut(Bordered(flat, GetParam()), kFlowCenter));
  cv::Mat stripes(kSize, kSize, CV_8UC1);
  for (int x = 0; x < kSize; ++x) stripes.col(x) = 128 + 90 * std::sin(x / 3.0);
  EXPECT_FALSE(window_.Cut(Bordered(stripes, GetParam()), kFlowCenter));
  EXPECT_TRUE(window_.Cut(Waves(GetParam()), kFlowCenter));
}

TEST_P(FlowWindowTest, ReachesTheCornersOfTheImageAndNotFarBeyond) {
  const cv::Mat image = Waves(GetParam());
  ASSERT_TRUE(window_.Cut(image, kFlowCenter));
  for (const float x : {0.0F, kSize - 1.0F}) {
    for (const float y : {0.0F, kSize - 1.0F}) {
      EXPECT_TRUE(window_.Step(image, {x, y})) << x << ' ' << y;
    }
  }
  const float far = 2.0F * GetParam(), nan = std::numeric_limits<float>::quiet_NaN();
  for (const float x : {-far, kSize + far, 1e9F, -1e9F, nan}) {
    EXPECT_FALSE(window_.Step(image, {x, 80}));
    EXPECT_FALSE(window_.Step(image, {80, x}));
    EXPECT_FALSE(window_.Cut(image, {x, 80}));
    EXPECT_FALSE(window_.Cut(image, {80, x}));
  }
}

INSTANTIATE_TEST_SUITE_P(Sides, FlowWindowTest, testing::Values(5, 8, 14, 16, 21, 101));

}  // namespace
}  // namespace plm_vins
