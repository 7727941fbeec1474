// SPDX-License-Identifier: BSD-3-Clause
#include "linefeature_tracker/detection/chain_segments.h"

#include <gtest/gtest.h>

#include <cmath>

namespace plm_vins {
namespace {

constexpr StraightnessLimits kLimits = {20, 1.414};

EdgeChain Pixels(const Eigen::Vector2d& from, const Eigen::Vector2d& to) {
  const double steps = (to - from).lpNorm<Eigen::Infinity>();
  EdgeChain chain;
  for (int i = 0; i <= steps; ++i) {
    const Eigen::Vector2d pixel = from + i / steps * (to - from);
    chain.emplace_back(static_cast<int>(std::lround(pixel.x())),
                       static_cast<int>(std::lround(pixel.y())));
  }
  return chain;
}

EdgeChain Joined(EdgeChain first, const EdgeChain& second) {
  first.insert(first.end(), second.begin() + 1, second.end());
  return first;
}

std::vector<LineSegment> SegmentsOf(const EdgeChain& chain) {
  std::vector<LineSegment> segments;
  AppendSegments(chain, kLimits, &segments);
  return segments;
}

TEST(ChainSegments, FitAStraightEdge) {
  const LineSegment truth = {{10, 20}, {110, 57}};
  const auto segments = SegmentsOf(Pixels(truth.start, truth.end));
  ASSERT_EQ(segments.size(), 1u);
  EXPECT_LT((segments[0].start - truth.start).norm(), 0.5);
  EXPECT_LT((segments[0].end - truth.end).norm(), 0.5);
  EXPECT_LT(UndirectedAngle(segments[0], truth), 2e-3);
}

TEST(ChainSegments, FitInEveryDirection) {
  for (int degrees = 0; degrees < 360; degrees += 15) {
    const double angle = degrees * M_PI / 180;
    const Eigen::Vector2d direction(std::cos(angle), std::sin(angle));
    const LineSegment truth = {{100, 100}, Eigen::Vector2d(100, 100) + 70 * direction};
    const auto segments = SegmentsOf(Pixels(truth.start, truth.end));
    ASSERT_EQ(segments.size(), 1u) << degrees;
    EXPECT_LT(DirectedAngle(segments[0], truth), 0.01) << degrees;
    EXPECT_NEAR(segments[0].Length(), 70, 1) << degrees;
  }
}

TEST(ChainSegments, AreCutAtACorner) {
  const Eigen::Vector2d corner(80, 30);
  const auto segments = SegmentsOf(Joined(Pixels({10, 30}, corner), Pixels(corner, {80, 90})));
  ASSERT_EQ(segments.size(), 2u);
  EXPECT_LT((segments[0].end - corner).norm(), 3);
  EXPECT_LT((segments[1].start - corner).norm(), 3);
  EXPECT_NEAR(UndirectedAngle(segments[0], segments[1]), M_PI / 2, 0.06);
}

TEST(ChainSegments, NeedEnoughPixels) {
  EXPECT_EQ(SegmentsOf(Pixels({10, 20}, {30, 20})).size(), 1u);
  EXPECT_TRUE(SegmentsOf(Pixels({10, 20}, {29, 20})).empty());
  EXPECT_TRUE(SegmentsOf({}).empty());
  EXPECT_TRUE(SegmentsOf({{5, 5}}).empty());
}

TEST(ChainSegments, AreNoneOnATightCurve) {
  EdgeChain circle;
  for (double angle = 0; angle < 2 * M_PI; angle += 0.05) {
    circle.emplace_back(std::lround(40 + 15 * std::cos(angle)),
                        std::lround(40 + 15 * std::sin(angle)));
  }
  EXPECT_TRUE(SegmentsOf(circle).empty());
}

TEST(ChainSegments, AreAppended) {
  std::vector<LineSegment> segments(3);
  AppendSegments(Pixels({10, 20}, {60, 20}), kLimits, &segments);
  EXPECT_EQ(segments.size(), 4u);
}

}  // namespace
}  // namespace plm_vins
