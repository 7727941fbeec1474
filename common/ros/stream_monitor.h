// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <diagnostic_updater/DiagnosticStatusWrapper.h>
#include <ros/time.h>

#include <cstdint>
#include <mutex>
#include <string>

namespace plm_vins {

// How the messages of one topic come along, for diagnostics: rate, age, silence. For any threads.
class StreamMonitor {
 public:
  static constexpr double kSilence = 1.0;  // [s] without a message: the topic is waited for

  explicit StreamMonitor(const std::string& name) : name_(name) {}

  // A message of this stamp came, or was sent, now.
  void Add(int64_t t_ns);

  // Wall time since the last message, or since construction where there was none [s].
  double Silence() const;

  // Adds NAME_rate_hz and, where messages came, NAME_delay_ms, the mean age of their stamps on
  // arrival. Both are of the messages since the last call.
  void Report(diagnostic_updater::DiagnosticStatusWrapper* status);

 private:
  const std::string name_;
  mutable std::mutex mutex_;  // guards what follows
  ros::WallTime last_arrival_ = ros::WallTime::now();
  ros::WallTime last_report_ = ros::WallTime::now();
  int messages_ = 0;         // since the last report
  double summed_delay_ = 0;  // of these [s]
};

}  // namespace plm_vins
