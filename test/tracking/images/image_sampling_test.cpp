// SPDX-License-Identifier: BSD-3-Clause
#include "tracking/images/image_sampling.h"

#include <gtest/gtest.h>

#include <array>

namespace plm_vins {
namespace {

class ImageSamplingTest : public ::testing::Test {
 protected:
  ImageSamplingTest() {
    cv::theRNG().state = 7;
    cv::randu(image_, 0, 256);
  }

  cv::Mat image_ = cv::Mat(40, 60, CV_8UC1);
};

TEST_F(ImageSamplingTest, IsLinearBetweenPixels) {
  const auto at = [&](int row, int column) {
    return static_cast<float>(image_.at<uint8_t>(row, column));
  };
  EXPECT_FLOAT_EQ(Interpolate(image_, 12, 9), at(9, 12));
  EXPECT_FLOAT_EQ(Interpolate(image_, 12.25F, 9), 0.75F * at(9, 12) + 0.25F * at(9, 13));
  EXPECT_FLOAT_EQ(Interpolate(image_, 12, 9.5F), 0.5F * at(9, 12) + 0.5F * at(10, 12));
}

TEST_F(ImageSamplingTest, RowsAgreeWithSinglePixels) {
  for (const cv::Point2f& step : {cv::Point2f(1, 0), {0.9F, 0.31F}, {-0.7F, 1.2F}, {0, -1}}) {
    const cv::Point2f start(20.3F, 15.8F);
    std::array<float, 8> row;
    row.fill(-1);
    InterpolateRow<8>(image_, start, step, 7, row.data());
    for (int i = 0; i < 7; ++i) {
      const cv::Point2f point = start + step * i;
      EXPECT_NEAR(row[i], Interpolate(image_, point.x, point.y), 1e-2) << step << " " << i;
    }
    EXPECT_EQ(row[7], 0);
  }
}

TEST_F(ImageSamplingTest, TakesPartOfAnImage) {
  const cv::Mat part = image_(cv::Rect(10, 5, 30, 30));
  std::array<float, 4> row;
  InterpolateRow<4>(part, {3.5F, 4.5F}, {1, 0}, 4, row.data());
  for (int i = 0; i < 4; ++i) {
    EXPECT_FLOAT_EQ(row[i], Interpolate(image_, 13.5F + static_cast<float>(i), 9.5F));
  }
}

}  // namespace
}  // namespace plm_vins
