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
      Key::Integer("max_line_cnt", "lines", {1, 5000}, &L::max_lines),
      Key::Number("line_min_length", "", {0.01, 1}, &L::min_length),
      Key::Number("line_min_dist", "px", {0, 100}, &L::spacing),
      Key::Number("line_min_gradient", "gray levels/px", {0.1, 255}, &L::min_gradient),
      Key::Number("line_border", "px", {1, 500}, &L::border),
      Key::Flag("line_half_resolution", &L::half_resolution),
  };
}

}  // namespace plm_vins
