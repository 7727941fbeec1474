// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ros/node_handle.h>

#include <exception>

#include "common/config/config.h"

namespace plm_vins {

// Loads the configuration file ~config_file; ~set/KEY replace scalar keys and are logged. Warns of
// keys without effect. Throws ConfigError, also if a topic name is invalid in ROS, and
// std::runtime_error if a parameter has another type.
Config LoadNodeConfig(const ros::NodeHandle& private_node);

// Logs each line of the error's text as fatal: one for each problem of a configuration.
void LogFatal(const std::exception& error);

}  // namespace plm_vins
