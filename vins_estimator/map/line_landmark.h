// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "common/measurements.h"
#include "vins_estimator/geometry/line_segment_view.h"
#include "vins_estimator/geometry/plucker.h"
#include "vins_estimator/state/line_axis.h"

namespace plm_vins {

// Observation of a line in one image.
struct LineView {
  int64_t t_ns = 0;  // identifies the frame
  LineSegmentView segment;
  std::optional<RightSegment> right = {};  // in the second camera at the same time

  void ForgetDepth() { right.reset(); }
  int CountMeasurements() const { return 1 + right.has_value(); }
};

inline double Length(const LineView& view) {
  return (view.segment.end - view.segment.start).norm();
}

// A line track over the frames of the window, and the line in space. The first observation is the
// host, in whose camera frame the coordinates are.
struct LineLandmark {
  int64_t id = -1;
  std::vector<LineView> views;  // by time
  // Observations in anchors, by time, of a recognized line; optimized together with `views`.
  std::vector<LineView> anchor_views;
  OrthonormalLine coordinates = {0, 0, 0, 1, 0};
  bool triangulated = false;
  LineAxis axis = LineAxis::kFree;  // parallel axis, according to the observations so far

  const LineView& host() const { return views.front(); }
};

constexpr size_t kMaxAnchorViews = 4;  // per line: the first and the newest

// Adds an anchor's observation, by time. Of two observations in one anchor the longer is kept.
inline void AddAnchorView(const LineView& view, std::vector<LineView>* views) {
  const auto is_earlier = [](const LineView& a, const LineView& b) { return a.t_ns < b.t_ns; };
  const auto place = std::lower_bound(views->begin(), views->end(), view, is_earlier);
  if (place != views->end() && place->t_ns == view.t_ns) {
    if (Length(view) > Length(*place)) *place = view;
    return;
  }
  views->insert(place, view);
  if (views->size() > kMaxAnchorViews) views->erase(views->begin() + 1);
}

// Removes the observations in one frame.
inline void RemoveViewsOf(int64_t t_ns, std::vector<LineView>* views) {
  const auto is_of_frame = [t_ns](const LineView& view) { return view.t_ns == t_ns; };
  views->erase(std::remove_if(views->begin(), views->end(), is_of_frame), views->end());
}

}  // namespace plm_vins
