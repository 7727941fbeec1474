// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <visualization_msgs/Marker.h>

#include <cstdint>
#include <set>
#include <string>
#include <unordered_map>
#include <vector>

#include "vins_estimator/state/map_elements.h"

namespace plm_vins {

// Converts lines to one LINE_LIST marker: red, green, blue for the Manhattan axes x, y, z; gray if
// free. If there are no lines, the marker's action is DELETE, because rviz reports an empty marker
// as an error.
visualization_msgs::Marker ToLineMarker(const std::vector<MapLine>& lines, int64_t t_ns,
                                        const std::string& frame_id, const std::string& name);

// Markers of the lines that have left the window. Each marker holds a part of them under its own
// id, so the message size is independent of the run's length; beyond kMaxMarkers the oldest part is
// overwritten, which bounds the display, too. A recognized line that leaves the window again
// replaces its previous entry.
class LineHistory {
 public:
  static constexpr size_t kLinesPerMarker = 50;
  static constexpr size_t kMaxMarkers = 400;

  explicit LineHistory(const std::string& frame_id) : frame_id_(frame_id), parts_(kMaxMarkers) {}

  // Removes lines that were merged into others; markers change with the next Add().
  void Remove(const std::vector<int64_t>& ids);

  // Adds lines; returns the markers that changed, each once.
  std::vector<visualization_msgs::Marker> Add(const std::vector<MapLine>& lines, int64_t t_ns);

  // Returns the markers of all lines, with the time of the last Add(), for new subscribers.
  std::vector<visualization_msgs::Marker> All() const;

  // Drops all lines; returns the marker that deletes them from the display.
  visualization_msgs::Marker Clear();

 private:
  struct Place {
    size_t part = 0;
    size_t line = 0;  // index in that part
  };

  Place PlaceOf(int64_t id);
  void StartNextPart();
  visualization_msgs::Marker MakeMarker(size_t part) const;

  std::string frame_id_;
  std::vector<std::vector<MapLine>> parts_;  // by marker id
  size_t newest_part_ = 0;
  int64_t t_ns_ = 0;                           // time of the last Add()
  std::unordered_map<int64_t, Place> places_;  // places of all lines, by id
  std::set<size_t> changed_;                   // parts changed since the last Add()
};

}  // namespace plm_vins
