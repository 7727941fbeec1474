// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ros/node_handle.h>

#include <map>
#include <optional>
#include <stdexcept>
#include <string>

namespace plm_vins {

inline const char* KindOf(const std::string&) { return "a text (in a launch file: type=\"str\")"; }
inline const char* KindOf(double) { return "a number"; }
inline const char* KindOf(const std::map<std::string, std::string>&) {
  return "texts by their names (in a launch file: type=\"str\")";
}

// Returns a parameter of the node, or nullopt if it is not set. Throws std::runtime_error with its
// name if it has another type, which ros::NodeHandle treats as not set.
template <typename Value>
std::optional<Value> FindParameter(const ros::NodeHandle& node, const std::string& name) {
  Value value{};
  if (node.getParam(name, value)) return value;
  if (!node.hasParam(name)) return std::nullopt;
  throw std::runtime_error("parameter " + node.resolveName(name) + " must be " + KindOf(value));
}

}  // namespace plm_vins
