// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <vector>

#include "vins_estimator/geometry/line_pairs.h"
#include "vins_estimator/map/line_landmark.h"

namespace plm_vins {

// A line whose observations have been marginalized.
struct RememberedLine {
  SeenLine seen_W;                                             // the observed part; F is W
  std::vector<LineLandmark::Observation> anchor_observations;  // by anchor frames, ordered
  int64_t note = 0;                                            // sequence number of its last update
};

// Remembers lines that have left the window, so that re-observed lines are recognized. Holds at
// most kCapacity lines; beyond that, the least recently updated line is dropped.
class LineMemory {
 public:
  static constexpr size_t kCapacity = 1000;

  // Adds or updates a line. The newer of two estimates with the same id is kept, unless it is much
  // less certain; the observed parts are united.
  void Keep(int64_t id, const SeenLine& line_W);

  // Adds an anchor's observation of a line; ignored if the line is unknown.
  void KeepObservation(int64_t id, const LineLandmark::Observation& anchor_view);

  // Merges two ids of the same line: the older id takes over the observations of the newer.
  void Join(int64_t newer, int64_t older);

  // Modifies all observations by anchors.
  void ChangeObservations(const std::function<void(LineLandmark::Observation*)>& change);

  // Removes the observations by an anchor.
  void RemoveAnchor(int64_t t_ns);

  // Returns null if the line is unknown.
  const RememberedLine* Find(int64_t id) const;

  const std::map<int64_t, RememberedLine>& lines() const { return lines_; }

 private:
  void ForgetLeastRecent();

  std::map<int64_t, RememberedLine> lines_;  // ordered, for reproducible searches
  int64_t notes_ = 0;
};

}  // namespace plm_vins
