// SPDX-License-Identifier: BSD-3-Clause
#include "common/ros/stream_monitor.h"

#include <algorithm>

#include "common/format.h"
#include "common/measurements.h"
#include "common/ros/geometry_conversion.h"

namespace plm_vins {

// Avoids ros::Duration, which throws beyond 68 years, since a timestamp can have any value.
void StreamMonitor::Add(int64_t t_ns) {
  const std::lock_guard<std::mutex> lock(mutex_);
  const ros::WallTime now = ros::WallTime::now();
  if (last_ns_ && t_ns > *last_ns_) {
    const double late = (now - last_arrival_).toSec() - ToSeconds(t_ns - *last_ns_);
    longest_stall_ = std::max(longest_stall_, late);
  }
  last_ns_ = t_ns;
  last_arrival_ = now;
  ++messages_;
  summed_delay_ += ToSeconds(ToNanoseconds(ros::Time::now()) - t_ns);
}

bool StreamMonitor::HasMessages() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return last_ns_.has_value();
}

double StreamMonitor::Silence() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return (ros::WallTime::now() - last_arrival_).toSec();
}

std::string StreamMonitor::DescribeStall() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return Format("the longest stall of %s was %.2f s", name_.c_str(), longest_stall_);
}

void StreamMonitor::Report(diagnostic_updater::DiagnosticStatusWrapper* status) {
  const std::lock_guard<std::mutex> lock(mutex_);
  const ros::WallTime now = ros::WallTime::now();
  const double seconds = (now - last_report_).toSec();
  status->addf(name_ + "_rate_hz", "%.1f", seconds > 0 ? messages_ / seconds : 0.0);
  if (messages_ > 0) status->addf(name_ + "_delay_ms", "%.1f", 1e3 * summed_delay_ / messages_);
  status->addf(name_ + "_longest_stall_ms", "%.0f", 1e3 * longest_stall_);
  last_report_ = now;
  messages_ = 0;
  summed_delay_ = 0;
}

}  // namespace plm_vins
