// SPDX-License-Identifier: BSD-3-Clause
#include "pose_graph/output/loop_table.h"

#include <optional>

#include "common/format.h"
#include "common/geometry/so3.h"

namespace plm_vins {
namespace {

void WriteNumber(double value, std::ostream* stream) { *stream << Format(",%.4f", value); }

void WriteCount(const std::optional<int>& value, std::ostream* stream) {
  *stream << ',';
  if (value) *stream << *value;
}

void WriteValue(const std::optional<double>& value, std::ostream* stream) {
  if (value) {
    WriteNumber(*value, stream);
  } else {
    *stream << ',';
  }
}

}  // namespace

void WriteLoopHeader(std::ostream* stream) {
  *stream
      << "later_ns,earlier_ns,later,earlier,result,score_share,repeated,common_tracks,matches,"
         "pose_inliers,inliers,inlier_share,cells,backward_inliers,backward_share,visible_lines,"
         "line_share,odometry_error_sigma,graph_error_sigma,x_m,y_m,z_m,yaw_deg,later_camera,"
         "earlier_camera\n";
}

void WriteLoopRow(const LoopCandidate& candidate, std::ostream* stream) {
  *stream << candidate.later_ns << ',' << candidate.earlier_ns << ',' << candidate.later << ','
          << candidate.earlier << ','
          << (candidate.failed ? ToString(*candidate.failed) : "accepted");
  WriteNumber(candidate.score_share, stream);
  *stream << ',' << candidate.repeated;
  WriteCount(candidate.common_tracks, stream);
  WriteCount(candidate.matches, stream);
  WriteCount(candidate.pose_inliers, stream);
  WriteCount(candidate.inliers, stream);
  WriteValue(candidate.inlier_share, stream);
  WriteCount(candidate.cells, stream);
  WriteCount(candidate.backward_inliers, stream);
  WriteValue(candidate.backward_share, stream);
  WriteCount(candidate.visible_lines, stream);
  WriteValue(candidate.line_share, stream);
  WriteValue(candidate.odometry_error, stream);
  WriteValue(candidate.graph_error, stream);
  const LevelTransform& T = candidate.T_earlier_later;
  for (int i = 0; i < 3; ++i) WriteNumber(T.translation(i), stream);
  WriteNumber(ToDegrees(T.yaw), stream);
  *stream << ',' << candidate.later_camera << ',' << candidate.earlier_camera << '\n';
}

}  // namespace plm_vins
