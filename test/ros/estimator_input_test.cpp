// SPDX-License-Identifier: BSD-3-Clause
// The estimator's node in the process of a driver: messages published by pointer are received at
// once, in the publishing thread. Run by estimator_input.test.
#include <gtest/gtest.h>
#include <ros/console.h>
#include <ros/ros.h>
#include <sensor_msgs/Imu.h>

#include <boost/make_shared.hpp>
#include <chrono>
#include <condition_variable>
#include <future>
#include <limits>
#include <mutex>
#include <string>
#include <utility>

#include "common/ros/node_config.h"
#include "test/ros/estimator_log.h"
#include "vins_estimator/ros/estimator_node.h"

namespace plm_vins {
namespace {

using testing::EstimatorLog;
using testing::SpinUntil;

constexpr double kPatience = 20;  // [s]

// Blocks the thread that logs a text with these words. Lives as long as the process, since
// rosconsole 1.14 crashes when an appender is removed.
class BusyLog : public ros::console::LogAppender {
 public:
  explicit BusyLog(std::string words) : words_(std::move(words)) {
    ros::console::register_appender(this);
  }

  void log(ros::console::Level, const char* text, const char*, const char*, int) override {
    if (std::string(text).find(words_) == std::string::npos) return;
    std::unique_lock<std::mutex> lock(mutex_);
    holds_ = true;
    changed_.notify_all();
    changed_.wait(lock, [this] { return released_; });
  }

  bool WaitUntilItHolds() {
    std::unique_lock<std::mutex> lock(mutex_);
    return changed_.wait_for(lock, std::chrono::seconds(20), [this] { return holds_; });
  }

  void Release() {
    const std::lock_guard<std::mutex> lock(mutex_);
    released_ = true;
    changed_.notify_all();
  }

 private:
  const std::string words_;
  std::mutex mutex_;  // guards the following members
  std::condition_variable changed_;
  bool holds_ = false;
  bool released_ = false;
};

class Driver {
 public:
  bool IsConnected() const { return publisher_.getNumSubscribers() == 1; }

  void Publish(int count, double acceleration) {
    for (int i = 0; i < count; ++i) {
      const auto sample = boost::make_shared<sensor_msgs::Imu>();
      stamp_ += ros::Duration(0.005);
      sample->header.stamp = stamp_;
      sample->linear_acceleration.z = acceleration;
      publisher_.publish(sample);
    }
  }

 private:
  ros::Publisher publisher_ = ros::NodeHandle().advertise<sensor_msgs::Imu>("/imu0", 10);
  ros::Time stamp_{1000};
};

// If the driver waited for the estimator, which waits for ROS to publish, there would be a
// deadlock.
TEST(EstimatorInput, NeverBlocksADriverInItsProcess) {
  const ros::NodeHandle private_node("vins_estimator");
  Driver driver;
  EstimatorLog status;
  BusyLog& log = *new BusyLog("imu_not_finite");
  const EstimatorNode estimator(LoadNodeConfig(private_node), ros::NodeHandle(), private_node);
  ASSERT_TRUE(SpinUntil(kPatience, [&] { return driver.IsConnected(); }));
  driver.Publish(20, std::numeric_limits<double>::quiet_NaN());
  ASSERT_TRUE(log.WaitUntilItHolds());

  const auto done = std::async(std::launch::async, [&] { driver.Publish(6000, 9.81); });
  EXPECT_TRUE(done.wait_for(std::chrono::seconds(20)) == std::future_status::ready);
  log.Release();
  EXPECT_TRUE(status.WaitForStatus(kPatience, [](const EstimatorLog& newest) {
    return newest.Count("imu_refused_full") >= 1000;
  })) << status.Value("imu_refused_full");
}

}  // namespace
}  // namespace plm_vins
