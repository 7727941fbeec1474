// SPDX-License-Identifier: BSD-3-Clause
// Records the output of the estimator's node.
#pragma once

#include <diagnostic_msgs/DiagnosticArray.h>
#include <nav_msgs/Odometry.h>
#include <ros/ros.h>

#include <functional>
#include <map>
#include <string>
#include <vector>

namespace plm_vins::testing {

// Processes ROS callbacks until the condition holds. Returns false after `seconds` of wall time.
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

  // The last status: its values by key, and its text as "message".
  std::string Value(const std::string& key) const {
    const auto value = status_.find(key);
    return value == status_.end() ? "" : value->second;
  }
  int64_t Count(const std::string& key) const {
    const std::string value = Value(key);
    return value.empty() ? -1 : std::stoll(value);
  }

  // Waits for the next status.
  bool NextStatus() {
    const int seen = statuses_;
    return SpinUntil(20, [&] { return statuses_ > seen; });
  }

  // Waits until the estimator has processed all published messages: until the counts no longer
  // change.
  bool WaitUntilDone() {
    int64_t before = -1;
    do {
      before = Count("frames");
      if (!NextStatus() || !NextStatus()) return false;
    } while (Count("frames") != before || Count("queued") > 0);
    return true;
  }

  // Waits for a status that satisfies the condition.
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
