// SPDX-License-Identifier: BSD-3-Clause
#include "tracking/images/image_check.h"

#include <gtest/gtest.h>

#include <cmath>

namespace plm_vins {
namespace {

TEST(ImageCheck, AFlatImageIsNamed) {
  cv::Mat gray(240, 320, CV_8UC1, cv::Scalar(128));
  EXPECT_NE(DescribeIfFlat(gray).find("from 128 to 128 of 255"), std::string::npos);
  gray.rowRange(0, 120) = cv::Scalar(120);
  EXPECT_EQ(DescribeIfFlat(gray), "");
}

// 10 bits in an image of 16.
TEST(ImageCheck, ANearlyBlackImageIsNamed) {
  cv::Mat gray(240, 320, CV_8UC1, cv::Scalar(0));
  gray.colRange(0, 160) = cv::Scalar(3);
  EXPECT_NE(DescribeIfFlat(gray).find("from 0 to 3 of 255"), std::string::npos);
}

TEST(ImageCheck, ATinyImageIsNotFlat) {
  EXPECT_EQ(DescribeIfFlat(cv::Mat(4, 4, CV_8UC1, cv::Scalar(9))), "");
}

// Noise and texture, and a pattern of colors.
cv::Mat Textured(bool is_bayer) {
  cv::Mat gray(240, 320, CV_8UC1);
  cv::RNG random(3);
  for (int row = 0; row < gray.rows; ++row) {
    for (int col = 0; col < gray.cols; ++col) {
      const double texture = 120 + 60 * std::sin(0.3 * row) * std::sin(0.2 * col);
      const double color = !is_bayer || (row + col) % 2 != 0 ? 1.0 : row % 2 == 0 ? 0.8 : 0.5;
      gray.at<uint8_t>(row, col) = cv::saturate_cast<uint8_t>(color * texture + random.gaussian(2));
    }
  }
  return gray;
}

TEST(ImageCheck, ARawBayerImageIsNamed) {
  EXPECT_NE(DescribeIfBayer(Textured(true)).find("raw Bayer image"), std::string::npos);
  EXPECT_EQ(DescribeIfBayer(Textured(false)), "");
}

TEST(ImageCheck, NoiseAndStripesAreNoBayerImage) {
  cv::Mat gray(240, 320, CV_8UC1, cv::Scalar(50));
  EXPECT_EQ(DescribeIfBayer(gray), "");
  for (int row = 0; row < gray.rows; row += 2) gray.row(row) = 100;
  EXPECT_EQ(DescribeIfBayer(gray), "") << "interlaced, not Bayer";
  cv::theRNG().state = 1;
  cv::randn(gray, 128, 30);
  EXPECT_EQ(DescribeIfBayer(gray), "");
  EXPECT_EQ(DescribeIfBayer(cv::Mat(1, 1, CV_8UC1, cv::Scalar(9))), "");
}

}  // namespace
}  // namespace plm_vins
