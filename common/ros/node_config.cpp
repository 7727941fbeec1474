// SPDX-License-Identifier: BSD-3-Clause
#include "common/ros/node_config.h"

#include <XmlRpcValue.h>
#include <ros/console.h>
#include <ros/exceptions.h>
#include <ros/init.h>

#include <iostream>
#include <map>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "common/config/config_value.h"
#include "common/ros/parameter.h"

namespace plm_vins {
namespace {

// Validates topic names here, since the exception of a subscription names neither file nor key.
void CheckTopicNames(const ros::NodeHandle& node, const Config& config) {
  std::vector<std::string> problems;
  const auto check = [&](const std::string& key, const std::string& topic) {
    try {
      node.resolveName(topic);
    } catch (const ros::InvalidNameException& error) {
      problems.push_back(config.file + ": " + key + ": \"" + topic +
                         "\" is not a valid topic name: " + error.what());
    }
  };
  check("image_topic", config.sensor.cameras[0].image_topic);
  check("imu_topic", config.sensor.imu_topic);
  if (!problems.empty()) throw ConfigError(problems);
}

// Converts to text, since ROS parses `_set/max_cnt:=100` from a shell as a number.
std::string TextOf(XmlRpc::XmlRpcValue value, const std::string& name) {
  switch (value.getType()) {
    case XmlRpc::XmlRpcValue::TypeString:
      return value;
    case XmlRpc::XmlRpcValue::TypeBoolean:
      return static_cast<bool>(value) ? "1" : "0";
    case XmlRpc::XmlRpcValue::TypeInt:
      return std::to_string(static_cast<int>(value));
    case XmlRpc::XmlRpcValue::TypeDouble:
      return ToText(static_cast<double>(value));
    default:
      throw std::runtime_error(name + " must be a string, a number or a boolean");
  }
}

// Returns the values of ~set/KEY by KEY. `prefix` plus KEY is the name in messages.
std::map<std::string, std::string> FindOverrides(const ros::NodeHandle& private_node,
                                                 const std::string& prefix) {
  XmlRpc::XmlRpcValue values;
  if (!private_node.getParam("set", values)) return {};
  if (values.getType() != XmlRpc::XmlRpcValue::TypeStruct) {
    throw std::runtime_error("parameter " + private_node.resolveName("set") +
                             " must be a namespace of keys, as in set/max_cnt");
  }
  std::map<std::string, std::string> overrides;
  for (const auto& [key, value] : values) overrides[key] = TextOf(value, prefix + key);
  return overrides;
}

}  // namespace

Config LoadNodeConfig(const ros::NodeHandle& private_node) {
  const auto file = FindParameter<std::string>(private_node, "config_file");
  if (!file) {
    throw ConfigError({"parameter " + private_node.resolveName("config_file") +
                       " is not set: give the path of a configuration file (_config_file:=PATH)"});
  }
  const std::string prefix = "parameter " + private_node.resolveName("set") + "/";
  const auto overrides = FindOverrides(private_node, prefix);
  Config config = LoadConfig(*file, overrides, prefix);
  CheckTopicNames(private_node, config);
  for (const auto& [key, text] : overrides) {
    ROS_INFO_STREAM(prefix << key << " overrides the value in " << *file << ": " << text);
  }
  for (const std::string& warning : config.warnings) ROS_WARN_STREAM(warning);
  return config;
}

void LogFatal(const std::exception& error) {
  std::istringstream text(error.what());
  for (std::string line; std::getline(text, line);) {
    if (ros::ok()) {
      ROS_FATAL_STREAM(line);
    } else {
      std::cerr << line << std::endl;  // the log of ROS is shut down
    }
  }
}

}  // namespace plm_vins
