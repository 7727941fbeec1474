// SPDX-License-Identifier: BSD-3-Clause
// Whitened residuals for Ceres that estimate the pose of a later visit's camera. O1 and O2 are
// those of LoopObservations.
#pragma once

#include <ceres/rotation.h>

#include <Eigen/Core>

#include "common/geometry/rigid3.h"
#include "pose_graph/verification/loop_observations.h"

namespace plm_vins {

// Parameters: position of the later camera in O1, yaw of T_O1_O2, and a tilt of O2 about its level
// axes, since the roll and pitch errors of odometry differ between the visits. (The camera's
// position hardly correlates with the yaw, unlike the translation of T_O1_O2, whose origin is far.)
constexpr int kPlaceSize = 6;

constexpr double kMinDepth = 1e-3;  // [m]

template <typename T>
Eigen::Matrix<T, 3, 3> RotationFromO2(const T* place) {
  const T yaw[3] = {T(0), T(0), place[3]};
  const T tilt[3] = {place[4], place[5], T(0)};
  Eigen::Matrix<T, 3, 3> about_z, about_level;
  ceres::AngleAxisToRotationMatrix(yaw, about_z.data());
  ceres::AngleAxisToRotationMatrix(tilt, about_level.data());
  return about_z * about_level;
}

// Transforms a point from O1 to the later camera.
template <typename T>
Eigen::Matrix<T, 3, 1> ToLaterCamera(const T* place, const Eigen::Vector3d& p_O1,
                                     const Rigid3d& T_O2_C) {
  const Eigen::Matrix<T, 3, 1> offset =
      p_O1.cast<T>() - Eigen::Map<const Eigen::Matrix<T, 3, 1>>(place);
  return T_O2_C.R().transpose().cast<T>() * (RotationFromO2(place).transpose() * offset);
}

// Transforms a point from O2 to the earlier camera.
template <typename T>
Eigen::Matrix<T, 3, 1> ToEarlierCamera(const T* place, const Eigen::Vector3d& p_O2,
                                       const Rigid3d& T_O2_C, const Rigid3d& T_O1_C) {
  const Eigen::Matrix<T, 3, 1> offset = (p_O2 - T_O2_C.translation).cast<T>();
  const Eigen::Matrix<T, 3, 1> p_O1 =
      Eigen::Map<const Eigen::Matrix<T, 3, 1>>(place) + RotationFromO2(place) * offset;
  return T_O1_C.R().transpose().cast<T>() * (p_O1 - T_O1_C.translation.cast<T>());
}

template <typename T>
bool ReprojectionError(const Eigen::Matrix<T, 3, 1>& p_C, const Eigen::Vector2d& xy,
                       const Eigen::Matrix2d& whitening, T* residual) {
  if (p_C.z() <= T(kMinDepth)) return false;
  const Eigen::Matrix<T, 2, 1> error = p_C.hnormalized() - xy.cast<T>();
  Eigen::Map<Eigen::Matrix<T, 2, 1>>{residual} = whitening.cast<T>() * error;
  return true;
}

// Reprojection error of an earlier visit's landmark in the later image.
struct EarlierLandmarkCost {
  template <typename T>
  bool operator()(const T* place, T* residual) const {
    return ReprojectionError<T>(ToLaterCamera(place, observation.p_O, T_O2_C), observation.xy,
                                whitening, residual);
  }
  SeenPoint observation;
  Rigid3d T_O2_C;
  Eigen::Matrix2d whitening;
};

// Reprojection error of a later visit's landmark in the earlier image.
struct LaterLandmarkCost {
  template <typename T>
  bool operator()(const T* place, T* residual) const {
    return ReprojectionError<T>(ToEarlierCamera(place, observation.p_O, T_O2_C, T_O1_C),
                                observation.xy, whitening, residual);
  }
  SeenPoint observation;  // with its point in O2
  Rigid3d T_O1_C;
  Rigid3d T_O2_C;
  Eigen::Matrix2d whitening;
};

// Distances of the segment's endpoints from the projected line.
struct LineCost {
  template <typename T>
  bool operator()(const T* place, T* residual) const {
    using std::sqrt;
    const Eigen::Matrix<T, 3, 1> start = ToLaterCamera(place, observation.line.start_O, T_O2_C);
    const Eigen::Matrix<T, 3, 1> end = ToLaterCamera(place, observation.line.end_O, T_O2_C);
    const Eigen::Matrix<T, 3, 1> line = start.cross(end);
    const T norm = sqrt(line.x() * line.x() + line.y() * line.y());
    if (norm < T(1e-12)) return false;
    const Eigen::Vector3d a = observation.segment.start.homogeneous();
    const Eigen::Vector3d b = observation.segment.end.homogeneous();
    residual[0] = line.dot(a.cast<T>()) / norm * weight;
    residual[1] = line.dot(b.cast<T>()) / norm * weight;
    return true;
  }
  SeenSegment observation;
  Rigid3d T_O2_C;
  double weight;
};

// Prior of the tilt about the level axes.
struct TiltCost {
  template <typename T>
  bool operator()(const T* place, T* residual) const {
    residual[0] = place[4] * weight;
    residual[1] = place[5] * weight;
    return true;
  }
  double weight;
};

}  // namespace plm_vins
