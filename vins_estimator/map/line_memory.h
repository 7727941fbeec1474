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

// What is known of a line once its views went into the prior.
struct RememberedLine {
  SeenLine seen_W;                     // the part that was seen; F is W
  std::vector<LineView> anchor_views;  // by frames that stay as anchors, by time
  int64_t note = 0;                    // number of the last note on it
};

// The lines that have been in the window, so that one which comes into view again is recognised.
// Holds at most kCapacity lines; beyond, the one without news for longest is forgotten.
class LineMemory {
 public:
  static constexpr size_t kCapacity = 1000;

  // Takes note of a line. Of two notes under one id the newer stays, unless it is much less
  // certain; the parts that were seen then and now become one.
  void Keep(int64_t id, const SeenLine& line_W);

  // Adds what an anchor has seen of a line, if that is known.
  void KeepView(int64_t id, const LineView& anchor_view);

  // Two lines are one: the older takes over what is known of the newer.
  void Join(int64_t newer, int64_t older);

  // Changes what anchors have seen, view by view.
  void ChangeViews(const std::function<void(LineView*)>& change);

  // Forgets what an anchor has seen.
  void RemoveAnchor(int64_t t_ns);

  // Null where there is no such line.
  const RememberedLine* Find(int64_t id) const;

  const std::map<int64_t, RememberedLine>& lines() const { return lines_; }

 private:
  void ForgetLeastRecent();

  std::map<int64_t, RememberedLine> lines_;  // ordered, so that every run searches alike
  int64_t notes_ = 0;
};

}  // namespace plm_vins
