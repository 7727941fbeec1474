// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "vins_estimator/geometry/line_segment_view.h"
#include "vins_estimator/geometry/plucker.h"
#include "vins_estimator/state/line_axis.h"

namespace plm_vins {

// One image's view of a line.
struct LineView {
  int64_t t_ns = 0;  // names the frame
  LineSegmentView segment;
};

inline double Length(const LineView& view) {
  return (view.segment.end - view.segment.start).norm();
}

// A line track over the frames of the window, and the line in space behind it. The first view is
// the host whose camera frame the coordinates refer to.
struct LineLandmark {
  int64_t id = -1;
  std::vector<LineView> views;  // by time
  // By anchors, by time, of a line that was recognised; they count together with `views`.
  std::vector<LineView> anchor_views;
  OrthonormalLine coordinates = {0, 0, 0, 1, 0};
  bool triangulated = false;
  bool wanders = false;             // its views do not look like those of one line (NoteWandering)
  LineAxis axis = LineAxis::kFree;  // as known from the views so far

  const LineView& host() const { return views.front(); }
};

// What may be taken for the same as others, now or when it comes back.
inline bool MayLast(const LineLandmark& line) { return line.triangulated && !line.wanders; }

constexpr size_t kMaxAnchorViews = 4;  // of one line: the first and the newest

// Adds what an anchor has seen, by time. Of two views of one anchor the longer segment stays.
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

// Takes out the view of one frame.
inline void RemoveViewsOf(int64_t t_ns, std::vector<LineView>* views) {
  const auto is_of_frame = [t_ns](const LineView& view) { return view.t_ns == t_ns; };
  views->erase(std::remove_if(views->begin(), views->end(), is_of_frame), views->end());
}

}  // namespace plm_vins
