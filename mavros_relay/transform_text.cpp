// SPDX-License-Identifier: BSD-3-Clause
#include "mavros_relay/transform_text.h"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>

namespace plm_vins {
namespace {

constexpr double kMostRadians = 6.3;  // a full turn, rounded up

}  // namespace

Rigid3d ParseTransform(const std::string& name, const std::string& text) {
  std::istringstream stream(text);
  Eigen::Vector3d p;
  double yaw = 0, pitch = 0, roll = 0;
  stream >> p.x() >> p.y() >> p.z() >> yaw >> pitch >> roll;
  if (!stream || !(stream >> std::ws).eof()) {
    throw std::invalid_argument(name + ": expected x y z yaw pitch roll [m, rad] instead of \"" +
                                text + "\"");
  }
  if (std::max({std::abs(yaw), std::abs(pitch), std::abs(roll)}) > kMostRadians) {
    throw std::invalid_argument(
        name + ": yaw, pitch and roll are in rad and must be at most 2 pi: \"" + text + "\"");
  }
  return {Eigen::Quaterniond(Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitZ()) *
                             Eigen::AngleAxisd(pitch, Eigen::Vector3d::UnitY()) *
                             Eigen::AngleAxisd(roll, Eigen::Vector3d::UnitX())),
          p};
}

}  // namespace plm_vins
