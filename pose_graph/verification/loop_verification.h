// SPDX-License-Identifier: BSD-3-Clause
#pragma once

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
  int max_common_tracks = 40;  // a pair with more belongs to the same visit
  int min_matches = 15;
  int min_pose_inliers = 8;  // among the matches
  int min_inliers = 12;      // in the later image
  double min_inlier_share = 0.3;
  int min_cells = 4;  // cells of the 4 x 3 grid with inliers
  int min_backward_inliers = 8;
  double min_backward_share = 0.15;
  int min_inliers_of_both = 28;  // sum over both images
  int min_visible_lines = 5;     // fewer are not tested
  double min_line_share = 0.15;
};

// An image of a keyframe (an element of `all`), and the temporal neighbors of the keyframe:
// landmarks of the same camera there supplement those of the image.
struct Island {
  const Keyframe* keyframe = nullptr;
  int camera = 0;
  std::vector<const Keyframe*> all;
};

// Decides from images and landmarks alone whether two images show the same place.
class LoopVerification {
 public:
  LoopVerification(const LoopVerificationOptions& options, CameraModels cameras);

  // Passes the candidate through the gates from kApart to kLines. Sets the values of the gates, and
  // the gate that rejected the candidate or, if none did, the relative pose with covariance.
  // Returns the consistent observations of the gates that were reached.
  LoopObservations Verify(const Island& earlier, const Island& later,
                          LoopCandidate* candidate) const;

  double max_error() const { return options_.ransac.max_error; }  // of an inlier (normalized)

 private:
  struct Evidence;

  // Each function returns whether the candidate passes at least one gate. Each gate sets `failed`
  // to itself before it is tested; the last one clears it.
  bool AreApart(const Island& earlier, const Island& later, LoopCandidate* candidate,
                Evidence* evidence) const;
  bool FindPose(const Island& earlier, LoopCandidate* candidate, Evidence* evidence) const;
  bool HasInliers(LoopCandidate* candidate, Evidence* evidence) const;
  bool HoldsBackwards(const Island& earlier, const Island& later, LoopCandidate* candidate,
                      Evidence* evidence) const;
  bool Refine(LoopCandidate* candidate, Evidence* evidence) const;
  bool LinesAgree(const Island& earlier, const Island& later, LoopCandidate* candidate,
                  Evidence* evidence) const;

  LoopVerificationOptions options_;
  CameraModels cameras_;
};

}  // namespace plm_vins
