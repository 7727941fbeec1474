// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>

namespace plm_vins {

// What is counted in one frame, in the order of the columns of timing.csv.
enum FrameCount : size_t {
  kPointsFollowed,  // from the image before to this one
  kPointsFlowLost,  // lost: flow failed or left the image
  kPointsNotBack,   // lost: followed back, it did not return
  kPointsEpipolar,  // lost: against the epipolar geometry
  kPointsCrowded,   // dropped: too near an older one, or under the mask
  kPointsAdded,     // new in this image
  kPointsObserved,  // that the estimator got
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
  kMergeCandidates,    // pairs of lines looked at, and why some were not merged:
  kMergeOtherDirection,
  kMergeDistant,         // beside each other in space
  kMergeApart,           // one behind the other, with a gap
  kMergeDistantInImage,  // beside each other in an image
  kMergeSideBySide,      // one image shows both
  kMergeInconsistent,    // the views do not fit one line
  kLinesInWindow,        // landmarks in the optimisation
  kLinesRejected,        // landmarks or observations thrown out after it
  kLinesWandering,       // landmarks that turned out to wander (NoteWandering)
  kFrameCounts
};

constexpr std::array<const char*, kFrameCounts> kCountNames = {
    "points_followed",        "points_flow_lost",      "points_not_back",    "points_epipolar",
    "points_crowded",         "points_added",          "points_observed",    "points_in_window",
    "points_rejected",        "lines_followed",        "lines_unmatched",    "lines_off_course",
    "lines_edge_lost",        "lines_duplicate",       "lines_detected",     "lines_added",
    "lines_observed",         "lines_triangulated",    "lines_degenerate",   "lines_behind",
    "lines_inconsistent",     "lines_too_long",        "lines_merged",       "lines_recognised",
    "merge_candidates",       "merge_other_direction", "merge_distant",      "merge_apart",
    "merge_distant_in_image", "merge_side_by_side",    "merge_inconsistent", "lines_in_window",
    "lines_rejected",         "lines_wandering"};

using FrameCounts = std::array<int, kFrameCounts>;

}  // namespace plm_vins
