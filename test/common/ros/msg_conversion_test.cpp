// SPDX-License-Identifier: BSD-3-Clause
#include "common/ros/msg_conversion.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace plm_vins {
namespace {

constexpr int64_t kCloudStamp =
    1403636579763555584;  // from EuRoC; exceeds the precision of a double

PointFrame ReadPoints(const sensor_msgs::PointCloud& message) {
  int64_t left_out = 0;
  return ToPointFrame(message, &left_out);
}

LineFrame ReadLines(const sensor_msgs::PointCloud& message) {
  int64_t left_out = 0;
  return ToLineFrame(message, &left_out);
}

PointFrame ReadBack(const PointFrame& frame) { return ReadPoints(ToMessage(frame, "camera")); }
LineFrame ReadBack(const LineFrame& frame) { return ReadLines(ToMessage(frame, "camera")); }

TEST(FeatureMessage, PointsHaveTheLayoutOfVins) {
  PointFrame frame;
  frame.t_ns = kCloudStamp;
  frame.points.push_back({42, {0.25, -0.5}, {300.5, 200.25}, {0.125, -2}});
  const sensor_msgs::PointCloud message = ToMessage(frame, "camera");
  EXPECT_EQ(message.header.frame_id, "camera");
  ASSERT_EQ(message.points.size(), 1u);
  EXPECT_EQ(message.points[0].x, 0.25f);
  EXPECT_EQ(message.points[0].y, -0.5f);
  EXPECT_EQ(message.points[0].z, 1.0f);
  ASSERT_EQ(message.channels.size(), 5u);
  const std::vector<float> values = {42, 300.5f, 200.25f, 0.125f, -2};
  for (size_t i = 0; i < 5; ++i) EXPECT_EQ(message.channels[i].values[0], values[i]);
}

TEST(FeatureMessage, AcceptsPointsOfPlVinsWithoutVelocities) {
  PointFrame frame;
  frame.points.push_back({3, {-0.75, 0.5}, {1, 2}, {0.5, 0.5}});
  sensor_msgs::PointCloud message = ToMessage(frame, "camera");
  EXPECT_TRUE(HasVelocities(message));
  message.channels.resize(3);
  EXPECT_FALSE(HasVelocities(message));
  const PointFrame read = ReadPoints(message);
  ASSERT_EQ(read.points.size(), 1u);
  EXPECT_EQ(read.points[0].uv_px, frame.points[0].uv_px);
  EXPECT_TRUE(read.points[0].velocity.isZero(0));
}

// Includes the additional channels that VINS-Fusion may send: the true positions of the points.
TEST(FeatureMessage, AcceptsPointsOfBothCamerasOfVinsFusion) {
  for (const size_t channels : {6, 9}) {
    sensor_msgs::PointCloud message;
    message.points.resize(2);
    message.points[0].x = 0.25f;
    message.points[1].x = 0.125f;
    message.channels.resize(channels);
    for (auto& channel : message.channels) channel.values.resize(2);
    const std::vector<float> first = {7, 0, 300.5f, 200.25f, 0.125f, -2};
    const std::vector<float> right = {7, 1, 280.5f, 200.25f, 0.125f, -2};
    for (size_t i = 0; i < first.size(); ++i) message.channels[i].values = {first[i], right[i]};
    int64_t left_out = 0;
    const PointFrame read = ToPointFrame(message, &left_out);
    EXPECT_TRUE(HasVelocities(message));
    EXPECT_EQ(left_out, 0);
    ASSERT_EQ(read.points.size(), 2u);
    EXPECT_EQ(read.points[0].id, 7);
    EXPECT_EQ(read.points[0].camera, 0);
    EXPECT_EQ(read.points[0].xy, Eigen::Vector2d(0.25, 0));
    EXPECT_EQ(read.points[0].uv_px, Eigen::Vector2d(300.5, 200.25));
    EXPECT_EQ(read.points[0].velocity, Eigen::Vector2d(0.125, -2));
    EXPECT_EQ(read.points[1].id, 7);
    EXPECT_EQ(read.points[1].camera, 1);
    EXPECT_EQ(read.points[1].xy, Eigen::Vector2d(0.125, 0));
    EXPECT_EQ(read.points[1].uv_px, Eigen::Vector2d(280.5, 200.25));
  }
}

TEST(FeatureMessage, CamerasAndDepthSurviveARoundTrip) {
  PointFrame frame;
  frame.t_ns = kCloudStamp;
  frame.points.push_back({1, {0.25, -0.5}, {300.5, 200.25}, {0.125, -2}});
  frame.points.push_back({16'777'215, {0.5, -0.5}, {400.5, 200.25}, {0.125, -2}, 0, 2.5});
  EXPECT_EQ(ToMessage(frame, "camera").channels.size(), 6u) << "one more for depth";
  frame.points.push_back({1, {0.125, -0.5}, {280.5, 200.25}, {0.125, -2}, 1});
  frame.points.push_back({9, {0.5, -0.25}, {100.5, 20.25}, {0.25, -1}, 3});
  const sensor_msgs::PointCloud message = ToMessage(frame, "camera");
  ASSERT_EQ(message.channels.size(), 7u);
  EXPECT_EQ(message.channels[1].name, "camera_id");
  EXPECT_EQ(message.channels[6].name, "depth");
  const PointFrame back = ReadPoints(message);
  EXPECT_EQ(back.t_ns, kCloudStamp);
  ASSERT_EQ(back.points.size(), 4u);
  for (size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(back.points[i].id, frame.points[i].id);
    EXPECT_EQ(back.points[i].camera, frame.points[i].camera);
    EXPECT_EQ(back.points[i].xy, frame.points[i].xy);
    EXPECT_EQ(back.points[i].uv_px, frame.points[i].uv_px);
    EXPECT_EQ(back.points[i].velocity, frame.points[i].velocity);
    EXPECT_EQ(back.points[i].depth, frame.points[i].depth);
  }
}

TEST(FeatureMessage, CamerasAreReadInTheirOrder) {
  PointFrame frame;
  frame.points.push_back({1, {0.25, -0.5}, {300.5, 200.25}, {0.125, -2}, 1});
  frame.points.push_back({2, {0.25, -0.5}, {300.5, 200.25}, {0.125, -2}, 0});
  const PointFrame back = ReadBack(frame);
  ASSERT_EQ(back.points.size(), 2u);
  EXPECT_EQ(back.points[0].id, 2);
}

TEST(FeatureMessage, ImpossibleCamerasAreDropped) {
  PointFrame frame;
  frame.points.push_back({1, {0.25, -0.5}, {300.5, 200.25}, {0.125, -2}, 1});
  sensor_msgs::PointCloud message = ToMessage(frame, "camera");
  for (const float camera : {-1.0f, 4.0f, std::nanf("")}) {
    message.channels[1].values[0] = camera;
    int64_t left_out = 0;
    EXPECT_TRUE(ToPointFrame(message, &left_out).points.empty());
    EXPECT_EQ(left_out, 1);
  }
}

TEST(FeatureMessage, LinesOfFurtherCamerasSurviveARoundTrip) {
  LineFrame frame;
  frame.t_ns = kCloudStamp;
  frame.lines.push_back({7, {0.25, -0.5}, {0.5, 0.125}});
  frame.lines.push_back({7, {0.125, -0.5}, {0.375, 0.125}, 1, {0.25, 0.5}});
  const sensor_msgs::PointCloud message = ToMessage(frame, "camera");
  EXPECT_EQ(message.channels.size(), 6u);
  const LineFrame back = ReadLines(message);
  EXPECT_EQ(back.t_ns, kCloudStamp);
  ASSERT_EQ(back.lines.size(), 2u);
  EXPECT_EQ(back.lines[0].id, 7);
  EXPECT_EQ(back.lines[0].end, frame.lines[0].end);
  EXPECT_EQ(back.lines[0].camera, 0);
  EXPECT_TRUE(back.lines[0].deviation.isZero(0));
  EXPECT_EQ(back.lines[1].camera, 1);
  EXPECT_EQ(back.lines[1].start, frame.lines[1].start);
  EXPECT_EQ(back.lines[1].end, frame.lines[1].end);
  EXPECT_EQ(back.lines[1].deviation, frame.lines[1].deviation);
}

TEST(FeatureMessage, LinesHaveTheLayoutOfPlVins) {
  LineFrame frame;
  frame.t_ns = kCloudStamp;
  frame.lines.push_back({42, {0.25, -0.5}, {0.5, 0.125}});
  const sensor_msgs::PointCloud message = ToMessage(frame, "camera");
  ASSERT_EQ(message.points.size(), 1u);
  EXPECT_EQ(message.points[0].x, 0.25f);
  EXPECT_EQ(message.points[0].y, -0.5f);
  EXPECT_EQ(message.points[0].z, 1.0f);
  ASSERT_EQ(message.channels.size(), 3u);
  const std::vector<float> values = {42, 0.5f, 0.125f};
  for (size_t i = 0; i < 3; ++i) EXPECT_EQ(message.channels[i].values[0], values[i]);
}

TEST(FeatureMessage, IdsTravelModulo24Bits) {
  LineFrame frame;
  frame.lines.push_back({(int64_t{1} << 24) + 1, {0, 0}, {1, 1}});  // not representable as float32
  EXPECT_EQ(ReadBack(frame).lines[0].id, 1);
}

TEST(FeatureMessage, RejectsAmbiguousIds) {
  LineFrame frame;
  frame.lines.push_back({7, {0, 0}, {1, 1}});
  for (const float id : {16'777'216.0f, -1.0f, 0.5f, std::numeric_limits<float>::quiet_NaN()}) {
    sensor_msgs::PointCloud message = ToMessage(frame, "camera");
    message.channels[0].values[0] = id;
    EXPECT_THROW(ReadLines(message), std::invalid_argument) << id;
  }
}

TEST(FeatureMessage, RejectsMissingChannels) {
  PointFrame frame;
  frame.points.resize(2);
  sensor_msgs::PointCloud message = ToMessage(frame, "camera");
  message.channels[3].values.pop_back();
  EXPECT_THROW(ReadPoints(message), std::invalid_argument);
  message.channels.resize(2);
  EXPECT_THROW(ReadPoints(message), std::invalid_argument);
  message.channels.clear();
  EXPECT_THROW(ReadLines(message), std::invalid_argument);
}

TEST(FeatureMessage, ImpossiblePointsAndRepeatedIdsAreDroppedAndCounted) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  PointFrame frame;
  frame.points.push_back({1, {0.25, -0.5}, {0, 0}, {0, 0}});
  frame.points.push_back({1, {0.75, -0.5}, {0, 0}, {0, 0}});
  frame.points.push_back({2, {nan, 0}, {0, 0}, {0, 0}});
  frame.points.push_back({3, {0, 1e30}, {0, 0}, {0, 0}});
  frame.points.push_back({4, {0, 0}, {0, 0}, {0, -1.0 / 0.0}});
  frame.points.push_back({5, {0, 0}, {nan, 0}, {0, 0}});
  frame.points.push_back({6, {0, 0}, {0, 1e30}, {0, 0}});
  frame.points.push_back({2, {0, 0}, {0, 0}, {0, 0}});
  int64_t left_out = 5;
  const PointFrame back = ToPointFrame(ToMessage(frame, "camera"), &left_out);
  EXPECT_EQ(left_out, 5 + 6);
  ASSERT_EQ(back.points.size(), 2u);
  EXPECT_EQ(back.points[0].xy.x(), 0.25);
  EXPECT_EQ(back.points[1].id, 2);
}

TEST(FeatureMessage, FeaturesBeyondFiveThousandAreDroppedAndCounted) {
  PointFrame points;
  LineFrame lines;
  for (int i = 0; i < 6000; ++i) {
    points.points.push_back({i, {0.25, -0.5}, {0, 0}, {0, 0}});
    lines.lines.push_back({i, {0.25, -0.5}, {0.5, 0.125}});
  }
  int64_t left_out = 0;
  EXPECT_EQ(ToPointFrame(ToMessage(points, "camera"), &left_out).points.back().id, 4999);
  EXPECT_EQ(left_out, 1000);
  EXPECT_EQ(ToLineFrame(ToMessage(lines, "camera"), &left_out).lines.size(), 5000u);
  EXPECT_EQ(left_out, 2000);
}

TEST(FeatureMessage, RejectsInvalidStamps) {
  sensor_msgs::PointCloud points = ToMessage(PointFrame{kCloudStamp, {}}, "camera");
  sensor_msgs::PointCloud lines = ToMessage(LineFrame{kCloudStamp, {}}, "camera");
  points.header.stamp.sec = lines.header.stamp.sec = std::numeric_limits<uint32_t>::max();
  points.header.stamp.nsec = lines.header.stamp.nsec = 999'999'999;
  EXPECT_NO_THROW(ReadPoints(points));
  EXPECT_NO_THROW(ReadLines(lines));
  points.header.stamp.nsec = lines.header.stamp.nsec = 1'000'000'000;
  EXPECT_THROW(ReadPoints(points), std::invalid_argument);
  EXPECT_THROW(ReadLines(lines), std::invalid_argument);
}

TEST(FeatureMessage, ImpossibleLinesAndRepeatedIdsAreDroppedAndCounted) {
  LineFrame frame;
  frame.lines.push_back({1, {0.25, -0.5}, {0.5, 0.125}});
  frame.lines.push_back({2, {0.25, -0.5}, {0.5, std::numeric_limits<double>::quiet_NaN()}});
  frame.lines.push_back({3, {-1e4, -0.5}, {0.5, 0}});
  frame.lines.push_back({1, {0.25, -0.5}, {0.75, 0.125}});
  int64_t left_out = 0;
  const LineFrame back = ToLineFrame(ToMessage(frame, "camera"), &left_out);
  EXPECT_EQ(left_out, 3);
  ASSERT_EQ(back.lines.size(), 1u);
  EXPECT_EQ(back.lines[0].end.x(), 0.5);
}

}  // namespace
}  // namespace plm_vins
