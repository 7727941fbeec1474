// SPDX-License-Identifier: BSD-3-Clause
#include "common/ros/stream_monitor.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "common/measurements.h"
#include "common/ros/geometry_conversion.h"

namespace plm_vins {
namespace {

// Returns the reported delay of messages with these timestamps, which all arrive at `now` [ms].
double DelayOf(const std::vector<int64_t>& stamps, const ros::Time& now) {
  ros::Time::init();
  ros::Time::setNow(now);
  StreamMonitor monitor("imu");
  for (const int64_t t_ns : stamps) monitor.Add(t_ns);
  diagnostic_updater::DiagnosticStatusWrapper status;
  monitor.Report(&status);
  for (const auto& value : status.values) {
    if (value.key == "imu_delay_ms") return std::stod(value.value);
  }
  ADD_FAILURE() << "no delay";
  return 0;
}

TEST(StreamMonitor, ReportsTheMeanDelay) {
  EXPECT_NEAR(DelayOf({999'000'000'000, 999'500'000'000}, ros::Time(1000)), 750, 0.1);
}

TEST(StreamMonitor, FindsTheLongestStall) {
  StreamMonitor monitor("images");
  monitor.Add(1'000'000'000);
  ros::WallDuration(0.3).sleep();
  for (const int64_t ms : {1100, 1200, 1300}) monitor.Add(ms * 1'000'000);
  const std::string stall = monitor.DescribeStall();
  EXPECT_NE(stall.find("of images was 0.2"), std::string::npos) << stall;
}

// The range of ros::Duration ends at 2^31 s.
TEST(StreamMonitor, AcceptsEveryStamp) {
  constexpr double kMsPerSecond = 1e3;
  EXPECT_NEAR(DelayOf({kEndOfTime_ns - 1}, ros::Time(1)), (1 - 0x1p32) * kMsPerSecond, 1);
  EXPECT_NEAR(DelayOf({0}, ros::Time(4'000'000'000, 0)), 4e9 * kMsPerSecond, 1);
}

}  // namespace
}  // namespace plm_vins
