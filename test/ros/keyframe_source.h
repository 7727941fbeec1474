// SPDX-License-Identifier: BSD-3-Clause
// Publishers in place of an estimator and a camera, for tests of the pose graph.
#pragma once

#include <nav_msgs/Odometry.h>
#include <ros/ros.h>
#include <sensor_msgs/CompressedImage.h>
#include <sensor_msgs/Image.h>
#include <sensor_msgs/PointCloud.h>
#include <std_msgs/Bool.h>

#include <opencv2/imgcodecs.hpp>
#include <string>
#include <vector>

#include "common/ros/geometry_conversion.h"
#include "common/ros/keyframe_conversion.h"
#include "test/ros/estimator_log.h"

namespace plm_vins::testing {

// A camera as in the configuration for EuRoC.
class Camera {
 public:
  explicit Camera(const std::string& transport) {
    ros::NodeHandle node;
    if (transport == "compressed") {
      publisher_ = node.advertise<sensor_msgs::CompressedImage>("/cam0/image_raw/compressed", 100);
    } else {
      publisher_ = node.advertise<sensor_msgs::Image>("/cam0/image_raw", 100);
    }
    compressed_ = transport == "compressed";
  }

  bool WaitForSubscriber() const {
    return SpinUntil(20, [&] { return publisher_.getNumSubscribers() > 0; });
  }

  void Publish(const ros::Time& stamp, const cv::Mat& gray) const {
    if (compressed_) {
      sensor_msgs::CompressedImage message;
      message.header.stamp = stamp;
      message.format = "jpeg";
      cv::imencode(".jpg", gray, message.data);
      return publisher_.publish(message);
    }
    sensor_msgs::Image message;
    message.header.stamp = stamp;
    message.encoding = "mono8";
    message.width = message.step = gray.cols;
    message.height = gray.rows;
    message.data.assign(gray.datastart, gray.dataend);
    publisher_.publish(message);
  }

  // Publishes an image with an encoding that cannot be converted to gray.
  void PublishDepth(const ros::Time& stamp) const {
    sensor_msgs::Image message;
    message.header.stamp = stamp;
    message.encoding = "64FC4";
    message.width = message.height = 1;
    message.step = 32;
    message.data.resize(32);
    publisher_.publish(message);
  }

 private:
  bool compressed_ = false;
  ros::Publisher publisher_;
};

// Publishes keyframes 0.5 m and 0.5 s apart, by number. Each object is a separate publisher, like a
// restarted estimator.
class KeyframeSource {
 public:
  explicit KeyframeSource(const std::string& name_space)
      : pose_(Advertise<nav_msgs::Odometry>(name_space + "keyframe_pose")),
        points_(Advertise<sensor_msgs::PointCloud>(name_space + "keyframe_point")),
        lines_(Advertise<sensor_msgs::PointCloud>(name_space + "keyframe_line")),
        odometry_(Advertise<nav_msgs::Odometry>(name_space + "odometry")),
        restart_(Advertise<std_msgs::Bool>(name_space + "restart")) {}

  bool WaitForSubscriber() const {
    return SpinUntil(20, [&] {
      return pose_.getNumSubscribers() > 0 && points_.getNumSubscribers() > 0 &&
             lines_.getNumSubscribers() > 0 && odometry_.getNumSubscribers() > 0 &&
             restart_.getNumSubscribers() > 0;
    });
  }

  static ros::Time Stamp(int number) { return ros::Time(100) + ros::Duration(0.5 * number); }

  static nav_msgs::Odometry Pose(int number) {
    nav_msgs::Odometry message;
    message.header.stamp = Stamp(number);
    message.header.frame_id = "world";
    message.pose.pose.position.x = 0.5 * number;
    message.pose.pose.orientation.w = 1;
    for (int i = 0; i < 6; ++i) message.pose.covariance[7 * i] = 1e-6;
    return message;
  }

  void PublishPose(const nav_msgs::Odometry& pose) const { pose_.publish(pose); }
  void PublishOdometry(int number) const { odometry_.publish(Pose(number)); }

  void PublishPoints(int number) const {
    std::vector<TrackedCorner> corners(3);
    for (int i = 0; i < 3; ++i) {
      corners[i].observation.id = i;
      corners[i].observation.uv_px = {100.0 + 200 * i, 200};
      corners[i].p_O = Eigen::Vector3d(0.5 * number, i, 3);
    }
    points_.publish(ToKeyframePoints(corners, ToNanoseconds(Stamp(number)), "world"));
  }

  void PublishLines(int number) const {
    lines_.publish(ToKeyframeLines({}, ToNanoseconds(Stamp(number)), "world"));
  }

  void PublishRestart() const {
    std_msgs::Bool message;
    message.data = true;
    restart_.publish(message);
  }

  // Publishes a keyframe with its image.
  void Publish(int number, const Camera& camera, const cv::Mat& gray) const {
    camera.Publish(Stamp(number), gray);
    PublishLines(number);
    PublishPoints(number);
    PublishPose(Pose(number));
  }

 private:
  template <typename Message>
  static ros::Publisher Advertise(const std::string& topic) {
    return ros::NodeHandle().advertise<Message>(topic, 100);
  }

  ros::Publisher pose_;
  ros::Publisher points_;
  ros::Publisher lines_;
  ros::Publisher odometry_;
  ros::Publisher restart_;
};

}  // namespace plm_vins::testing
