// SPDX-License-Identifier: BSD-3-Clause
#include "common/ros/marker.h"

namespace plm_vins {

visualization_msgs::Marker MakeMarker(const std_msgs::Header& header, const std::string& name,
                                      int type, double size) {
  visualization_msgs::Marker marker;
  marker.header = header;
  marker.ns = name;
  marker.type = type;
  marker.action = visualization_msgs::Marker::ADD;
  marker.pose.orientation.w = 1;
  marker.scale.x = marker.scale.y = marker.scale.z = size;
  marker.color.a = 1;
  return marker;
}

}  // namespace plm_vins
