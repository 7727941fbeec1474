// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "vins_estimator/factors/line_factor.h"
#include "vins_estimator/lines/line_axis.h"
#include "vins_estimator/lines/plucker.h"

namespace plm_vins {

// One image's view of a line.
struct LineView {
  int64_t t_ns = 0;  // names the frame
  LineSegmentView segment;
};

// A line track over the frames of the window, and the line in space behind it. The first view is
// the host whose camera frame the coordinates refer to.
struct LineLandmark {
  int64_t id = -1;
  std::vector<LineView> views;  // by time
  OrthonormalLine coordinates = {0, 0, 0, 1, 0};
  bool triangulated = false;
  LineAxis axis = LineAxis::kFree;  // as known from the views so far

  const LineView& host() const { return views.front(); }
};

}  // namespace plm_vins
