// SPDX-License-Identifier: BSD-3-Clause
#include "feature_tracker/contrast_equalizer.h"

#include <gtest/gtest.h>

#include <opencv2/imgproc.hpp>

#include "test/feature_tracker/textured_scene.h"

namespace plm_vins {
namespace {

cv::Mat ByOpenCv(const cv::Mat& image) {
  cv::Mat equalized;
  cv::createCLAHE(3.0, {8, 8})->apply(image, equalized);
  return equalized;
}

cv::Mat Equalized(const cv::Mat& image) {
  cv::Mat equalized;
  ContrastEqualizer(image.size()).Apply(image, &equalized);
  return equalized;
}

TEST(ContrastEqualizer, AgreesWithOpenCv) {
  cv::Mat dark;
  const cv::Mat view = TexturedScene().View();
  view.convertTo(dark, CV_8U, 0.1, 20);
  for (const cv::Mat& image : {view, dark, cv::Mat(view.rowRange(40, 200).colRange(16, 336))}) {
    EXPECT_LE(cv::norm(Equalized(image), ByOpenCv(image), cv::NORM_INF), 1);
    EXPECT_LT(cv::norm(Equalized(image), ByOpenCv(image), cv::NORM_L1) / image.total(), 0.03);
  }
}

TEST(ContrastEqualizer, AcceptsExtremeBrightness) {
  cv::Mat image(64, 64, CV_8UC1, cv::Scalar(0));
  image.rowRange(32, 64).setTo(255);
  EXPECT_LE(cv::norm(Equalized(image), ByOpenCv(image), cv::NORM_INF), 1);
}

// OpenCV pads such an image, so that its tiles differ by some pixels.
TEST(ContrastEqualizer, AcceptsSizesThatAreNoMultipleOfItsTiles) {
  const cv::Mat image = TexturedScene().View()(cv::Rect(3, 5, 357, 227));
  EXPECT_LT(cv::norm(Equalized(image), ByOpenCv(image), cv::NORM_L1) / image.total(), 4);
}

TEST(ContrastEqualizer, ReusesMemory) {
  const cv::Mat view = TexturedScene().View();
  ContrastEqualizer equalizer(view.size());
  cv::Mat equalized;
  equalizer.Apply(TexturedScene(2).View(), &equalized);
  const uint8_t* memory = equalized.data;
  equalizer.Apply(view, &equalized);
  EXPECT_EQ(equalized.data, memory);
  EXPECT_EQ(cv::norm(equalized, Equalized(view), cv::NORM_INF), 0);
}

}  // namespace
}  // namespace plm_vins
