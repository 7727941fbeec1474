// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "common/config/config_key.h"

namespace plm_vins {

enum class CornerDetectorType { kShiTomasi, kHarris };

struct PointTrackerConfig {
  CornerDetectorType corner_detector = CornerDetectorType::kShiTomasi;
  bool corner_subpixel = true;  // refine corners to subpixel accuracy ([Paper], section III.A)
  int max_cnt = 150;            // corners per image
  double min_dist = 20;         // minimum distance between corners [px]
  double f_threshold = 1.0;     // epipolar RANSAC threshold [px]
  bool equalize = true;         // CLAHE
  bool fisheye = true;          // use the mask, if one is given
  std::string fisheye_mask;     // image file, white where features are allowed; empty: no mask
  double quality_level = 0.03;  // minimum response relative to the strongest corner
  int klt_window = 16;          // [px]
  int klt_levels = 3;           // pyramid levels above the image itself
};

enum class LineDetectorType { kFld, kLsd, kEdLines };

struct LineTrackerConfig {
  LineDetectorType line_detector = LineDetectorType::kFld;
  bool half_resolution = true;  // detect at half resolution; refinement is at full resolution
  int max_lines = 45;           // lines per image
  double min_length = 0.08;     // minimum length, relative to the image's short side
};

ConfigKeys PointTrackerKeys(PointTrackerConfig* points);
ConfigKeys LineTrackerKeys(LineTrackerConfig* lines);

}  // namespace plm_vins
