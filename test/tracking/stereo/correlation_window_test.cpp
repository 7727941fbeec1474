// SPDX-License-Identifier: BSD-3-Clause
#include "tracking/stereo/correlation_window.h"

#include <gtest/gtest.h>

#include <opencv2/imgproc.hpp>

namespace plm_vins {
namespace {

const Eigen::Matrix2d kSame = Eigen::Matrix2d::Identity();

cv::Mat Noise(uint64_t seed) {
  cv::Mat image(120, 160, CV_8UC1);
  cv::RNG(seed).fill(image, cv::RNG::UNIFORM, 0, 256);
  cv::GaussianBlur(image, image, {}, 2);
  cv::normalize(image, image, 0, 255, cv::NORM_MINMAX);
  return image;
}

cv::Mat Shifted(const cv::Mat& image, double x, double y) {
  cv::Mat shifted;
  const cv::Matx23d shift(1, 0, x, 0, 1, y);
  cv::warpAffine(image, shifted, shift, image.size(), cv::INTER_LINEAR, cv::BORDER_REFLECT);
  return shifted;
}

TEST(CorrelationWindowTest, IsOneWithItselfForAnyGainAndOffset) {
  const cv::Mat image = Noise(1);
  const auto window = CorrelationWindow::Cut(image, {80, 60}, kSame);
  ASSERT_TRUE(window);
  EXPECT_NEAR(window->Correlate(image, {80, 60}), 1, 1e-5);
  cv::Mat darker;
  image.convertTo(darker, CV_8U, 0.5, 30);
  EXPECT_GT(window->Correlate(darker, {80, 60}), 0.999);
  EXPECT_NEAR(window->Correlate(255 - image, {80, 60}), -1, 1e-4);
}

TEST(CorrelationWindowTest, IsSmallElsewhere) {
  const auto window = CorrelationWindow::Cut(Noise(1), {80, 60}, kSame);
  EXPECT_LT(std::abs(window->Correlate(Noise(2), {80, 60})), 0.6);
}

TEST(CorrelationWindowTest, IsTheTextbookFormula) {
  const cv::Mat a = Noise(1), b = Noise(2);
  const auto window = CorrelationWindow::Cut(a, {50, 40}, kSame);
  const cv::Rect around_a(50 - 8, 40 - 5, 16, 11), around_b(70 - 8, 60 - 5, 16, 11);
  cv::Mat expected;
  cv::matchTemplate(b(around_b), a(around_a), expected, cv::TM_CCOEFF_NORMED);
  EXPECT_NEAR(window->Correlate(b, {70, 60}), expected.at<float>(0, 0), 1e-4);
}

TEST(CorrelationWindowTest, FollowsTheWarp) {
  const cv::Mat image = Noise(1);
  cv::Mat warped;
  const cv::Matx23d affine(1.2, 0.1, -15, -0.1, 0.9, 10);
  cv::warpAffine(image, warped, affine, image.size());
  const Eigen::Vector2d center(80.0, 60.0);
  const cv::Point there(cvRound(1.2 * 80 + 0.1 * 60 - 15), cvRound(-0.1 * 80 + 0.9 * 60 + 10));
  const Eigen::Matrix2d warp = (Eigen::Matrix2d() << 1.2, 0.1, -0.1, 0.9).finished();
  EXPECT_GT(CorrelationWindow::Cut(image, center, warp)->Correlate(warped, there), 0.98);
  EXPECT_LT(CorrelationWindow::Cut(image, center, kSame)->Correlate(warped, there), 0.95);
}

TEST(CorrelationWindowTest, ReachesSubpixelAccuracy) {
  const cv::Mat image = Noise(1);
  const cv::Mat moved = Shifted(image, 2.3, -1.6);
  const auto window = CorrelationWindow::Cut(image, {80, 60}, kSame);
  const Eigen::Vector2d top = window->Climb(moved, {81, 60});
  EXPECT_NEAR(top.x(), 82.3, 0.15);
  EXPECT_NEAR(top.y(), 58.4, 0.15);
}

TEST(CorrelationWindowTest, NeedsTextureAndRoom) {
  EXPECT_FALSE(CorrelationWindow::Cut(cv::Mat(120, 160, CV_8UC1, cv::Scalar(90)), {80, 60}, kSame));
  EXPECT_FALSE(CorrelationWindow::Cut(Noise(1), {4, 60}, kSame));
  EXPECT_FALSE(CorrelationWindow::Cut(Noise(1), {80, 117}, kSame));
  EXPECT_FALSE(CorrelationWindow::Cut(Noise(1), {80, 60}, Eigen::Matrix2d::Zero()));
  EXPECT_TRUE(CorrelationWindow::IsInside(Noise(1), {8, 5}));
  EXPECT_FALSE(CorrelationWindow::IsInside(Noise(1), {7, 5}));
  EXPECT_TRUE(CorrelationWindow::IsInside(Noise(1), {152, 114}));
  EXPECT_FALSE(CorrelationWindow::IsInside(Noise(1), {153, 114}));
}

}  // namespace
}  // namespace plm_vins
