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

// Lines as one LINE_LIST: red, green, blue along the Manhattan axes x, y, z; grey where free. One
// that is empty is deleted, since rviz takes it for an error.
visualization_msgs::Marker ToLineMarker(const std::vector<MapLine>& lines, int64_t t_ns,
                                        const std::string& frame_id, const std::string& name);

// The lines that have left the window, for display. Each marker holds a part of them under an id of
// its own, so a message is small however long the run; beyond kMaxMarkers the oldest part is
// overwritten, so the display stays small, too. A line that came back into view and leaves again
// replaces what it was before.
class LineHistory {
 public:
  static constexpr size_t kLinesPerMarker = 50;
  static constexpr size_t kMaxMarkers = 400;

  explicit LineHistory(const std::string& frame_id) : frame_id_(frame_id), parts_(kMaxMarkers) {}

  // Forgets lines, which are part of others from now on; markers change with the next Add().
  void Remove(const std::vector<int64_t>& ids);

  // Adds lines; returns the markers that changed, each once.
  std::vector<visualization_msgs::Marker> Add(const std::vector<MapLine>& lines, int64_t t_ns);

  // The markers of all lines, with the stamp of the last Add(): for who has none of them yet.
  std::vector<visualization_msgs::Marker> All() const;

  // Forgets all lines; returns the marker that makes the display forget them, too.
  visualization_msgs::Marker Clear();

 private:
  struct Place {
    size_t part = 0;
    size_t line = 0;  // in that part
  };

  Place PlaceOf(int64_t id);
  void StartNextPart();
  visualization_msgs::Marker MakeMarker(size_t part) const;

  std::string frame_id_;
  std::vector<std::vector<MapLine>> parts_;  // by id of their marker
  size_t newest_part_ = 0;
  int64_t t_ns_ = 0;                           // of the last Add()
  std::unordered_map<int64_t, Place> places_;  // of all lines, by id
  std::set<size_t> changed_;                   // parts, since the last Add()
};

}  // namespace plm_vins
