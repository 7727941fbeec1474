// SPDX-License-Identifier: BSD-3-Clause
#include "common/ros/node_config.h"

#include <ros/console.h>

#include <map>
#include <sstream>
#include <string>

namespace plm_vins {

Config LoadNodeConfig(const ros::NodeHandle& private_node) {
  std::string file;
  if (!private_node.getParam("config_file", file)) {
    throw ConfigError({"parameter " + private_node.resolveName("config_file") +
                       " is not set: give the path of a configuration file"});
  }
  std::map<std::string, std::string> overrides;
  if (private_node.hasParam("set") && !private_node.getParam("set", overrides)) {
    throw ConfigError({"parameters " + private_node.resolveName("set") +
                       "/KEY must be texts (in a launch file: type=\"str\")"});
  }
  const Config config = LoadConfig(file, overrides);
  const std::string warning = IgnoredKeysWarning(config);
  if (!warning.empty()) ROS_WARN_STREAM_ONCE(warning);
  return config;
}

void LogFatal(const std::exception& error) {
  std::istringstream text(error.what());
  for (std::string line; std::getline(text, line);) ROS_FATAL_STREAM(line);
}

}  // namespace plm_vins
