// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <vector>

#include "common/camera/camera_model.h"
#include "pose_graph/keyframes/keyframe.h"
#include "pose_graph/verification/landmark_matching.h"
#include "pose_graph/verification/level_pose_ransac.h"
#include "pose_graph/verification/line_witnesses.h"
#include "pose_graph/verification/loop_candidate.h"
#include "pose_graph/verification/loop_refinement.h"

namespace plm_vins {

struct LoopVerificationOptions {
  explicit LoopVerificationOptions(double focal_length)  // [px]
      : matching(focal_length),
        ransac(focal_length),
        refinement(focal_length),
        witnesses(focal_length) {}

  MatchingOptions matching;
  LevelPoseRansacOptions ransac;
  LoopRefinementOptions refinement;
  LineWitnessOptions witnesses;
  int max_common_tracks = 40;  // more, and it is the same visit
  int min_matches = 15;
  int min_pose_inliers = 8;  // of them, for a pose that is looked into
  int min_inliers = 12;      // of the later image
  double min_inlier_share = 0.3;
  double max_manhattan_error = 3 * M_PI / 180;  // [rad]
  int min_cells = 4;                            // of 4 x 3, with inliers
  int min_backward_inliers = 8;
  double min_backward_share = 0.15;
  int min_inliers_of_both = 28;  // of both images together
  int min_visible_lines = 5;     // fewer say nothing
  double min_line_share = 0.15;
};

// A keyframe and its neighbours in time, whose landmarks it knows as well. The keyframe is one of
// the island.
struct Island {
  const Keyframe* keyframe = nullptr;
  std::vector<const Keyframe*> all;
};

// Whether two keyframes show one place, by all that can be seen in them alone.
class LoopVerification {
 public:
  LoopVerification(const LoopVerificationOptions& options,
                   std::shared_ptr<const CameraModel> camera);

  // Takes the candidate through the gates from kApart to kLines. Fills in the gates' values, the
  // one that refused it and, where none did, the transform with its covariance. Returns the
  // sightings that agree, as far as the gates were reached.
  LoopSightings Verify(const Island& earlier, const Island& later, LoopCandidate* candidate) const;

 private:
  struct Evidence;

  // Whether a gate, or several, let the candidate pass. Each names itself in `failed` before it
  // looks; the last one clears that.
  bool AreApart(const Island& earlier, const Island& later, LoopCandidate* candidate,
                Evidence* evidence) const;
  bool FindPose(const Island& earlier, const Keyframe& later, LoopCandidate* candidate,
                Evidence* evidence) const;
  bool ManhattanAgrees(const Keyframe& earlier, const Keyframe& later, LoopCandidate* candidate,
                       const Evidence& evidence) const;
  bool HasInliers(const Keyframe& later, LoopCandidate* candidate, Evidence* evidence) const;
  bool HoldsBackwards(const Keyframe& earlier, const Island& later, LoopCandidate* candidate,
                      Evidence* evidence) const;
  bool Refine(LoopCandidate* candidate, Evidence* evidence) const;
  bool LinesAgree(const Island& earlier, const Keyframe& later, LoopCandidate* candidate,
                  Evidence* evidence) const;

  LoopVerificationOptions options_;
  std::shared_ptr<const CameraModel> camera_;
};

}  // namespace plm_vins
