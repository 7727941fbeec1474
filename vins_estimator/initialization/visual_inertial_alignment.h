// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <optional>
#include <string>
#include <vector>

#include "common/geometry/rigid3.h"
#include "vins_estimator/imu/preintegration.h"

namespace plm_vins {

// The rotation of the body between two images as the camera sees it.
struct RotationMeasurement {
  const Preintegration* preintegration;  // over the same interval
  Eigen::Quaterniond R_B0_B1;
  Eigen::Matrix3d information;  // of a right perturbation R_B0_B1 Exp(theta) [1/rad^2]
};

// The gyro bias under which the integrated rotations agree best with the camera's [rad/s];
// robust. Nothing, and the reason in words, where the rotations do not determine it.
std::optional<Eigen::Vector3d> EstimateGyroBias(
    const std::vector<RotationMeasurement>& measurements, std::string* reason);

// What the alignment knows of one image: B in the frame G, in which gravity is not yet known.
struct AlignmentView {
  Eigen::Quaterniond R_G_B;
  Eigen::Vector3d q_G_C;  // camera centre up to scale: p_G_C = scale * q_G_C + constant
};

struct Alignment {
  double scale = 0;                         // metres per unit of the structure
  Eigen::Vector3d gravity_G;                // [m/s^2], pointing down
  Eigen::Vector3d accel_bias;               // [m/s^2]
  std::vector<Eigen::Vector3d> velocity_G;  // of B, one per view [m/s]
};

// Velocities, gravity and scale from preintegrated motion and positions up to scale: weighted
// linear least squares ([Qin2018], section V.B, in another frame), first with free gravity, then
// with gravity of the known norm on its tangent plane and with the accelerometer bias.
// `preintegrations[i]` leads from view i to view i + 1 and is linearised at the gyro bias.
// Nothing, and the reason in words, where gravity or scale come out impossible.
std::optional<Alignment> AlignVisualInertial(
    const std::vector<AlignmentView>& views,
    const std::vector<const Preintegration*>& preintegrations, const Rigid3d& T_B_C,
    double gravity_norm, std::string* reason);

}  // namespace plm_vins
