// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <optional>
#include <string>
#include <vector>

#include "vins_estimator/structure_from_motion/tracks.h"

namespace plm_vins {

struct GlobalSfmOptions {
  double focal_length;     // [px]
  double noise_px;         // standard deviation of a corner [px]
  double min_parallax_px;  // median over the points of the best pair of views
};

// Camera centers and points in a frame G, up to an unknown scale.
struct Structure {
  std::vector<Eigen::Vector3d> p_G_C;               // one per view, the first at the origin
  std::vector<std::optional<Eigen::Vector3d>> p_G;  // one per track; nullopt if not reliable
  int num_points = 0;
};

// Computes structure from motion for views whose rotations R_G_C are known from the gyroscope, so
// that only positions are unknown and every step is linear. It starts with the pair of views with
// the most parallax, then alternately resects the other views and triangulates points; a bundle
// adjustment over positions and points completes it. Returns nullopt, with the reason, if there is
// too little parallax or there are too few common points.
std::optional<Structure> ReconstructStructure(const std::vector<Track>& tracks,
                                              const std::vector<Eigen::Quaterniond>& R_G_C,
                                              const GlobalSfmOptions& options, std::string* reason);

}  // namespace plm_vins
