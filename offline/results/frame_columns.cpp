// SPDX-License-Identifier: BSD-3-Clause
#include "offline/results/frame_columns.h"

namespace plm_vins {
namespace {

std::vector<Column<double>> TimingsOf(const PipelineFrame& frame) {
  const EstimatorTimings& estimator = frame.output.timings;
  return {
      {"point_tracking", frame.point_tracking_ms},
      {"line_detection", frame.line_tracking.detection_ms},
      {"line_tracking", frame.line_tracking_ms},  // the whole line front end, including detection
      {"initialization", estimator.initialization},
      {"line_merging", estimator.line_merging},  // includes the search for the Manhattan frame
      {"optimization", estimator.optimization},
      {"marginalization", estimator.marginalization},
      {"estimator", estimator.total},  // the whole back end
      {"total", frame.point_tracking_ms + frame.line_tracking_ms + estimator.total}};
}

std::vector<Column<int>> CountsOf(const PipelineFrame& frame) {
  const PointTrackerStatistics& points = frame.point_tracking;
  const LineTrackerStatistics& lines = frame.line_tracking;
  const EstimatorCounts& counts = frame.output.counts;
  const LineTriangulationCounts& triangulation = counts.line_triangulation;
  const LineMergingCounts& merging = counts.line_merging;
  const int points_lost =
      points.flow_lost + points.forward_backward + points.epipolar_outliers + points.crowded;
  const int lines_lost = lines.match_lost + lines.inconsistent + lines.edge_lost + lines.duplicates;
  return {{"points_followed", points.previous - points_lost},  // tracked from the previous image
          {"points_flow_lost", points.flow_lost},
          {"points_not_back", points.forward_backward},
          {"points_epipolar", points.epipolar_outliers},
          {"points_crowded", points.crowded},
          {"points_added", points.detected},
          {"points_observed", counts.points_observed},  // given to the estimator
          {"points_in_window", counts.points_in_window},
          {"points_rejected", counts.points_rejected},
          {"lines_followed", lines.previous - lines_lost},  // tracked from the previous image
          {"lines_unmatched", lines.match_lost},
          {"lines_off_course", lines.inconsistent},
          {"lines_edge_lost", lines.edge_lost},
          {"lines_duplicate", lines.duplicates},
          {"lines_detected", lines.candidates},  // joined and long enough
          {"lines_added", lines.added},
          {"lines_observed", counts.lines_observed},  // given to the estimator
          {"lines_triangulated", triangulation.triangulated},
          {"lines_degenerate", triangulation.degenerate},
          {"lines_behind", triangulation.behind},
          {"lines_inconsistent", triangulation.inconsistent},
          {"lines_too_long", triangulation.too_long},
          {"lines_merged", merging.merged},
          {"lines_recognized", counts.lines_recognized},
          {"merge_candidates", merging.candidates},
          {"merge_other_direction", merging.other_direction},
          {"merge_distant", merging.distant},
          {"merge_apart", merging.apart},
          {"merge_distant_in_image", merging.distant_in_image},
          {"merge_side_by_side", merging.seen_side_by_side},
          {"merge_inconsistent", merging.inconsistent},
          {"lines_in_window", counts.lines_in_window},
          {"lines_rejected", counts.lines_rejected},
          {"matched_used", counts.matched.used},
          {"matched_rejected", counts.matched.rejected},
          {"depths_used", counts.depth.used},
          {"depths_rejected", counts.depth.rejected}};
}

}  // namespace

FrameColumns ColumnsOf(const PipelineFrame& frame) { return {TimingsOf(frame), CountsOf(frame)}; }

}  // namespace plm_vins
