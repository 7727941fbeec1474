// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "pose_graph/keyframes/keyframe.h"

namespace plm_vins {

// A point in space with what it looked like in several images.
struct DescribedLandmark {
  Eigen::Vector3d p_O = Eigen::Vector3d::Zero();  // [m]
  std::vector<Descriptor> descriptors;
  int64_t track = -1;
};

// The landmarks of keyframes of one world but those of the tracks `without`, which are sorted. Each
// once, in order of the tracks: the place is that of its newest keyframe.
std::vector<DescribedLandmark> MergeLandmarks(const std::vector<const Keyframe*>& island,
                                              const std::vector<int64_t>& without = {});

struct MatchingOptions {
  static constexpr double kSearchRadius_px = 23;

  explicit MatchingOptions(double focal_length)  // [px]
      : search_radius(kSearchRadius_px / focal_length) {}

  int max_distance = 72;   // [bits]
  double max_ratio = 0.9;  // of the distances of the best and the second best landmark
  double search_radius;    // around where a landmark should be seen (normalised)
};

struct LandmarkMatch {
  size_t corner = 0;
  size_t landmark = 0;
};

// Pairs of corner and landmark that are each other's nearest, clearly so for the corner.
std::vector<LandmarkMatch> MatchLandmarks(const MatchingOptions& options,
                                          const std::vector<DescribedCorner>& corners,
                                          const std::vector<DescribedLandmark>& landmarks);

// The same where a pose is known already: each landmark among the corners around its image, but
// those far from it, too, so that the pose can still turn out to be wrong. `R_G_C` is level.
std::vector<LandmarkMatch> MatchAroundImages(const MatchingOptions& options,
                                             const std::vector<DescribedCorner>& corners,
                                             const std::vector<DescribedLandmark>& landmarks,
                                             const LevelTransform& T_O_G,
                                             const Eigen::Quaterniond& R_G_C);

}  // namespace plm_vins
