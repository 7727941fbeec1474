// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ros/node_handle.h>

#include <exception>

#include "common/config/config.h"

namespace plm_vins {

// The configuration of the file ~config_file, in which ~set/KEY replace scalar keys, each of which
// is logged. Warns of keys without effect. Throws ConfigError, also where a topic has a name that
// ROS refuses, and std::runtime_error where a parameter is of another kind.
Config LoadNodeConfig(const ros::NodeHandle& private_node);

// One fatal log line per line of the error's text: one per problem of a configuration.
void LogFatal(const std::exception& error);

}  // namespace plm_vins
