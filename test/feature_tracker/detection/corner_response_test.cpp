// SPDX-License-Identifier: BSD-3-Clause
#include "feature_tracker/detection/corner_response.h"

#include <gtest/gtest.h>

#include <opencv2/imgproc.hpp>

#include "test/feature_tracker/textured_scene.h"

namespace plm_vins {
namespace {

constexpr double kRounding = 1e-6;  // of single precision, relative to the strongest response

class CornerResponseTest : public testing::TestWithParam<CornerDetectorType> {
 protected:
  static cv::Mat OpenCvResponse(const cv::Mat& image) {
    cv::Mat response;
    if (GetParam() == CornerDetectorType::kHarris) {
      cv::cornerHarris(image, response, 3, 3, 0.04);
    } else {
      cv::cornerMinEigenVal(image, response, 3, 3);
    }
    return response;
  }

  static void ExpectThatOfOpenCv(const cv::Mat& image) {
    const cv::Mat expected = OpenCvResponse(image);
    const cv::Mat response = CornerResponse(image, GetParam());
    ASSERT_EQ(response.size(), expected.size());
    ASSERT_EQ(response.type(), expected.type());
    const double greatest = cv::norm(expected, cv::NORM_INF);
    EXPECT_LE(cv::norm(response, expected, cv::NORM_INF), kRounding * greatest) << image.size();
  }

  static cv::Mat Noise(const cv::Size& size) {
    cv::Mat image(size, CV_8UC1);
    cv::RNG(5).fill(image, cv::RNG::UNIFORM, 0, 256);
    return image;
  }
};

TEST_P(CornerResponseTest, IsThatOfOpenCv) { ExpectThatOfOpenCv(TexturedScene().View()); }

TEST_P(CornerResponseTest, IsThatOfOpenCvAtTheBordersOfAnySize) {
  for (const cv::Size size : {cv::Size(2, 2), {3, 2}, {2, 5}, {17, 9}, {64, 3}, {33, 31}}) {
    ExpectThatOfOpenCv(Noise(size));
  }
}

// Tests for overflow of the sums with the strongest possible gradients.
TEST_P(CornerResponseTest, IsThatOfOpenCvWhereContrastIsGreatest) {
  cv::Mat image(40, 40, CV_8UC1, cv::Scalar(0));
  for (int y = 0; y < image.rows; ++y) {
    for (int x = 0; x < image.cols; ++x) {
      if ((x / 2 + y / 2) % 2 == 0) image.at<uint8_t>(y, x) = 255;
    }
  }
  ExpectThatOfOpenCv(image);
}

TEST_P(CornerResponseTest, TakesAPartOfAnImage) {
  const cv::Mat image = TexturedScene().View();
  ExpectThatOfOpenCv(image({31, 17, 101, 55}).clone());
  EXPECT_EQ(cv::norm(CornerResponse(image({31, 17, 101, 55}), GetParam()),
                     CornerResponse(image({31, 17, 101, 55}).clone(), GetParam()), cv::NORM_INF),
            0);
}

TEST_P(CornerResponseTest, IsNothingWhereNothingIs) {
  const cv::Mat blank(30, 40, CV_8UC1, cv::Scalar(200));
  EXPECT_EQ(cv::norm(CornerResponse(blank, GetParam()), cv::NORM_INF), 0);
}

INSTANTIATE_TEST_SUITE_P(Types, CornerResponseTest,
                         testing::Values(CornerDetectorType::kShiTomasi,
                                         CornerDetectorType::kHarris));

}  // namespace
}  // namespace plm_vins
