// SPDX-License-Identifier: BSD-3-Clause
#include "common/config/tracker_config.h"

namespace plm_vins {

ConfigKeys PointTrackerKeys(PointTrackerConfig* points) {
  using Key = ConfigKey;
  return {
      Key::Choice<CornerDetectorType>(
          "corner_detector",
          {{"shi_tomasi", CornerDetectorType::kShiTomasi}, {"harris", CornerDetectorType::kHarris}},
          &points->corner_detector),
      Key::Flag("corner_subpixel", &points->corner_subpixel),
      Key::Number("quality_level", "", {1e-6, 0.5}, &points->quality_level),
      Key::Integer("max_cnt", "corners", {20, 5000}, &points->max_cnt),
      Key::Number("min_dist", "px", {2, 500}, &points->min_dist),
      Key::Number("F_threshold", "px", {0.1, 20}, &points->f_threshold),
      Key::Flag("equalize", &points->equalize),
      Key::Flag("fisheye", &points->fisheye),
      Key::Text("fisheye_mask", &points->fisheye_mask),
      Key::Integer("klt_window", "px", {5, 101}, &points->klt_window),
      Key::Integer("klt_levels", "", {0, 8}, &points->klt_levels),
  };
}

ConfigKeys LineTrackerKeys(LineTrackerConfig* lines) {
  using Key = ConfigKey;
  return {
      Key::Choice<LineDetectorType>("line_detector",
                                    {{"fld", LineDetectorType::kFld},
                                     {"lsd", LineDetectorType::kLsd},
                                     {"edlines", LineDetectorType::kEdLines}},
                                    &lines->line_detector),
      Key::Integer("max_line_cnt", "lines", {1, 5000}, &lines->max_lines),
      Key::Number("line_min_length", "", {0.01, 1}, &lines->min_length),
      Key::Flag("line_half_resolution", &lines->half_resolution),
  };
}

}  // namespace plm_vins
