// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <std_msgs/Header.h>
#include <visualization_msgs/Marker.h>

#include <string>

namespace plm_vins {

// Returns an empty marker of this type (such as visualization_msgs::Marker::LINE_LIST) in the
// namespace `name`: black and opaque, with line width or sphere diameter `size` [m].
visualization_msgs::Marker MakeMarker(const std_msgs::Header& header, const std::string& name,
                                      int type, double size);

}  // namespace plm_vins
