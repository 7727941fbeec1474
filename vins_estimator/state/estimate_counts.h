// SPDX-License-Identifier: BSD-3-Clause
// Feature counts of one frame.
#pragma once

namespace plm_vins {

// Results of line triangulation in one frame.
struct LineTriangulationCounts {
  int triangulated = 0;
  int degenerate = 0;    // kept until there is more baseline
  int behind = 0;        // removed
  int inconsistent = 0;  // removed
  int too_long = 0;      // removed
};

// Results of line merging in one frame: the pairs of nearby lines, and why they were not merged.
struct LineMergingCounts {
  int candidates = 0;  // pairs compared
  int merged = 0;      // landmarks merged into others
  int other_direction = 0;
  int distant = 0;  // distance across the lines in space
  int apart = 0;    // gap along the lines
  int distant_in_image = 0;
  int seen_side_by_side = 0;  // observed in one image
  int inconsistent = 0;       // the observations do not fit one line
};

// Observations in the window that measure the depth of points in single frames.
struct DepthCounts {
  int used = 0;
  int rejected = 0;  // removed as outliers
};

// Feature counts of one frame.
struct EstimatorCounts {
  int points_observed = 0;   // in this image
  int points_in_window = 0;  // optimized landmarks
  int points_rejected = 0;   // landmarks or observations removed as outliers
  int lines_observed = 0;    // in this image
  int lines_in_window = 0;   // optimized landmarks
  int lines_rejected = 0;    // landmarks or observations removed as outliers
  int known_seen = 0;        // optimized landmarks, points and lines, in this image
  int known_rejected = 0;    // outliers among them
  DepthCounts matched;       // by other cameras than the host's
  DepthCounts depth;         // measured
  LineTriangulationCounts line_triangulation;
  LineMergingCounts line_merging;
  int lines_recognized = 0;  // re-observed lines that had left the window
};

}  // namespace plm_vins
