// SPDX-License-Identifier: BSD-3-Clause
#include "common/ros/node_setup.h"

#include <ros/callback_queue.h>
#include <ros/console.h>
#include <ros/exception.h>
#include <ros/init.h>
#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <system_error>

#include "common/process_setup.h"
#include "common/ros/node_config.h"

namespace plm_vins {
namespace {

namespace fs = std::filesystem;

constexpr double kClockPatience = 10;  // [s]; a player first opens its bag

// Parameters outlive a launch: /use_sim_time of an earlier bag leaves live sensors without a clock.
void WarnWithoutClock() {
  if (ros::Time::isValid()) return;
  ROS_WARN(
      "/use_sim_time is set, but no time is published on /clock: play the bag with --clock, and "
      "check that the player could open it (absolute path?); for live sensors, run rosparam delete "
      "/use_sim_time and restart all nodes");
}

// roscpp aborts if it cannot create its log folder; a temporary folder replaces it then.
void RequireLogFolder() {
  if (std::getenv("ROS_LOG_DIR") != nullptr) return;
  const char* const ros_home = std::getenv("ROS_HOME");
  const char* const home = std::getenv("HOME");
  const fs::path folder = ros_home != nullptr ? fs::path(ros_home) / "log"
                                              : fs::path(home != nullptr ? home : "") / ".ros/log";
  std::error_code error;
  fs::create_directories(folder, error);
  if (!error && access(folder.c_str(), W_OK) == 0) return;
  const fs::path other = fs::temp_directory_path(error) / "ros_log";
  setenv("ROS_LOG_DIR", other.c_str(), /*overwrite=*/0);
  std::fprintf(stderr,
               "cannot write logs to %s, using %s instead; set ROS_LOG_DIR to a writable folder\n",
               folder.c_str(), other.c_str());
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
  RequireLogFolder();
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

bool IsNeeded(bool value, const char* key, const Config& config) {
  if (!value) ROS_INFO("not needed: %s is 0 in %s", key, config.file.c_str());
  return value;
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
    ROS_ERROR_STREAM_THROTTLE(10.0, "internal error, continuing: " << error.what());
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
      ROS_WARN_STREAM(
          "unusable input, reported once and counted in /diagnostics: " << ToString(drop));
    }
  }
}

}  // namespace plm_vins
