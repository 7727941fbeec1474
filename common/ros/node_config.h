// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ros/node_handle.h>

#include <exception>

#include "common/config/config.h"

namespace plm_vins {

// The configuration of the file ~config_file, in which texts ~set/KEY replace scalar keys. Warns of
// keys without effect. Throws ConfigError, also where a topic has a name that ROS
// refuses.
Config LoadNodeConfig(const ros::NodeHandle& private_node);

// One fatal log line per line of the error's text: one per problem of a configuration.
void LogFatal(const std::exception& error);

}  // namespace plm_vins
