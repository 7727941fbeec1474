// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "common/config/config_key.h"

namespace plm_vins {

enum class LineDetectorType { kFld, kLsd, kEdLines };

struct LineTrackerConfig {
  LineDetectorType line_detector = LineDetectorType::kFld;
  bool half_resolution = true;  // detect at half resolution; refinement is at full resolution
  int max_lines = 45;           // lines per image
  double min_length = 0.08;     // minimum length, relative to the image's short side
};

ConfigKeys LineTrackerKeys(LineTrackerConfig* lines);

}  // namespace plm_vins
