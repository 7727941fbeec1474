// SPDX-License-Identifier: BSD-3-Clause
#include "tracking/images/image_check.h"

#include <gtest/gtest.h>

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

}  // namespace
}  // namespace plm_vins
