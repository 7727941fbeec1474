// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "pose_graph/keyframes/keyframe.h"

namespace plm_vins {

// A landmark with its descriptors from several images.
struct DescribedLandmark {
  Eigen::Vector3d p_O = Eigen::Vector3d::Zero();  // [m]
  std::vector<Descriptor> descriptors;
  int64_t track = -1;
};

// Returns the landmarks that a camera observes in keyframes of one world, except those of the
// tracks `without` (sorted). Each landmark appears once, in track order, with the position of its
// newest keyframe.
std::vector<DescribedLandmark> MergeLandmarks(const std::vector<const Keyframe*>& island,
                                              int camera, const std::vector<int64_t>& without = {});

struct MatchingOptions {
  static constexpr double kSearchRadius_px = 23;

  explicit MatchingOptions(double focal_length)  // [px]
      : search_radius(kSearchRadius_px / focal_length) {}

  int max_distance = 72;   // [bits]
  double max_ratio = 0.9;  // distance ratio of the best and second best landmark
  double search_radius;    // around the predicted image of a landmark (normalized)
};

struct LandmarkMatch {
  size_t corner = 0;
  size_t landmark = 0;
};

// Returns mutually nearest pairs of corner and landmark that pass the ratio test for the corner.
std::vector<LandmarkMatch> MatchLandmarks(const MatchingOptions& options,
                                          const std::vector<DescribedCorner>& corners,
                                          const std::vector<DescribedLandmark>& landmarks);

// Matches each landmark with the corners around its predicted image, given the pose. Matches far
// from the prediction are included, so that a wrong pose is recognized by its few inliers. `R_G_C`
// is the camera's rotation in a level frame G (z up).
std::vector<LandmarkMatch> MatchAroundImages(const MatchingOptions& options,
                                             const std::vector<DescribedCorner>& corners,
                                             const std::vector<DescribedLandmark>& landmarks,
                                             const LevelTransform& T_O_G,
                                             const Eigen::Quaterniond& R_G_C);

}  // namespace plm_vins
