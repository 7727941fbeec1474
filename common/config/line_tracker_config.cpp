// SPDX-License-Identifier: BSD-3-Clause
#include "common/config/line_tracker_config.h"

namespace plm_vins {

ConfigKeys<LineTrackerConfig> LineTrackerKeys() {
  using Key = ConfigKey<LineTrackerConfig>;
  using L = LineTrackerConfig;
  return {
      Key::Choice<LineDetectorType>("line_detector",
                                    {{"fld", LineDetectorType::kFld},
                                     {"lsd", LineDetectorType::kLsd},
                                     {"edlines", LineDetectorType::kEdLines}},
                                    &L::line_detector),
      Key::Choice<LineMatcherType>(
          "line_matcher", {{"flow", LineMatcherType::kFlow}, {"lbd", LineMatcherType::kLbd}},
          &L::line_matcher),
      Key::Integer("max_line_cnt", "lines", {1, 5000}, &L::max_lines),
      Key::Number("line_min_length", "", {0.01, 1}, &L::min_length),
      Key::Number("line_min_dist", "px", {0, 100}, &L::spacing),
      Key::Number("line_min_gradient", "grey levels/px", {0.1, 255}, &L::min_gradient),
      Key::Number("line_border", "px", {1, 500}, &L::border),
      Key::Flag("line_half_resolution", &L::half_resolution),
      Key::Flag("line_join_fragments", &L::join_fragments),
      Key::Number("line_refill_below", "", {0, 1}, &L::refill_below),
      Key::Integer("line_refill_interval", "images", {1, 1000}, &L::refill_interval),
      Key::Number("line_max_angle", "deg", {0.1, 90}, &L::max_angle),
      Key::Number("line_max_distance", "px", {1, 500}, &L::max_distance),
      Key::Number("line_min_overlap", "", {0, 1}, &L::min_overlap),
      Key::Number("line_min_correlation", "", {0, 1}, &L::min_correlation),
      Key::Integer("line_max_descriptor_distance", "bits", {0, 256}, &L::max_descriptor_distance),
  };
}

}  // namespace plm_vins
