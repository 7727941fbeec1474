// SPDX-License-Identifier: BSD-3-Clause
#include "feature_tracker/detection/corner_refinement.h"

#include <gtest/gtest.h>

#include <opencv2/imgproc.hpp>

namespace plm_vins {
namespace {

constexpr int kSize = 80;

// A tilted chessboard saddle at `corner`, anti-aliased by 16 x 16 samples per pixel.
cv::Mat Saddle(const cv::Point2d& corner) {
  constexpr int kSamples = 16;
  cv::Mat image(kSize, kSize, CV_8UC1);
  for (int y = 0; y < kSize; ++y) {
    for (int x = 0; x < kSize; ++x) {
      int white = 0;
      for (int i = 0; i < kSamples * kSamples; ++i) {
        const double dx = x + (i % kSamples + 0.5) / kSamples - 0.5 - corner.x;
        const double dy = y + (i / kSamples + 0.5) / kSamples - 0.5 - corner.y;
        white += (dx + 0.2 * dy) * (dy - 0.3 * dx) > 0 ? 1 : 0;
      }
      image.at<uint8_t>(y, x) = static_cast<uint8_t>(40 + 180 * white / (kSamples * kSamples));
    }
  }
  cv::GaussianBlur(image, image, {}, 0.7);
  return image;
}

TEST(RefineCorner, FindsTheSubpixelPosition) {
  for (const cv::Point2d corner : {cv::Point2d(40, 40), cv::Point2d(40.3, 39.8), {38.7, 41.45}}) {
    const auto refined = RefineCorner(Saddle(corner), {40, 40});
    ASSERT_TRUE(refined);
    EXPECT_NEAR(refined->x, corner.x, 0.03);
    EXPECT_NEAR(refined->y, corner.y, 0.03);
  }
}

TEST(RefineCorner, AgreesWithOpenCvIfItConverges) {
  const cv::Mat image = Saddle({41.2, 38.6});
  std::vector<cv::Point2f> expected{{40, 40}};
  cv::cornerSubPix(image, expected, {kRefinementRadius_px, kRefinementRadius_px}, {-1, -1},
                   {cv::TermCriteria::COUNT | cv::TermCriteria::EPS, 50, 1e-4});
  const auto refined = RefineCorner(image, {40, 40});
  ASSERT_TRUE(refined);
  EXPECT_LT(cv::norm(*refined - expected[0]), 0.03);
}

TEST(RefineCorner, RejectsACornerThatLeavesItsWindow) {
  EXPECT_FALSE(RefineCorner(Saddle({40, 40}), {47, 40}));
}

TEST(RefineCorner, RejectsAWindowThatLeavesTheImage) {
  const double border = kRefinementRadius_px + 1;
  EXPECT_TRUE(RefineCorner(Saddle({border + 0.4, 40}), {border + 1, 40}));
  EXPECT_FALSE(RefineCorner(Saddle({border - 0.6, 40}), {border - 1, 40}));
  // The window starts inside and moves out of the image.
  EXPECT_FALSE(RefineCorner(Saddle({border - 1.5, 40}), {border + 0.5, 40}));
  EXPECT_FALSE(RefineCorner(Saddle({40, kSize - border}), {40, kSize - border}));
}

TEST(RefineCorner, RejectsEdgesAndBlankImages) {
  EXPECT_FALSE(RefineCorner(cv::Mat(kSize, kSize, CV_8UC1, cv::Scalar(90)), {40, 40}));
  cv::Mat edge(kSize, kSize, CV_8UC1, cv::Scalar(90));
  edge.colRange(0, 40).setTo(200);
  EXPECT_FALSE(RefineCorner(edge, {40, 40}));
}

}  // namespace
}  // namespace plm_vins
