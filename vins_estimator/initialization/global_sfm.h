// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <optional>
#include <string>
#include <vector>

#include "vins_estimator/initialization/tracks.h"

namespace plm_vins {

struct GlobalSfmOptions {
  double focal_length;     // [px]
  double noise_px;         // standard deviation of a corner
  double min_parallax_px;  // median over the points of the best pair of views
};

// Camera centres and points in a frame G, up to one unknown scale.
struct Structure {
  std::vector<Eigen::Vector3d> p_G_C;               // one per view, the first at the origin
  std::vector<std::optional<Eigen::Vector3d>> p_G;  // one per track; nothing where not reliable
  int num_points = 0;
};

// Structure from motion for views whose rotations R_G_C are known (from the gyro): positions are
// left, which makes every step linear. The pair of views with the most parallax starts; the other
// views are resected and further points triangulated in turn; a bundle adjustment over positions
// and points ends it. Nothing, and the reason in words, where there is too little parallax or there
// are too few common points.
std::optional<Structure> ReconstructStructure(const std::vector<Track>& tracks,
                                              const std::vector<Eigen::Quaterniond>& R_G_C,
                                              const GlobalSfmOptions& options, std::string* reason);

}  // namespace plm_vins
