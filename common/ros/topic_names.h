// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace plm_vins {

// The name by which a recording has a topic: as of a node in no namespace.
inline std::string AbsoluteTopic(const std::string& topic) {
  return topic.empty() || topic.front() == '/' ? topic : "/" + topic;
}

}  // namespace plm_vins
