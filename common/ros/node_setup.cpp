// SPDX-License-Identifier: BSD-3-Clause
#include "common/ros/node_setup.h"

#include <ros/callback_queue.h>
#include <ros/console.h>
#include <ros/exception.h>
#include <ros/init.h>

#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <exception>

#include "common/process_setup.h"
#include "common/ros/node_config.h"

namespace plm_vins {
namespace {

constexpr double kClockPatience = 10;  // [s]; a player first opens its bag

// Parameters outlive a launch: /use_sim_time of an earlier bag leaves live sensors without a clock.
void WarnWithoutClock() {
  if (ros::Time::isValid()) return;
  ROS_WARN(
      "/use_sim_time is set, but no time comes on /clock: play the bag with --clock, or the player "
      "could not open its bag (absolute path?); for live sensors, rosparam delete /use_sim_time "
      "and start all nodes again");
}

// Returns false, after printing why, if an argument has an invalid ROS name; logging does not work
// yet.
bool InitRos(int argc, char** argv, const std::string& name) {
  try {
    ros::init(argc, argv, name);
    return true;
  } catch (const ros::Exception& error) {
    std::fprintf(stderr, "%s: %s\n", name.c_str(), error.what());
    return false;
  }
}

}  // namespace

int RunNode(int argc, char** argv, const std::string& name, const std::function<void()>& body) {
  // Exits at once until ROS handles signals, since there is nothing to save yet.
  std::signal(SIGINT, [](int) { std::_Exit(0); });
  std::signal(SIGTERM, [](int) { std::_Exit(0); });
  SetUpProcess();
  if (!InitRos(argc, argv, name)) return 1;
  const ros::NodeHandle keeps_ros_running;
  std::signal(SIGTERM, [](int) { ros::requestShutdown(); });  // ROS itself handles SIGINT
  try {
    body();
  } catch (const std::exception& error) {
    LogFatal(error);
    return 1;
  }
  return 0;
}

int RunNode(int argc, char** argv, const std::string& name,
            const std::function<void(const Config&)>& body) {
  return RunNode(argc, argv, name, [&] { body(LoadNodeConfig(ros::NodeHandle("~"))); });
}

void Spin() {
  const ros::WallTimer clock_check = ros::NodeHandle().createWallTimer(
      ros::WallDuration(kClockPatience), [](const ros::WallTimerEvent&) { WarnWithoutClock(); },
      /*oneshot=*/true);
  while (ros::ok()) {
    ros::getGlobalCallbackQueue()->callAvailable(ros::WallDuration(0.1));
    // After shutdown the queue no longer waits, and ros::spin() would busy-wait for a tenth of a
    // second.
    if (ros::isShuttingDown()) ros::WallDuration(0.01).sleep();
  }
}

bool ErrorCounter::Run(const std::function<void()>& body) {
  try {
    body();
    return true;
  } catch (const std::exception& error) {
    ROS_ERROR_STREAM_THROTTLE(10.0, "going on after an internal error: " << error.what());
    const std::lock_guard<std::mutex> lock(mutex_);
    errors_.Add(error.what());
    return false;
  }
}

DropCount ErrorCounter::count() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return errors_;
}

void DropWarner::Check(const DropCounts& counts) {
  for (const DropCount& drop : counts) {
    if (drop.count > 0 && warned_.insert(drop.cause).second) {
      ROS_WARN_STREAM("unusable input, counted from here on: " << ToString(drop));
    }
  }
}

}  // namespace plm_vins
