// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>

namespace plm_vins {

// Feature counts of one frame, in the order of the columns of timing.csv.
enum FrameCount : size_t {
  kPointsFollowed,  // tracked from the previous image
  kPointsFlowLost,  // lost: flow failed or left the image
  kPointsNotBack,   // lost: backward flow did not return to the start
  kPointsEpipolar,  // lost: epipolar outlier
  kPointsCrowded,   // dropped: too near an older one, or masked
  kPointsAdded,     // new in this image
  kPointsObserved,  // given to the estimator
  kPointsInWindow,  // optimized landmarks
  kPointsRejected,  // landmarks or observations removed as outliers
  kLinesFollowed,   // tracked from the previous image
  kLinesUnmatched,  // lost: flow failed or appearance differs
  kLinesOffCourse,  // lost: too far from the prediction
  kLinesEdgeLost,   // lost: no edge at the predicted position
  kLinesDuplicate,  // lost: coincides with an older one
  kLinesDetected,   // detected, joined and long enough; zero if the detector did not run
  kLinesAdded,      // new in this image
  kLinesObserved,   // given to the estimator
  kLinesTriangulated,
  kLinesDegenerate,    // not triangulated: kept until there is more baseline
  kLinesBehind,        // not triangulated, removed: behind a camera
  kLinesInconsistent,  // not triangulated, removed: observations do not fit one line
  kLinesTooLong,       // not triangulated, removed: longer than line_outlier_distance
  kLinesMerged,        // landmarks merged into an older one
  kLinesRecognized,    // re-observed lines that had left the window
  kMergeCandidates,    // pairs of lines compared; the reasons not to merge them follow
  kMergeOtherDirection,
  kMergeDistant,         // distance across the lines in space
  kMergeApart,           // gap along the lines
  kMergeDistantInImage,  // distance across the lines in an image
  kMergeSideBySide,      // observed in one image
  kMergeInconsistent,    // the observations do not fit one line
  kLinesInWindow,        // optimized landmarks
  kLinesRejected,        // landmarks or observations removed as outliers
  kRightUsed,            // observations of points in the second camera, in the window
  kRightRejected,        // removed as outliers
  kDepthsUsed,           // measured depths of points, in the window
  kDepthsRejected,       // removed as outliers
  kFrameCounts
};

constexpr std::array<const char*, kFrameCounts> kCountNames = {
    // Points.
    "points_followed", "points_flow_lost", "points_not_back", "points_epipolar", "points_crowded",
    "points_added", "points_observed", "points_in_window", "points_rejected",
    // Lines.
    "lines_followed", "lines_unmatched", "lines_off_course", "lines_edge_lost", "lines_duplicate",
    "lines_detected", "lines_added", "lines_observed", "lines_triangulated", "lines_degenerate",
    "lines_behind", "lines_inconsistent", "lines_too_long", "lines_merged", "lines_recognized",
    // Merging.
    "merge_candidates", "merge_other_direction", "merge_distant", "merge_apart",
    "merge_distant_in_image", "merge_side_by_side", "merge_inconsistent",
    // Lines after the optimization.
    "lines_in_window", "lines_rejected",
    // Second camera and depth.
    "right_used", "right_rejected", "depths_used", "depths_rejected"};

using FrameCounts = std::array<int, kFrameCounts>;

}  // namespace plm_vins
