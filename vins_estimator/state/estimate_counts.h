// SPDX-License-Identifier: BSD-3-Clause
// What is counted in one frame.
#pragma once

namespace plm_vins {

// What happened to the lines that were to be triangulated in one frame.
struct LineTriangulationCounts {
  int triangulated = 0;
  int degenerate = 0;    // wait for more baseline
  int behind = 0;        // removed
  int inconsistent = 0;  // removed
  int too_long = 0;      // removed
};

// What became of the pairs of lines that are near each other, in one frame.
struct LineMergingCounts {
  int candidates = 0;  // pairs looked at
  int merged = 0;      // landmarks absorbed
  int other_direction = 0;
  int distant = 0;  // beside each other in space
  int apart = 0;    // one behind the other, with a gap
  int distant_in_image = 0;
  int seen_side_by_side = 0;  // in one image
  int inconsistent = 0;       // the views do not fit one line: undone
};

// Feature counts of one frame.
struct EstimatorCounts {
  int points_observed = 0;   // in this image
  int points_in_window = 0;  // landmarks in the optimisation
  int points_rejected = 0;   // landmarks or observations thrown out in this frame
  int lines_observed = 0;    // in this image
  int lines_in_window = 0;   // landmarks in the optimisation
  int lines_rejected = 0;    // landmarks or observations thrown out in this frame
  int lines_wandering = 0;   // landmarks that turned out to wander (NoteWandering)
  int known_seen = 0;        // landmarks in the optimisation, of both kinds, in this image
  int known_rejected = 0;    // of them: not where they should be
  LineTriangulationCounts line_triangulation;
  LineMergingCounts line_merging;
  int lines_recognised = 0;  // landmarks that turned out to be a line which had left the window
};

}  // namespace plm_vins
