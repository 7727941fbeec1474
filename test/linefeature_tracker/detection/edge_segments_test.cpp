// SPDX-License-Identifier: BSD-3-Clause
#include "linefeature_tracker/detection/edge_segments.h"

#include <gtest/gtest.h>

#include <opencv2/imgproc.hpp>

namespace plm_vins {
namespace {

cv::Mat DrawEdges(const std::vector<cv::Point>& corners, bool closed = false) {
  cv::Mat edges(240, 320, CV_8UC1, cv::Scalar(0));
  cv::polylines(edges, corners, closed, 255);
  return edges;
}

// Distance of the farther end point of `segment` from those of a side, in either order [px].
double ErrorTo(const cv::Point& a, const cv::Point& b, const LineSegment& segment) {
  const Eigen::Vector2d start(a.x, a.y), end(b.x, b.y);
  const auto error = [&](const LineSegment& s) {
    return std::max((s.start - start).norm(), (s.end - end).norm());
  };
  return std::min(error(segment), error(segment.Reversed()));
}

bool IsFound(const cv::Point& a, const cv::Point& b, const std::vector<LineSegment>& segments) {
  return std::any_of(segments.begin(), segments.end(),
                     [&](const LineSegment& segment) { return ErrorTo(a, b, segment) < 4; });
}

TEST(EdgeSegments, FindsALineInAnyDirection) {
  for (int degrees = 0; degrees < 180; degrees += 5) {
    const double angle = degrees * CV_PI / 180;
    const cv::Point from(160, 120);
    const cv::Point to(cvRound(160 + 90 * std::cos(angle)), cvRound(120 + 90 * std::sin(angle)));
    cv::Mat edges = DrawEdges({from, to});
    const auto segments = FindStraightEdges(30, &edges);
    ASSERT_EQ(segments.size(), 1u) << degrees << " deg";
    EXPECT_LT(ErrorTo(from, to, segments[0]), 0.7) << degrees << " deg";
    EXPECT_EQ(cv::countNonZero(edges), 0);
  }
}

TEST(EdgeSegments, SplitsAtCorners) {
  const std::vector<cv::Point> corners = {{40, 30}, {240, 60}, {200, 200}, {60, 180}};
  cv::Mat edges = DrawEdges(corners, /*closed=*/true);
  const auto segments = FindStraightEdges(40, &edges);
  for (size_t i = 0; i < corners.size(); ++i) {
    EXPECT_TRUE(IsFound(corners[i], corners[(i + 1) % corners.size()], segments)) << "side " << i;
  }
}

TEST(EdgeSegments, DropsShortPartsAndCurves) {
  cv::Mat edges = DrawEdges({{40, 30}, {65, 30}, {65, 55}});
  EXPECT_EQ(FindStraightEdges(20, &edges).size(), 2u);
  edges = DrawEdges({{40, 30}, {65, 30}, {65, 55}});
  EXPECT_TRUE(FindStraightEdges(30, &edges).empty());
  cv::Mat circle(240, 320, CV_8UC1, cv::Scalar(0));
  cv::circle(circle, {160, 120}, 40, 255);
  EXPECT_TRUE(FindStraightEdges(40, &circle).empty());
}

TEST(EdgeSegments, SurvivesFullAndTinyImages) {
  cv::Mat full(50, 60, CV_8UC1, cv::Scalar(255));
  FindStraightEdges(10, &full);
  EXPECT_EQ(cv::countNonZero(full), 0);
  cv::Mat pixel(1, 1, CV_8UC1, cv::Scalar(255)), empty;
  EXPECT_TRUE(FindStraightEdges(0.5, &pixel).empty());
  EXPECT_TRUE(FindStraightEdges(10, &empty).empty());
}

}  // namespace
}  // namespace plm_vins
