// SPDX-License-Identifier: BSD-3-Clause
#include "common/ros/node_setup.h"

#include <ros/console.h>
#include <ros/init.h>

#include <exception>
#include <map>

namespace plm_vins {
namespace {

Config LoadNodeConfig() {
  std::string file;
  if (!ros::NodeHandle("~").getParam("config_file", file)) {
    throw ConfigError({"parameter ~config_file is not set: give the path of a configuration file"});
  }
  std::map<std::string, std::string> overrides;
  const ros::NodeHandle node("~");
  if (node.hasParam("set") && !node.getParam("set", overrides)) {
    throw ConfigError({"parameters ~set/KEY must be texts (in a launch file: type=\"str\")"});
  }
  return LoadConfig(file, overrides);
}

}  // namespace

int RunNode(int argc, char** argv, const std::string& name,
            const std::function<void(const Config&)>& body) {
  ros::init(argc, argv, name);
  const ros::NodeHandle keeps_ros_running;
  try {
    body(LoadNodeConfig());
  } catch (const ConfigError& error) {
    for (const std::string& problem : error.problems()) ROS_FATAL_STREAM(problem);
    return 1;
  } catch (const std::exception& error) {
    ROS_FATAL_STREAM(error.what());
    return 1;
  }
  return 0;
}

void DropWarner::Check(const DropCounts& counts) {
  for (const DropCount& drop : counts) {
    if (drop.count > 0 && warned_.insert(drop.cause).second) {
      ROS_WARN_STREAM("unusable input, counted from here on: " << ToString(drop));
    }
  }
}

}  // namespace plm_vins
