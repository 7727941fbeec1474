// SPDX-License-Identifier: BSD-3-Clause
// Publishes messages in the formats of VINS-Mono's and PL-VINS' trackers on a simulated flight.
#pragma once

#include <ros/ros.h>
#include <sensor_msgs/Imu.h>
#include <sensor_msgs/PointCloud.h>
#include <std_msgs/Bool.h>

#include <functional>
#include <vector>

#include "common/ros/geometry_conversion.h"
#include "common/ros/msg_conversion.h"
#include "test/feature_simulator/feature_simulator.h"

namespace plm_vins::testing {

// Messages for one image: point and line frames by number, in this order.
struct ImageMessages {
  enum class Kind { kPoints, kLines };
  struct Message {
    Kind kind;
    size_t image;
  };
  std::vector<Message> messages;
  bool with_velocities = true;  // false: as from the point tracker of PL-VINS
};

class PeerTrackers {
 public:
  explicit PeerTrackers(const simulator::FeatureDataset& flight) : flight_(flight) {}

  size_t images() const { return flight_.points.size(); }

  // Waits until the estimator has subscribed to all topics.
  void WaitForEstimator() const {
    while (ros::ok() && (imu_.getNumSubscribers() == 0 || points_.getNumSubscribers() == 0 ||
                         lines_.getNumSubscribers() == 0 || restart_.getNumSubscribers() == 0)) {
      ros::WallDuration(0.02).sleep();
    }
  }

  void PublishRestart() const {
    std_msgs::Bool restart;
    restart.data = true;
    restart_.publish(restart);
  }

  // Publishes the images from `begin` to before `end` at intervals of `period` [s] of wall time,
  // divided by the parameter ~rate, for slow estimators.
  void Play(size_t begin, size_t end, double period,
            const std::function<ImageMessages(size_t)>& messages_of) const {
    for (size_t i = begin; i < end && ros::ok(); ++i) {
      const ImageMessages image = messages_of(i);
      PublishImu(i);
      for (const auto& message : image.messages) Publish(image, message);
      ros::WallDuration(period / rate_).sleep();
      ros::spinOnce();
    }
  }

  // Unnamed channels: id, u, v, velocity x, velocity y; ids as with a single camera.
  static sensor_msgs::PointCloud ToVinsMono(const PointFrame& frame) {
    sensor_msgs::PointCloud cloud = EmptyCloud(frame.t_ns, 5);
    for (const PointObservation& point : frame.points) {
      AddPoint(point.xy, &cloud);
      AddValues({static_cast<float>(point.id), static_cast<float>(point.uv_px.x()),
                 static_cast<float>(point.uv_px.y()), static_cast<float>(point.velocity.x()),
                 static_cast<float>(point.velocity.y())},
                &cloud);
    }
    return cloud;
  }

  // Points are the starts of lines; unnamed channels: id, x and y of the end.
  static sensor_msgs::PointCloud ToPlVins(const LineFrame& frame) {
    sensor_msgs::PointCloud cloud = EmptyCloud(frame.t_ns, 3);
    for (const LineObservation& line : frame.lines) {
      AddPoint(line.start, &cloud);
      AddValues({static_cast<float>(line.id), static_cast<float>(line.end.x()),
                 static_cast<float>(line.end.y())},
                &cloud);
    }
    return cloud;
  }

 private:
  void Publish(const ImageMessages& image, const ImageMessages::Message& message) const {
    if (message.kind == ImageMessages::Kind::kLines) {
      return lines_.publish(ToPlVins(flight_.lines[message.image]));
    }
    sensor_msgs::PointCloud cloud = ToVinsMono(flight_.points[message.image]);
    if (!image.with_velocities) cloud.channels.resize(3);
    points_.publish(cloud);
  }

  static sensor_msgs::PointCloud EmptyCloud(int64_t t_ns, size_t channels) {
    sensor_msgs::PointCloud cloud;
    cloud.header.stamp = ToRosTime(t_ns);
    cloud.header.frame_id = "world";
    cloud.channels.resize(channels);
    return cloud;
  }

  static void AddPoint(const Eigen::Vector2d& xy, sensor_msgs::PointCloud* cloud) {
    geometry_msgs::Point32 point;
    point.x = static_cast<float>(xy.x());
    point.y = static_cast<float>(xy.y());
    point.z = 1;
    cloud->points.push_back(point);
  }

  static void AddValues(const std::vector<float>& values, sensor_msgs::PointCloud* cloud) {
    for (size_t i = 0; i < values.size(); ++i) cloud->channels[i].values.push_back(values[i]);
  }

  // Publishes the samples from the previous image up to this one.
  void PublishImu(size_t image) const {
    const int64_t begin = image == 0 ? 0 : flight_.points[image - 1].t_ns;
    for (size_t i = 0; i < flight_.imu.size(); ++i) {
      const ImuSample& sample = flight_.imu[i];
      if (sample.t_ns < begin) continue;
      if (sample.t_ns >= flight_.points[image].t_ns) break;
      sensor_msgs::Imu message;
      message.header.stamp = ToRosTime(sample.t_ns);
      message.angular_velocity = ToVector3(sample.gyro);
      message.linear_acceleration = ToVector3(sample.accel);
      imu_.publish(message);
    }
  }

  const simulator::FeatureDataset& flight_;
  double rate_ = ros::NodeHandle("~").param("rate", 1.0);
  ros::NodeHandle node_;
  ros::Publisher imu_ = node_.advertise<sensor_msgs::Imu>("/imu0", 2000);
  ros::Publisher points_ =
      node_.advertise<sensor_msgs::PointCloud>("/feature_tracker/feature", 200);
  ros::Publisher lines_ =
      node_.advertise<sensor_msgs::PointCloud>("/linefeature_tracker/linefeature", 200);
  ros::Publisher restart_ = node_.advertise<std_msgs::Bool>("/feature_tracker/restart", 10);
};

}  // namespace plm_vins::testing
