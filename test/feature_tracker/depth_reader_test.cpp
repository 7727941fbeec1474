// SPDX-License-Identifier: BSD-3-Clause
#include "feature_tracker/depth_reader.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace plm_vins {
namespace {

const cv::Point2f kPixel(20.3F, 14.8F);  // next to row 15, column 20

std::optional<double> InMillimeters(const cv::Mat& depth, const cv::Point2f& pixel) {
  return DepthAt(depth, pixel, 0.001);
}

cv::Mat Millimeters(int depth) { return {30, 40, CV_16UC1, cv::Scalar(depth)}; }
cv::Mat Meters(float depth) { return {30, 40, CV_32FC1, cv::Scalar(depth)}; }

TEST(DepthSamplingTest, ReadsBothFormats) {
  EXPECT_NEAR(*InMillimeters(Millimeters(2345), kPixel), 2.345, 1e-12);
  EXPECT_NEAR(*InMillimeters(Meters(2.345F), kPixel), 2.345, 1e-6);
}

TEST(DepthSamplingTest, IntegersHaveAUnit) {
  EXPECT_NEAR(*DepthAt(Millimeters(23450), kPixel, 1e-4), 2.345, 1e-12);
  EXPECT_NEAR(*DepthAt(Meters(2.345F), kPixel, 1e-4), 2.345, 1e-6);
  EXPECT_FALSE(InMillimeters(Millimeters(65535), kPixel));
}

TEST(DepthSamplingTest, TakesTheMedian) {
  cv::Mat depth = Millimeters(2000);
  depth.at<uint16_t>(15, 20) = 2060;
  depth.at<uint16_t>(14, 21) = 1950;
  EXPECT_NEAR(*InMillimeters(depth, kPixel), 2.0, 1e-12);
}

TEST(DepthSamplingTest, AllowsForAFewHolesOnly) {
  cv::Mat depth = Millimeters(2000);
  depth.at<uint16_t>(15, 20) = depth.at<uint16_t>(14, 19) = 0;
  EXPECT_TRUE(InMillimeters(depth, kPixel));
  depth.at<uint16_t>(16, 21) = 0;
  EXPECT_FALSE(InMillimeters(depth, kPixel));
  EXPECT_FALSE(InMillimeters(Millimeters(0), kPixel));
  EXPECT_FALSE(InMillimeters(Meters(std::numeric_limits<float>::quiet_NaN()), kPixel));
  EXPECT_FALSE(InMillimeters(Meters(std::numeric_limits<float>::infinity()), kPixel));
  EXPECT_FALSE(InMillimeters(Meters(-1), kPixel));
}

TEST(DepthSamplingTest, GivesNothingAtAnEdge) {
  cv::Mat depth = Millimeters(2000);
  depth.colRange(21, 40).setTo(cv::Scalar(2500));
  EXPECT_FALSE(InMillimeters(depth, kPixel));
  EXPECT_TRUE(InMillimeters(depth, kPixel - cv::Point2f(2, 0)));
  EXPECT_TRUE(InMillimeters(depth, kPixel + cv::Point2f(3, 0)));
}

TEST(DepthSamplingTest, GivesNothingOutsideTheImage) {
  EXPECT_FALSE(InMillimeters(cv::Mat(), kPixel));
  for (const cv::Point2f& pixel : {cv::Point2f(0, 15), cv::Point2f(39, 15), cv::Point2f(20, 0),
                                   cv::Point2f(20, 29), cv::Point2f(-5, 400)}) {
    EXPECT_FALSE(InMillimeters(Millimeters(2000), pixel)) << pixel;
  }
}

using ::testing::HasSubstr;

std::vector<PointTrack> Tracks() {
  std::vector<PointTrack> tracks(30);
  for (size_t i = 0; i < tracks.size(); ++i) {
    tracks[i].uv_px = {10.0F + 3 * static_cast<float>(i), 20.0F};
  }
  return tracks;
}

cv::Mat Slope() {
  cv::Mat image(40, 120, CV_16UC1);
  for (int x = 0; x < image.cols; ++x) image.col(x).setTo(cv::Scalar(2000 + x));
  return image;
}

// Reads images for a second; returns the tracks.
std::vector<PointTrack> Read(const cv::Mat& image, DepthReader* reader) {
  std::vector<PointTrack> tracks = Tracks();
  for (int i = 0; i < 20; ++i) reader->Read(image, 0.001, &tracks);
  return tracks;
}

TEST(DepthReader, FindsNothingWrongWithAMeasurement) {
  DepthReader reader;
  const auto tracks = Read(Slope(), &reader);
  EXPECT_EQ(reader.Finding(), "");
  EXPECT_NEAR(tracks[0].depth.value(), 2.01, 1e-9);
}

TEST(DepthReader, UsesNoConstantDepth) {
  DepthReader reader;
  const auto tracks = Read(cv::Mat(40, 120, CV_16UC1, cv::Scalar(7000)), &reader);
  EXPECT_THAT(reader.Finding(), HasSubstr("the same value everywhere, 7.000 m"));
  for (const PointTrack& track : tracks) EXPECT_FALSE(track.depth);
  Read(Slope(), &reader);
  EXPECT_EQ(reader.Finding(), "");
}

TEST(DepthReader, NamesImagesWithoutAValidValue) {
  for (const cv::Mat& image :
       {cv::Mat(40, 120, CV_16UC1, cv::Scalar(0)), cv::Mat(40, 120, CV_16UC1, cv::Scalar(65535)),
        cv::Mat(40, 120, CV_32FC1, cv::Scalar(std::nan("")))}) {
    DepthReader reader;
    Read(image, &reader);
    EXPECT_THAT(reader.Finding(), HasSubstr("no valid value"));
    Read(cv::Mat(), &reader);  // a missing image changes no finding
    EXPECT_THAT(reader.Finding(), HasSubstr("no valid value"));
  }
}

}  // namespace

}  // namespace plm_vins
