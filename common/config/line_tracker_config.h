// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "common/config/config_key.h"

namespace plm_vins {

enum class LineDetectorType { kFld, kLsd, kEdLines };
enum class LineMatcherType { kFlow, kLbd };

struct LineTrackerConfig {
  LineDetectorType line_detector = LineDetectorType::kFld;
  LineMatcherType line_matcher = LineMatcherType::kFlow;
  bool half_resolution = true;   // detect at half resolution; refinement is at full resolution
  bool join_fragments = true;    // join collinear fragments of an image
  int max_lines = 60;            // lines per image
  double min_length = 0.08;      // minimum length, relative to the image's short side
  double border = 4;             // minimum distance from the image border [px]
  double min_gradient = 5;       // minimum gradient across a line [grey levels/px]
  double spacing = 5;            // minimum distance between parallel lines side by side [px]
  double refill_below = 0.9;     // share of max_lines below which lines are detected
  int refill_interval = 3;       // minimum number of images between detections
  double max_angle = 10;         // between the predicted and the observed line [deg]
  double max_distance = 40;      // between the predicted and the observed line [px]
  double min_overlap = 0.5;      // of the predicted and the observed line, relative to the shorter
  double min_correlation = 0.6;  // of the brightness profiles across a line in consecutive images
  int max_descriptor_distance = 50;  // LBD: differing bits of 256
};

ConfigKeys<LineTrackerConfig> LineTrackerKeys();

}  // namespace plm_vins
