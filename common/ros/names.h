// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace plm_vins {

// Returns the name of a topic or frame of a camera: that of camera 0, with the number of another.
inline std::string NameOfCamera(const std::string& name, int camera) {
  return camera == 0 ? name : name + std::to_string(camera);
}

// Returns the name of a topic in a recording: absolute, as of a node without a namespace.
inline std::string AbsoluteTopic(const std::string& topic) {
  return topic.empty() || topic.front() == '/' ? topic : "/" + topic;
}

}  // namespace plm_vins
