// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "pose_graph/geometry/level_transform.h"
#include "pose_graph/graph/level_edge.h"

namespace plm_vins {

// What a loop must pass, in this order; but kRefinement already after kPose as well, and again
// with the lines.
enum class LoopGate {
  kScore,       // the images look alike
  kRepeated,    // an image before led to the same place
  kApart,       // few tracks are seen in both: it is another visit
  kMatches,     // corners have a like among the landmarks
  kPose,        // there is a pose from which some of them are seen
  kManhattan,   // the Manhattan frames agree on the heading
  kInliers,     // looked for around their images, enough landmarks are just there
  kSpread,      // they lie all over the image
  kBackwards,   // the earlier image sees the later landmarks, too
  kRefinement,  // the pose can be refined
  kLines,       // lines in view are there
  kOdometry,    // odometry does not contradict
  kAgreement,   // a large correction is asked for by two loops
  kGraph,       // the optimised graph does not contradict
};
constexpr int kLoopGates = static_cast<int>(LoopGate::kGraph) + 1;

const char* ToString(LoopGate gate);

// A pair of keyframes that may show one place, with what each gate said. Values of gates that were
// not reached are empty.
struct LoopCandidate {
  int earlier = -1;  // keyframes by number
  int later = -1;
  int64_t earlier_ns = 0;
  int64_t later_ns = 0;
  std::optional<LoopGate> failed;  // the gate that refused it; empty: accepted

  double score_share = 0;
  bool repeated = false;
  std::optional<int> common_tracks;
  std::optional<int> matches;
  std::optional<int> pose_inliers;
  std::optional<int> inliers;
  std::optional<double> inlier_share;
  std::optional<double> manhattan_error;  // [rad]
  std::optional<int> cells;               // of the image with inliers
  std::optional<int> backward_inliers;
  std::optional<double> backward_share;
  std::optional<int> visible_lines;
  std::optional<double> line_share;
  std::optional<double> odometry_error;  // [standard deviations]
  std::optional<double> graph_error;     // [standard deviations]

  // Where the later keyframe is, with the axes of the earlier one's world O: T_L_L of the two.
  LevelTransform T_earlier_later;
  Matrix4d covariance = Matrix4d::Zero();
};

// Takes out those that begin or end at the keyframe.
void ForgetLoopsOf(int keyframe, std::vector<LoopCandidate>* loops);

// The loop as the graph takes it.
inline LevelEdge EdgeOf(const LoopCandidate& loop) {
  return {loop.earlier, loop.later, loop.T_earlier_later, loop.covariance, /*is_loop=*/true};
}

}  // namespace plm_vins
