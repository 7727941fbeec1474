// SPDX-License-Identifier: BSD-3-Clause
#include "tracking/images/image_mask.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <stdexcept>

#include "test/testing/message_of.h"
#include "test/testing/temporary_folder.h"

namespace plm_vins {
namespace {

const cv::Size kSize(64, 48);

// A white disc on black.
cv::Mat Disc() {
  cv::Mat mask(kSize, CV_8UC1, cv::Scalar(0));
  cv::circle(mask, {32, 24}, 17, 255, cv::FILLED);
  return mask;
}

class ImageMaskTest : public ::testing::Test {
 protected:
  cv::Mat Stored(const std::string& name, const cv::Mat& mask) {
    cv::imwrite(folder_.File(name), mask);
    return ReadMask(folder_.File(name), kSize);
  }

  const testing::TemporaryFolder folder_;
};

TEST_F(ImageMaskTest, ToleratesLossyFiles) {
  const cv::Mat mask = Stored("mask.png", Disc());
  EXPECT_EQ(cv::countNonZero(mask != Disc()), 0);
  EXPECT_EQ(cv::countNonZero(Stored("mask.jpg", Disc()) != mask), 0);
}

TEST_F(ImageMaskTest, AllowsPixelsWhereItIsWhite) {
  const cv::Mat mask = Stored("mask.png", Disc());
  EXPECT_TRUE(MaskAllows(mask, {32, 24}));
  EXPECT_FALSE(MaskAllows(mask, {2, 3}));
  EXPECT_TRUE(MaskAllows(ReadMask("", kSize), {2, 3}));
}

TEST_F(ImageMaskTest, IsRejectedIfItMasksAllOrHasAnotherSize) {
  const auto error = [&](const cv::Mat& mask) {
    return testing::MessageOf([&] { Stored("mask.png", mask); });
  };
  using ::testing::HasSubstr;
  EXPECT_THAT(error(cv::Mat(kSize, CV_8UC1, cv::Scalar(1))), HasSubstr("is dark everywhere"));
  EXPECT_THAT(error(cv::Mat(10, 20, CV_8UC1, cv::Scalar(255))), HasSubstr("has 20x10 pixels"));
  EXPECT_THROW(ReadMask(folder_.File("none.png"), kSize), std::invalid_argument);
}

}  // namespace
}  // namespace plm_vins
