// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <map>
#include <memory>
#include <opencv2/core.hpp>
#include <optional>
#include <vector>

#include "common/camera/camera_model.h"
#include "common/features/placed_features.h"
#include "common/geometry/rigid3.h"

namespace plm_vins {

// An image of one camera.
struct CameraImage {
  cv::Mat gray;                       // CV_8UC1, distorted, as delivered by the camera
  std::shared_ptr<const void> owner;  // owner of the pixels, if `gray` does not own them
};

// Input of loop closure: the images of one time with the odometry's results for them. O is the
// odometry's world, with z up; each start of odometry begins a new one.
struct OdometryFrame {
  int64_t t_ns = 0;
  bool restarted = false;  // O is new from this image on
  Rigid3d T_O_B;
  std::vector<Rigid3d> T_B_C{Rigid3d()};  // by camera
  // The refined cameras, by which all rays are recomputed; empty if none is refined.
  std::vector<CameraParameters> refined;
  Eigen::Matrix<double, 6, 6> covariance = Eigen::Matrix<double, 6, 6>::Zero();  // (p_O, theta_B)
  std::vector<TrackedCorner> corners;
  std::vector<TrackedSegment> segments;
  std::map<int, CameraImage> images;  // by camera; those of them that are described
};

}  // namespace plm_vins
