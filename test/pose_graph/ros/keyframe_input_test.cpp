// SPDX-License-Identifier: BSD-3-Clause
#include "pose_graph/ros/keyframe_input.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <map>
#include <string>
#include <vector>

#include "common/ros/camera_info_conversion.h"
#include "common/ros/keyframe_conversion.h"
#include "test/pose_graph/two_visits.h"

namespace plm_vins {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

nav_msgs::Odometry Pose() {
  nav_msgs::Odometry message;
  message.header.stamp = ros::Time(0, 5);
  message.pose.pose.orientation.z = message.pose.pose.orientation.w = std::sqrt(0.5);
  message.pose.covariance[21] = 4;  // about x of the world, which is -y of the body
  return message;
}

class KeyframeInputTest : public ::testing::Test {
 protected:
  KeyframeInputTest() {
    sensor_.cameras[0].parameters = testing::SimpleCamera()->parameters();
    sensor_.cameras[0].T_B_C = testing::LookingAhead();
    image_.create(sensor_.cameras[0].parameters.height, sensor_.cameras[0].parameters.width,
                  CV_8UC1);
    for (int i = 0; i < 4; ++i) {
      corners_.emplace_back().observation.id = segments_.emplace_back().observation.id = i;
      corners_.back().p_O = Eigen::Vector3d(1, 2, 3);
    }
  }

  // Returns a keyframe of all parts, or nullopt if a part was rejected.
  std::optional<OdometryFrame> Assemble(const nav_msgs::Odometry& pose) {
    KeyframeInput input(sensor_);
    return Assemble(pose, &input);
  }
  std::optional<OdometryFrame> Assemble(const nav_msgs::Odometry& pose, KeyframeInput* input) {
    input->AddImage(0, {5, image_});
    input->AddPose(pose);
    input->AddPoints(ToKeyframePoints(corners_, 5, "world"));
    input->AddLines(ToKeyframeLines(segments_, 5, "world"));
    for (const DropCount& drop : input->Drops()) drops_[drop.cause] = drop.count;
    return input->Pop();
  }

  SensorConfig sensor_;
  cv::Mat image_;
  std::vector<TrackedCorner> corners_;
  std::vector<TrackedSegment> segments_;
  std::map<std::string, int64_t> drops_;  // for the last keyframe
};

TEST_F(KeyframeInputTest, HasTheFramesOfAKeyframe) {
  const auto frame = Assemble(Pose());
  ASSERT_TRUE(frame);
  EXPECT_EQ(frame->corners.size(), 4u);
  EXPECT_EQ(frame->segments.size(), 4u);
  EXPECT_EQ(frame->T_B_C[0].translation, sensor_.cameras[0].T_B_C.translation);
  EXPECT_NEAR(frame->covariance(4, 4), 4, 1e-12);
  EXPECT_NEAR(frame->covariance(3, 3), 0, 1e-12);
  for (const auto& [cause, count] : drops_) EXPECT_EQ(count, 0) << cause;
}

TEST_F(KeyframeInputTest, UsesEstimatedExtrinsics) {
  KeyframeInput input(sensor_);
  nav_msgs::Odometry extrinsics = Pose();
  extrinsics.pose.pose.position.x = 0.25;
  input.AddExtrinsics(0, extrinsics);
  extrinsics.pose.pose.position.x = kNan;
  input.AddExtrinsics(0, extrinsics);
  const auto frame = Assemble(Pose(), &input);
  ASSERT_TRUE(frame);
  EXPECT_EQ(frame->T_B_C[0].translation.x(), 0.25);
  EXPECT_NEAR(frame->T_B_C[0].rotation.z(), std::sqrt(0.5), 1e-12);
}

// An unknown covariance is 1e6 in the message, which would make the odometry edge useless.
TEST_F(KeyframeInputTest, UnknownCovarianceIsNullopt) {
  nav_msgs::Odometry pose = Pose();
  for (size_t i = 0; i < 36; i += 7) pose.pose.covariance[i] = 1e6;
  const auto frame = Assemble(pose);
  ASSERT_TRUE(frame);
  EXPECT_TRUE(frame->covariance.isZero());
}

TEST_F(KeyframeInputTest, RejectsImagesOfAnotherFormat) {
  const cv::Mat whole = image_;
  for (const cv::Mat& image : {cv::Mat(whole.rowRange(0, 4)), cv::Mat(whole.size(), CV_8UC3)}) {
    image_ = image;
    EXPECT_FALSE(Assemble(Pose()));
    EXPECT_EQ(drops_["images_wrong_format"], 1);
  }
}

TEST_F(KeyframeInputTest, RejectsImpossiblePoses) {
  std::vector<nav_msgs::Odometry> poses(4, Pose());
  poses[0].pose.pose.position.y = kNan;
  poses[1].pose.pose.orientation.x = std::numeric_limits<double>::infinity();
  poses[2].pose.pose.orientation.w = 0;
  poses[3].pose.covariance[1] = kNan;
  for (const nav_msgs::Odometry& pose : poses) {
    EXPECT_FALSE(Assemble(pose));
    EXPECT_EQ(drops_["poses_impossible"], 1);
  }
}

TEST_F(KeyframeInputTest, AcceptsSinglePrecisionQuaternions) {
  nav_msgs::Odometry pose = Pose();
  pose.pose.pose.orientation.w *= 1 + 1e-6;
  const auto frame = Assemble(pose);
  ASSERT_TRUE(frame);
  EXPECT_NEAR(frame->T_O_B.rotation.norm(), 1, 1e-12);
}

TEST_F(KeyframeInputTest, DropsImpossibleFeatures) {
  corners_[1].p_O->z() = kNan;
  corners_[2].observation.uv_px.x() = kNan;
  segments_[0].observation.end.x() = kNan;
  const auto frame = Assemble(Pose());
  ASSERT_TRUE(frame);
  ASSERT_EQ(frame->corners.size(), 2u);
  EXPECT_EQ(frame->corners[1].observation.id, 3);
  EXPECT_EQ(frame->segments.size(), 3u);
  EXPECT_EQ(drops_["places_impossible"], 3);
}

TEST_F(KeyframeInputTest, CountsMessagesOfAnotherLayout) {
  KeyframeInput input(sensor_);
  sensor_msgs::PointCloud message = ToKeyframePoints(corners_, 5, "world");
  message.channels[2].values.resize(3);
  input.AddPoints(message);
  message.channels[2].values.resize(5);
  input.AddLines(message);  // two points for each
  const DropCount malformed = input.Drops().front();
  EXPECT_EQ(malformed.cause, "keyframe_messages_malformed");
  EXPECT_EQ(malformed.count, 2);
  EXPECT_FALSE(malformed.detail.empty());
}

TEST_F(KeyframeInputTest, UsesRefinedIntrinsics) {
  KeyframeInput input(sensor_);
  CameraParameters refined = sensor_.cameras[0].parameters;
  for (const double change_px : {1.0, 2.0}) {
    refined.fx += change_px;
    input.AddCamera(0, ToCameraInfo(refined, 5, "camera"));
  }
  const auto frame = Assemble(Pose(), &input);
  ASSERT_TRUE(frame);
  EXPECT_EQ(frame->refined[0].fx, sensor_.cameras[0].parameters.fx + 3);
}

TEST_F(KeyframeInputTest, RejectsAnotherCamera) {
  KeyframeInput input(sensor_);
  CameraParameters refined = sensor_.cameras[0].parameters;
  refined.fx += 1;
  input.AddCamera(0, ToCameraInfo(refined, 5, "camera"));
  EXPECT_EQ(input.Drops().back().count, 0);
  refined.width /= 2;
  input.AddCamera(0, ToCameraInfo(refined, 5, "camera"));
  EXPECT_EQ(input.Drops().back().cause, "cameras_refused");
  EXPECT_EQ(input.Drops().back().count, 1);
}

}  // namespace
}  // namespace plm_vins
