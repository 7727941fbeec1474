// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "common/geometry/rigid3.h"

namespace plm_vins {

// Parses "x y z yaw pitch roll" [m, rad] in the convention of tf2_ros' static_transform_publisher:
// the pose of the child in the parent, rotated by roll about x, then pitch about y, then yaw about
// z. Throws std::invalid_argument with `name` and text if it is invalid or its angles seem to be in
// degrees.
Rigid3d ParseTransform(const std::string& name, const std::string& text);

}  // namespace plm_vins
