// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <visualization_msgs/Marker.h>

#include <cstdint>
#include <string>
#include <vector>

#include "vins_estimator/lines/line_map.h"

namespace plm_vins {

// Lines as one LINE_LIST: red, green, blue along the Manhattan axes x, y, z; grey where free.
visualization_msgs::Marker ToLineMarker(const std::vector<MapLine>& lines, int64_t t_ns,
                                        const std::string& frame_id, const std::string& name);

// The lines that have left the window, for display. Each marker holds a part of them under an id of
// its own, so a message is small however long the run; beyond kMaxMarkers the oldest part is
// overwritten, so the display stays small, too.
class LineHistory {
 public:
  static constexpr size_t kLinesPerMarker = 200;
  static constexpr int kMaxMarkers = 100;

  explicit LineHistory(const std::string& frame_id) : frame_id_(frame_id) {}

  // Adds lines; returns the markers that changed.
  std::vector<visualization_msgs::Marker> Add(const std::vector<MapLine>& lines, int64_t t_ns);

  // Forgets all lines; the marker that tells the display to do so.
  visualization_msgs::Marker Clear();

 private:
  visualization_msgs::Marker MakeMarker(int64_t t_ns) const;

  std::string frame_id_;
  std::vector<MapLine> lines_;  // of the newest marker
  int marker_id_ = 0;           // of the same
};

}  // namespace plm_vins
