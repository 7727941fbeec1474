// SPDX-License-Identifier: BSD-3-Clause
#include "common/config/line_tracker_config.h"

namespace plm_vins {

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
