// SPDX-License-Identifier: BSD-3-Clause
#include "feature_tracker/depth_reader.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace plm_vins {
namespace {

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
