// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "pose_graph/geometry/level_transform.h"
#include "pose_graph/graph/level_edge.h"

namespace plm_vins {

// Gates that a loop passes, in this order; kRefinement runs additionally after kPose, and again
// with the lines.
enum class LoopGate {
  kScore,       // the images are similar
  kRepeated,    // a preceding image led to the same place
  kApart,       // few common tracks: the keyframe belongs to another visit
  kMatches,     // enough corners match landmarks
  kPose,        // RANSAC finds a pose with enough inliers
  kInliers,     // a guided search finds enough landmarks at their predicted pixels
  kSpread,      // the inliers are distributed over the image
  kBackwards,   // the earlier image observes the later landmarks as well
  kRefinement,  // the pose refinement succeeds
  kLines,       // enough predicted lines are found
  kOdometry,    // odometry does not contradict
  kAgreement,   // a second loop confirms a large correction
  kGraph,       // the optimized graph does not contradict
};
constexpr int kLoopGates = static_cast<int>(LoopGate::kGraph) + 1;

const char* ToString(LoopGate gate);

// A pair of keyframes that may show the same place, with the values of all gates. Values of gates
// that were not reached are nullopt.
struct LoopCandidate {
  int earlier = -1;  // keyframe numbers
  int later = -1;
  int earlier_camera = 0;  // of the images that show the same place
  int later_camera = 0;
  int64_t earlier_ns = 0;
  int64_t later_ns = 0;
  std::optional<LoopGate> failed;  // gate that rejected it; nullopt if accepted

  double score_share = 0;
  bool repeated = false;
  std::optional<int> common_tracks;
  std::optional<int> matches;
  std::optional<int> pose_inliers;
  std::optional<int> inliers;
  std::optional<double> inlier_share;
  std::optional<int> cells;  // image cells with inliers
  std::optional<int> backward_inliers;
  std::optional<double> backward_share;
  std::optional<int> visible_lines;
  std::optional<double> line_share;
  std::optional<double> odometry_error;  // [standard deviations]
  std::optional<double> graph_error;     // [standard deviations]

  // Pose of the later keyframe relative to the earlier one, with the axes of the earlier one's
  // world O: T_L_L of the two.
  LevelTransform T_earlier_later;
  Matrix4d covariance = Matrix4d::Zero();
};

// Removes the loops that begin or end at the keyframe.
void ForgetLoopsOf(int keyframe, std::vector<LoopCandidate>* loops);

// Converts the loop to an edge of the pose graph.
inline LevelEdge EdgeOf(const LoopCandidate& loop) {
  return {loop.earlier, loop.later, loop.T_earlier_later, loop.covariance, /*is_loop=*/true};
}

}  // namespace plm_vins
