// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>

namespace plm_vins {

// What is counted in one frame, in the order of the columns of timing.csv.
enum FrameCount : size_t {
  kPointsObserved,  // in this image
  kPointsInWindow,  // landmarks in the optimisation
  kPointsRejected,  // landmarks or observations thrown out
  kLinesFollowed,   // from the image before to this one
  kLinesUnmatched,  // lost: flow failed or looks different, no match
  kLinesOffCourse,  // lost: too far from the prediction
  kLinesEdgeLost,   // lost: no edge where the flow led
  kLinesDuplicate,  // lost: came to lie on an older one
  kLinesDetected,   // found by the detector, joined and long enough; zero where it did not run
  kLinesAdded,      // new in this image
  kLinesObserved,   // that the estimator got
  kLinesTriangulated,
  kLinesDegenerate,    // not triangulated: wait for more baseline
  kLinesBehind,        // not triangulated, removed: behind a camera
  kLinesInconsistent,  // not triangulated, removed: views contradict each other
  kLinesTooLong,       // not triangulated, removed: longer than line_outlier_distance
  kLinesMerged,        // landmarks absorbed by an older one
  kLinesRecognised,    // landmarks that are a line which had left the window
  kLinesInWindow,      // landmarks in the optimisation
  kLinesRejected,      // landmarks or observations thrown out after it
  kFrameCounts
};

constexpr std::array<const char*, kFrameCounts> kCountNames = {
    "points_observed",  "points_in_window", "points_rejected",    "lines_followed",
    "lines_unmatched",  "lines_off_course", "lines_edge_lost",    "lines_duplicate",
    "lines_detected",   "lines_added",      "lines_observed",     "lines_triangulated",
    "lines_degenerate", "lines_behind",     "lines_inconsistent", "lines_too_long",
    "lines_merged",     "lines_recognised", "lines_in_window",    "lines_rejected"};

using FrameCounts = std::array<int, kFrameCounts>;

}  // namespace plm_vins
