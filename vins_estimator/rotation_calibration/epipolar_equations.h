// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <vector>

#include "vins_estimator/rotation_calibration/extrinsic_rotation.h"

namespace plm_vins {

// Errors of a calibration, by first element.
struct CalibrationError {
  static constexpr int kBias = 0;        // of the gyroscope, 3 [rad/s]
  static constexpr int kDelay = 3;       // correction of td [s]
  static constexpr int kFocal = 4;       // by how much the focal length is too long, relative
  static constexpr int kDistortion = 5;  // rays (x, y) are (1 + d r^2) (x, y), with r^2 = x^2 + y^2
  static constexpr int kPrincipal = 6;   // shift of rays (x, y), 2
  static constexpr int kExtrinsics = 8;  // right perturbation of R_B_C, 3 [rad]
  static constexpr int kGyro = 11;       // E of readings (I + E) w, by columns, 9
  static constexpr int kSize = 20;

  using Vector = Eigen::Matrix<double, kSize, 1>;
  using Matrix = Eigen::Matrix<double, kSize, kSize>;
};

// Quadratic model of the cost of some errors: cost + g^T d + d^T H d / 2.
struct EpipolarEquations {
  CalibrationError::Matrix H = CalibrationError::Matrix::Zero();
  CalibrationError::Vector g = CalibrationError::Vector::Zero();
  double cost = 0;
  double points = 0;  // number of points in all pairs
};

// Linearizes the distances of points from their epipolar lines, about the errors `x`: the rotation
// is that of the gyro, and the translation of each pair, which is unknown, the one that fits best.
// So nothing needs to be known about the scene, and translation is no source of error. `noise` is
// the standard deviation of a normalized coordinate; outliers count little.
EpipolarEquations LinearizeEpipolar(const std::vector<RotationPair>& pairs,
                                    const Eigen::Quaterniond& R_B_C, double noise,
                                    const CalibrationError::Vector& x);

}  // namespace plm_vins
