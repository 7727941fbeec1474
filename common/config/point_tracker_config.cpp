// SPDX-License-Identifier: BSD-3-Clause
#include "common/config/point_tracker_config.h"

namespace plm_vins {

ConfigKeys<PointTrackerConfig> PointTrackerKeys() {
  using Key = ConfigKey<PointTrackerConfig>;
  using P = PointTrackerConfig;
  return {
      Key::Choice<CornerDetectorType>(
          "corner_detector",
          {{"shi_tomasi", CornerDetectorType::kShiTomasi}, {"harris", CornerDetectorType::kHarris}},
          &P::corner_detector),
      Key::Flag("corner_subpixel", &P::corner_subpixel),
      Key::Number("quality_level", "", {1e-6, 0.5}, &P::quality_level),
      Key::Integer("max_cnt", "corners", {20, 5000}, &P::max_cnt),
      Key::Number("min_dist", "px", {2, 500}, &P::min_dist),
      Key::Number("F_threshold", "px", {0.1, 20}, &P::f_threshold),
      Key::Flag("equalize", &P::equalize),
      Key::Flag("fisheye", &P::fisheye),
      Key::Text("fisheye_mask", &P::fisheye_mask),
      Key::Integer("klt_window", "px", {5, 101}, &P::klt_window),
      Key::Integer("klt_levels", "", {0, 8}, &P::klt_levels),
      Key::Number("forward_backward", "px", {0.01, 20}, &P::forward_backward),
  };
}

}  // namespace plm_vins
