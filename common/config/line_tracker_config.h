// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "common/config/config_key.h"

namespace plm_vins {

enum class LineDetectorType { kFld, kLsd, kEdLines };
enum class LineMatcherType { kFlow, kLbd };

struct LineTrackerConfig {
  LineDetectorType line_detector = LineDetectorType::kFld;
  LineMatcherType line_matcher = LineMatcherType::kFlow;
  bool half_resolution = true;       // detect at half resolution; lines are refined at the full one
  bool join_fragments = true;        // join collinear fragments of one image
  int max_lines = 60;                // lines per image
  double min_length = 0.08;          // shortest line, as a share of the image's short side
  double border = 4;                 // lines keep this far from the image's edge [px]
  double min_gradient = 5;           // least slope across a line [grey levels/px]
  double spacing = 5;                // least distance between parallel lines side by side [px]
  double refill_below = 0.9;         // detect where fewer than this share of max_lines is tracked
  int refill_interval = 3;           // and at most every so many images
  double max_angle = 10;             // between where a line is predicted and found [deg]
  double max_distance = 40;          // the same, across the line [px]
  double min_overlap = 0.5;          // the same, as a share of the shorter one
  double min_correlation = 0.6;      // of the brightness around a line from image to image
  int max_descriptor_distance = 50;  // LBD: differing bits of 256
};

ConfigKeys<LineTrackerConfig> LineTrackerKeys();

}  // namespace plm_vins
