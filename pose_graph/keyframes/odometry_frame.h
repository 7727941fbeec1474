// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstdint>
#include <memory>
#include <opencv2/core.hpp>
#include <optional>
#include <vector>

#include "common/camera/camera_model.h"
#include "common/features/placed_features.h"
#include "common/geometry/rigid3.h"

namespace plm_vins {

// Input of loop closure: an image with the odometry's results for it. O is the odometry's world,
// with z up; each start of odometry begins a new one.
struct OdometryFrame {
  int64_t t_ns = 0;
  bool restarted = false;  // O is new from this image on
  Rigid3d T_O_B;
  Rigid3d T_B_C;
  std::optional<CameraParameters> camera;  // the refined camera; all rays are recomputed by it
  Eigen::Matrix<double, 6, 6> covariance = Eigen::Matrix<double, 6, 6>::Zero();  // (p_O, theta_B)
  std::optional<Eigen::Quaterniond> R_O_Manhattan;  // if a Manhattan frame was found
  std::vector<TrackedCorner> corners;
  std::vector<TrackedSegment> segments;
  cv::Mat gray;                       // CV_8UC1, distorted, as delivered by the camera
  std::shared_ptr<const void> owner;  // owner of the pixels, if `gray` does not own them
};

}  // namespace plm_vins
