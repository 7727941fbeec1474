// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <diagnostic_updater/DiagnosticStatusWrapper.h>
#include <ros/time.h>

#include <cstdint>
#include <mutex>
#include <optional>
#include <string>

namespace plm_vins {

// Monitors the messages of one topic for diagnostics: rate, delay, silence. Thread-safe.
class StreamMonitor {
 public:
  static constexpr double kSilence = 1.0;  // [s] until the status is "waiting"

  explicit StreamMonitor(const std::string& name) : name_(name) {}

  // Reports a message with this timestamp, received or sent now.
  void Add(int64_t t_ns);

  bool HasMessages() const;

  // Wall time since the last message, or since construction if there was none [s].
  double Silence() const;

  // Describes the longest stall of the transport: how much later a message arrived after the
  // previous one than their timestamps say.
  std::string DescribeStall() const;

  // Adds NAME_longest_stall_ms since construction, NAME_rate_hz and, if there were messages,
  // NAME_delay_ms, their mean age on arrival, both since the last call.
  void Report(diagnostic_updater::DiagnosticStatusWrapper* status);

 private:
  const std::string name_;
  mutable std::mutex mutex_;  // guards the following members
  ros::WallTime last_arrival_ = ros::WallTime::now();
  ros::WallTime last_report_ = ros::WallTime::now();
  std::optional<int64_t> last_ns_;  // timestamp of the last message
  double longest_stall_ = 0;        // [s]
  int messages_ = 0;                // since the last report
  double summed_delay_ = 0;         // total delay of these messages [s]
};

}  // namespace plm_vins
