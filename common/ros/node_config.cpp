// SPDX-License-Identifier: BSD-3-Clause
#include "common/ros/node_config.h"

#include <ros/console.h>
#include <ros/exceptions.h>

#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "common/ros/parameter.h"

namespace plm_vins {
namespace {

// Who subscribes to a name that ROS refuses gets an exception that knows neither file nor key.
void CheckTopicNames(const ros::NodeHandle& node, const Config& config) {
  std::vector<std::string> problems;
  const auto check = [&](const std::string& key, const std::string& topic) {
    try {
      node.resolveName(topic);
    } catch (const ros::InvalidNameException& error) {
      problems.push_back(config.file + ": " + key + ": \"" + topic +
                         "\" is not the name of a topic: " + error.what());
    }
  };
  check("image_topic", config.sensor.image_topic);
  check("imu_topic", config.sensor.imu_topic);
  if (!problems.empty()) throw ConfigError(problems);
}

}  // namespace

Config LoadNodeConfig(const ros::NodeHandle& private_node) {
  std::string file;
  if (!private_node.getParam("config_file", file)) {
    throw ConfigError({"parameter " + private_node.resolveName("config_file") +
                       " is not set: give the path of a configuration file"});
  }
  using TextsByKey = std::map<std::string, std::string>;
  const auto overrides = FindParameter<TextsByKey>(private_node, "set");
  Config config = LoadConfig(file, overrides.value_or(TextsByKey()));
  CheckTopicNames(private_node, config);
  for (const std::string& warning : config.warnings) ROS_WARN_STREAM(warning);
  return config;
}

void LogFatal(const std::exception& error) {
  std::istringstream text(error.what());
  for (std::string line; std::getline(text, line);) ROS_FATAL_STREAM(line);
}

}  // namespace plm_vins
