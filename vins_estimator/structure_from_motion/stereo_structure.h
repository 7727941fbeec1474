// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <optional>
#include <string>
#include <vector>

#include "common/geometry/rigid3.h"
#include "vins_estimator/structure_from_motion/tracks.h"

namespace plm_vins {

struct StereoStructureOptions {
  std::vector<Rigid3d> T_B_C;  // by camera
  double noise;                // standard deviation of a normalized coordinate
  double min_angle;            // between the rays of a point in two cameras [rad]
  // Rounds in which all points are triangulated by the motion of one camera, and the views resected
  // by these. Points by two cameras alone have noisy depths, which make the motion too short, and
  // wrong ones if one is turned; so the scale of the result is then fitted to all depths measured
  // in single views.
  int refinements = 0;
};

// Body poses and points [m] in the frame G of one of the views.
struct StereoStructure {
  std::vector<Rigid3d> T_G_B;  // one per view
  // Inverse covariance of theta in R_G_B Exp(theta) with unknown translation [1/rad^2].
  std::vector<Eigen::Matrix3d> rotation_information;
  // Inverse covariance of the position with unknown rotation [1/m^2]; zero in the view that was not
  // resected.
  std::vector<Eigen::Matrix3d> position_information;
  std::vector<std::optional<Eigen::Vector3d>> p_G;  // one per track; nullopt if unknown
  double scale_deviation = 0;  // relative, if refined: depths may have an offset (turned cameras)
};

// Stereo odometry over a few views. Starts in the view with the most points that two cameras
// observe or whose depth is measured, then alternately resects the neighboring views by these
// points (robust reprojection errors in all cameras, all six degrees of freedom) and adds the
// points that have a depth there. `R_G_B` are initial rotations in any common frame. Returns
// nullopt, with the reason, if too few points are observed.
std::optional<StereoStructure> ReconstructFromStereo(const std::vector<Track>& tracks,
                                                     const std::vector<Eigen::Quaterniond>& R_G_B,
                                                     const StereoStructureOptions& options,
                                                     std::string* reason);

}  // namespace plm_vins
