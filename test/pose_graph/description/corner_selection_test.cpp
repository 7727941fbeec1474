// SPDX-License-Identifier: BSD-3-Clause
#include "pose_graph/description/corner_selection.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <opencv2/imgproc.hpp>

namespace plm_vins {
namespace {

// Bright squares on black: four corners each, at most two of which share a cell.
cv::Mat Squares(const std::vector<cv::Point>& places, const std::vector<int>& brightness) {
  cv::Mat gray(240, 320, CV_8UC1, cv::Scalar(0));
  for (size_t i = 0; i < places.size(); ++i) {
    cv::rectangle(gray, cv::Rect(places[i], cv::Size(12, 12)), cv::Scalar(brightness[i]), -1);
  }
  cv::GaussianBlur(gray, gray, cv::Size(3, 3), 0.7);  // else neighbours are equally strong
  return gray;
}

TEST(SelectCorners, TakesTheStrongestOfEachCellStrongestFirst) {
  const cv::Mat gray = Squares({{70, 70}, {134, 134}}, {100, 200});
  const auto corners = SelectCorners(CornerSelectionOptions(), gray, {});
  ASSERT_EQ(corners.size(), 2u);
  EXPECT_NEAR(corners[0].x(), 140, 8);
  EXPECT_NEAR(corners[1].x(), 76, 8);
}

TEST(SelectCorners, LeavesCellsThatHaveACorner) {
  const cv::Mat gray = Squares({{70, 70}, {134, 134}}, {100, 200});
  const auto corners = SelectCorners(CornerSelectionOptions(), gray, {{140, 140}});
  ASSERT_EQ(corners.size(), 1u);
  EXPECT_NEAR(corners[0].x(), 76, 8);
}

TEST(SelectCorners, StopsAtTheMostThereMayBeWithTheKnown) {
  const cv::Mat gray = Squares({{70, 70}, {134, 134}}, {100, 200});
  CornerSelectionOptions options;
  options.max_corners = 2;
  EXPECT_EQ(SelectCorners(options, gray, {{200, 200}}).size(), 1u);
  options.max_corners = 1;
  EXPECT_THAT(SelectCorners(options, gray, {{200, 200}, {210, 30}}), testing::IsEmpty());
}

TEST(SelectCorners, KeepsAwayFromTheBorder) {
  EXPECT_THAT(SelectCorners(CornerSelectionOptions(), Squares({{5, 5}}, {200}), {}),
              testing::IsEmpty());
}

}  // namespace
}  // namespace plm_vins
