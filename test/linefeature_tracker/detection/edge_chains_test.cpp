// SPDX-License-Identifier: BSD-3-Clause
#include "linefeature_tracker/detection/edge_chains.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <opencv2/imgproc.hpp>

namespace plm_vins {
namespace {

constexpr double kLow = 50, kHigh = 100;

cv::Mat Disc() {
  cv::Mat image(120, 160, CV_8UC1, cv::Scalar(40));
  cv::circle(image, {80, 60}, 35, cv::Scalar(200), cv::FILLED);
  return image;
}

std::vector<EdgeChain> ChainsOf(const cv::Mat& image) {
  EdgeChains chains(image, kLow, kHigh);
  std::vector<EdgeChain> all;
  for (EdgeChain chain; chains.Next(&chain);) all.push_back(chain);
  return all;
}

TEST(EdgeChains, TakeEachEdgePixelOnce) {
  cv::Mat left;
  cv::Canny(Disc(), left, kLow, kHigh);
  ASSERT_GT(cv::countNonZero(left), 150);
  for (const EdgeChain& chain : ChainsOf(Disc())) {
    for (const cv::Point& pixel : chain) {
      EXPECT_EQ(left.at<uint8_t>(pixel), 255) << pixel;
      left.at<uint8_t>(pixel) = 0;
    }
  }
  EXPECT_EQ(cv::countNonZero(left), 0);
}

TEST(EdgeChains, GoFromNeighbourToNeighbour) {
  for (const EdgeChain& chain : ChainsOf(Disc())) {
    for (size_t i = 1; i < chain.size(); ++i) {
      const cv::Point step = chain[i] - chain[i - 1];
      EXPECT_EQ(std::max(std::abs(step.x), std::abs(step.y)), 1);
    }
  }
}

TEST(EdgeChains, FollowAStraightEdgeFromBorderToBorder) {
  cv::Mat image(120, 160, CV_8UC1, cv::Scalar(40));
  image.rowRange(70, 120).setTo(200);
  const std::vector<EdgeChain> chains = ChainsOf(image);
  ASSERT_EQ(chains.size(), 1u);
  EXPECT_EQ(chains[0].size(), 160u);
  EXPECT_EQ(chains[0].front().x, 0);
  EXPECT_EQ(chains[0].back().x, 159);
}

TEST(EdgeChains, EndWhereTheyWouldTurnBack) {
  cv::Mat image(120, 160, CV_8UC1, cv::Scalar(40));
  image(cv::Rect(40, 40, 60, 60)).setTo(200);
  const std::vector<EdgeChain> chains = ChainsOf(image);
  for (const EdgeChain& chain : chains) EXPECT_LT(chain.size(), 130u);  // at most two of four sides
  EXPECT_GE(chains.size(), 2u);
}

TEST(EdgeChains, AreNoneInAUniformOrTinyImage) {
  EXPECT_TRUE(ChainsOf(cv::Mat(48, 64, CV_8UC1, cv::Scalar(128))).empty());
  EXPECT_TRUE(ChainsOf(cv::Mat(1, 1, CV_8UC1, cv::Scalar(128))).empty());
}

}  // namespace
}  // namespace plm_vins
