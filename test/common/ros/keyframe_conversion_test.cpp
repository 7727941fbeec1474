// SPDX-License-Identifier: BSD-3-Clause
#include "common/ros/keyframe_conversion.h"

#include <gtest/gtest.h>

#include <limits>
#include <stdexcept>

namespace plm_vins {
namespace {

std::vector<TrackedCorner> Corners(const sensor_msgs::PointCloud& message) {
  int64_t left_out = 0;
  return ToCorners(message, &left_out);
}

std::vector<TrackedSegment> Segments(const sensor_msgs::PointCloud& message) {
  int64_t left_out = 0;
  return ToSegments(message, &left_out);
}

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kInfinity = std::numeric_limits<float>::infinity();

std::vector<TrackedCorner> TwoCorners() {
  std::vector<TrackedCorner> corners(2);
  corners[1].observation.id = 5;
  corners[1].observation.xy = {0.25, -0.5};
  corners[1].observation.uv_px = {300.5, 20};
  corners[1].p_O = Eigen::Vector3d(1, 2, 3);
  return corners;
}

// One channel for each point: x, y, u, v, id.
TEST(KeyframePoints, HaveTheLayoutOfVinsMono) {
  const auto message = ToKeyframePoints(TwoCorners(), 1'500'000'000, "world");
  EXPECT_EQ(message.header.frame_id, "world");
  EXPECT_EQ(message.header.stamp.nsec, 500'000'000u);
  ASSERT_EQ(message.points.size(), 1u);  // the first has no position
  EXPECT_EQ(message.points[0].z, 3);
  ASSERT_EQ(message.channels.size(), 1u);
  EXPECT_EQ(message.channels[0].values, (std::vector<float>{0.25F, -0.5F, 300.5F, 20, 5}));
}

TEST(KeyframePoints, SurviveARoundTrip) {
  const auto corners = Corners(ToKeyframePoints(TwoCorners(), 0, ""));
  ASSERT_EQ(corners.size(), 1u);
  EXPECT_EQ(corners[0].observation.id, 5);
  EXPECT_EQ(corners[0].observation.uv_px, Eigen::Vector2d(300.5, 20));
  EXPECT_EQ(*corners[0].p_O, Eigen::Vector3d(1, 2, 3));
}

TEST(KeyframePoints, CarryTheNumberOfAFurtherCamera) {
  std::vector<TrackedCorner> corners = TwoCorners();
  corners[1].observation.camera = 2;
  auto message = ToKeyframePoints(corners, 0, "");
  ASSERT_EQ(Corners(message).size(), 1u);
  EXPECT_EQ(Corners(message)[0].observation.camera, 2);
  for (const float wrong : {-1.0F, 4.0F, kNan}) {
    message.channels[0].values[5] = wrong;
    EXPECT_TRUE(Corners(message).empty()) << wrong;
  }
}

TEST(KeyframePoints, AreRejectedWithoutOneChannelEach) {
  auto message = ToKeyframePoints(TwoCorners(), 0, "");
  message.channels[0].values.pop_back();
  EXPECT_THROW(Corners(message), std::invalid_argument);
  message.channels.clear();
  EXPECT_THROW(Corners(message), std::invalid_argument);
}

// Three corners, whose second one will be damaged.
sensor_msgs::PointCloud ThreePoints() {
  std::vector<TrackedCorner> corners(3);
  for (size_t i = 0; i < corners.size(); ++i) {
    corners[i].observation.id = static_cast<int64_t>(i);
    corners[i].p_O = Eigen::Vector3d(1, 2, 3);
  }
  return ToKeyframePoints(corners, 0, "");
}

TEST(KeyframePoints, AreDroppedIfImpossible) {
  for (const int value : {0, 1, 2, 3}) {
    for (const float wrong : {kNan, kInfinity}) {
      auto message = ThreePoints();
      message.channels[1].values[value] = wrong;
      EXPECT_EQ(Corners(message).size(), 2u) << value;
    }
  }
  auto message = ThreePoints();
  message.channels[1].values[0] = 1e30F;
  EXPECT_EQ(Corners(message).size(), 2u);
  message = ThreePoints();
  message.channels[1].values[4] = 0;  // the id of the first
  EXPECT_EQ(Corners(message).size(), 2u);
}

TEST(KeyframePoints, AreDroppedAndCountedWithoutAFinitePosition) {
  auto message = ThreePoints();
  message.points[1].y = kNan;
  int64_t left_out = 0;
  const auto corners = ToCorners(message, &left_out);
  ASSERT_EQ(corners.size(), 2u);
  EXPECT_EQ(corners[1].observation.id, 2);
  EXPECT_EQ(left_out, 1);
}

TEST(KeyframePoints, AreRejectedWithAnInvalidId) {
  for (const float id : {kNan, kInfinity, 1e30F, -1.0F, 0.5F}) {
    auto message = ThreePoints();
    message.channels[1].values[4] = id;
    EXPECT_THROW(Corners(message), std::invalid_argument) << id;
  }
}

TEST(KeyframeLines, AreDroppedOrRejectedLikePoints) {
  std::vector<TrackedSegment> segments(3);
  for (size_t i = 0; i < segments.size(); ++i) {
    segments[i].observation.id = static_cast<int64_t>(i);
  }
  const auto message = ToKeyframeLines(segments, 0, "");
  EXPECT_EQ(Segments(message).size(), 3u);
  for (const int value : {0, 1, 2, 3}) {
    auto spoiled = message;
    spoiled.channels[1].values[value] = kNan;
    EXPECT_EQ(Segments(spoiled).size(), 2u) << value;
  }
  auto spoiled = message;
  spoiled.channels[1].values[4] = 2;  // the id of the last
  EXPECT_EQ(Segments(spoiled).size(), 2u);
  spoiled.channels[1].values[4] = kInfinity;
  EXPECT_THROW(Segments(spoiled), std::invalid_argument);
}

TEST(KeyframeLines, SurviveARoundTrip) {
  std::vector<TrackedSegment> segments(2);
  segments[0].observation.id = 8;
  segments[1].observation.id = 9;
  segments[0].observation.end = {0.5, 0.75};
  segments[0].landmark = {{1, 2, 3}, {4, 5, 6}};
  const auto message = ToKeyframeLines(segments, 0, "");
  const auto back = Segments(message);
  ASSERT_EQ(back.size(), 2u);
  EXPECT_FALSE(back[1].landmark);  // observed, but without a position
  EXPECT_EQ(back[0].observation.id, 8);
  EXPECT_EQ(back[0].observation.end, Eigen::Vector2d(0.5, 0.75));
  EXPECT_EQ(back[0].landmark->start_O, Eigen::Vector3d(1, 2, 3));
  EXPECT_EQ(back[0].landmark->end_O, Eigen::Vector3d(4, 5, 6));
}

}  // namespace
}  // namespace plm_vins
