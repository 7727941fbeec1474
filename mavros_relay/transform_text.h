// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "common/geometry/rigid3.h"

namespace plm_vins {

// "x y z yaw pitch roll" [m, rad], as tf2_ros' static_transform_publisher reads it: the pose of the
// child in the parent, turned by roll about x, then pitch about y, then yaw about z. Throws
// std::invalid_argument, which has `name` and text, where it is none or its angles are in degrees.
Rigid3d ParseTransform(const std::string& name, const std::string& text);

}  // namespace plm_vins
