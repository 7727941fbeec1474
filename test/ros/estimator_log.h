// SPDX-License-Identifier: BSD-3-Clause
// What the estimator's node said.
#pragma once

#include <diagnostic_msgs/DiagnosticArray.h>
#include <nav_msgs/Odometry.h>
#include <ros/ros.h>

#include <functional>
#include <map>
#include <string>
#include <vector>

namespace plm_vins::testing {

// Turns ROS until the condition holds. False: it did not within `seconds` of wall time.
inline bool SpinUntil(double seconds, const std::function<bool()>& condition) {
  const ros::WallTime end = ros::WallTime::now() + ros::WallDuration(seconds);
  while (ros::ok() && ros::WallTime::now() < end) {
    ros::spinOnce();
    if (condition()) return true;
    ros::WallDuration(0.01).sleep();
  }
  return false;
}

class EstimatorLog {
 public:
  std::vector<nav_msgs::Odometry> odometry;

  // The last status: its values by key, its text as "message".
  std::string Value(const std::string& key) const {
    const auto value = status_.find(key);
    return value == status_.end() ? "" : value->second;
  }
  int64_t Count(const std::string& key) const {
    const std::string value = Value(key);
    return value.empty() ? -1 : std::stoll(value);
  }

  // Turns ROS until the next status comes.
  bool NextStatus() {
    const int seen = statuses_;
    return SpinUntil(20, [&] { return statuses_ > seen; });
  }

  // Turns ROS until the estimator has done with all that was published: the counts stand still.
  bool WaitUntilDone() {
    int64_t before = -1;
    do {
      before = Count("frames");
      if (!NextStatus() || !NextStatus()) return false;
    } while (Count("frames") != before || Count("queued") > 0);
    return true;
  }

  // Turns ROS until a status satisfies the condition.
  bool WaitForStatus(double seconds, const std::function<bool(const EstimatorLog&)>& condition) {
    return SpinUntil(seconds, [&] { return statuses_ > 0 && condition(*this); });
  }

 private:
  void AddOdometry(const nav_msgs::Odometry& message) { odometry.push_back(message); }
  void AddDiagnostics(const diagnostic_msgs::DiagnosticArray& array) {
    for (const auto& status : array.status) {
      if (status.name != "vins_estimator: odometry") continue;
      status_ = {{"message", status.message}};
      for (const auto& value : status.values) status_[value.key] = value.value;
      ++statuses_;
    }
  }

  std::map<std::string, std::string> status_;
  int statuses_ = 0;
  ros::NodeHandle node_;
  ros::Subscriber odometry_subscriber_ =
      node_.subscribe("/vins_estimator/odometry", 10000, &EstimatorLog::AddOdometry, this);
  ros::Subscriber diagnostics_subscriber_ =
      node_.subscribe("/diagnostics", 100, &EstimatorLog::AddDiagnostics, this);
};

}  // namespace plm_vins::testing
