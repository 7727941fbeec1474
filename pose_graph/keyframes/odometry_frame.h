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

// One image with what odometry says about it: all that loop closure takes. O is the odometry's
// world, z up, which starts anew with the odometry.
struct OdometryFrame {
  int64_t t_ns = 0;
  bool restarted = false;  // O is a new one from here on
  Rigid3d T_O_B;
  Rigid3d T_B_C;
  std::optional<CameraParameters> camera;  // as refined by now: all rays are taken anew by it
  Eigen::Matrix<double, 6, 6> covariance = Eigen::Matrix<double, 6, 6>::Zero();  // (p_O, theta_B)
  std::optional<Eigen::Quaterniond> R_O_Manhattan;  // the Manhattan frame, where one is locked
  std::vector<TrackedCorner> corners;
  std::vector<TrackedSegment> segments;
  cv::Mat gray;                       // CV_8UC1, as the camera delivered it
  std::shared_ptr<const void> owner;  // of the pixels, where `gray` is not
};

}  // namespace plm_vins
