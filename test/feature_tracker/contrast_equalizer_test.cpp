// SPDX-License-Identifier: BSD-3-Clause
#include "feature_tracker/contrast_equalizer.h"

#include <gtest/gtest.h>

#include <opencv2/imgproc.hpp>

namespace plm_vins {
namespace {

// Dark at the left, bright at the right, and noisy, but for a patch of one grey.
cv::Mat MakeImage(const cv::Size& size) {
  cv::Mat image(size, CV_8UC1);
  cv::RNG random(7);
  for (int y = 0; y < size.height; ++y) {
    for (int x = 0; x < size.width; ++x) {
      image.at<uint8_t>(y, x) =
          cv::saturate_cast<uint8_t>(40 + 180 * x / size.width + random.gaussian(10));
    }
  }
  image(cv::Rect(size.width / 3, size.height / 3, size.width / 4, size.height / 4)) = 90;
  return image;
}

cv::Mat EqualizeWithOpenCv(const cv::Mat& image) {
  cv::Mat equalized;
  cv::createCLAHE(3.0, {8, 8})->apply(image, equalized);
  return equalized;
}

// Where the compiler fuses products and sums, a pixel in very many rounds the other way.
void ExpectSame(const cv::Mat& actual, const cv::Mat& expected) {
  ASSERT_EQ(actual.size(), expected.size());
  EXPECT_LE(cv::norm(actual, expected, cv::NORM_INF), 1);
  EXPECT_LE(cv::countNonZero(actual != expected), 1e-4 * static_cast<double>(expected.total()));
}

class ContrastEqualizerTest : public testing::TestWithParam<cv::Size> {};

TEST_P(ContrastEqualizerTest, GivesWhatOpenCvGives) {
  const cv::Mat image = MakeImage(GetParam());
  ContrastEqualizer equalizer(GetParam());
  const cv::Mat expected = EqualizeWithOpenCv(image);
  ASSERT_GT(cv::norm(image, expected, cv::NORM_INF), 20) << "nothing to equalise";
  ExpectSame(equalizer.Equalize(image), expected);
}

INSTANTIATE_TEST_SUITE_P(Sizes, ContrastEqualizerTest,
                         testing::Values(cv::Size(752, 480),  // a whole number of pixels a tile
                                         cv::Size(749, 481),  // neither
                                         cv::Size(752, 483),  // one of them
                                         cv::Size(61, 47)));  // tiles of few pixels

TEST(ContrastEqualizer, KeepsNothingOfTheImageBefore) {
  const cv::Size size(320, 240);
  const cv::Mat image = MakeImage(size);
  ContrastEqualizer equalizer(size);
  const cv::Mat first = equalizer.Equalize(image);
  equalizer.Equalize(255 - image);
  EXPECT_EQ(cv::countNonZero(equalizer.Equalize(image) != first), 0);
}

TEST(ContrastEqualizer, TakesAPartOfALargerImage) {
  const cv::Mat large = MakeImage({400, 300});
  const cv::Mat part = large(cv::Rect(30, 20, 320, 240));
  ContrastEqualizer equalizer(part.size());
  ExpectSame(equalizer.Equalize(part), EqualizeWithOpenCv(part.clone()));
}

}  // namespace
}  // namespace plm_vins
