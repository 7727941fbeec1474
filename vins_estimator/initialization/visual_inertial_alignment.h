// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "common/geometry/rigid3.h"
#include "vins_estimator/imu/preintegration.h"
#include "vins_estimator/structure_from_motion/stereo_structure.h"

namespace plm_vins {

// Rotation of the body between two images, measured by the camera.
struct RotationMeasurement {
  const Preintegration* preintegration;  // over the same interval
  Eigen::Quaterniond R_B0_B1;
  Eigen::Matrix3d information;  // for a right perturbation R_B0_B1 Exp(theta) [1/rad^2]
};

// Estimates the gyroscope bias for which the integrated rotations agree best with the camera's
// [rad/s]; robust. Returns nullopt, with the reason, if the bias is unobservable.
std::optional<Eigen::Vector3d> EstimateGyroBias(
    const std::vector<RotationMeasurement>& measurements, std::string* reason);

// Returns the rotations between the views of a structure, one for each interval.
std::vector<RotationMeasurement> RotationsBetween(const StereoStructure& structure,
                                                  const std::vector<Preintegration>& intervals);

// Pose of an image before the alignment, in a frame G with unknown gravity direction.
struct AlignmentView {
  Eigen::Quaterniond R_G_B;
  Eigen::Vector3d q_G_C;  // camera center up to scale: p_G_C = scale * q_G_C + constant
};

struct AlignmentOptions {
  Rigid3d T_B_C;
  double gravity_norm;          // [m/s^2]
  double accel_bias_deviation;  // standard deviation about 0 [m/s^2]
  double scale_deviation = std::numeric_limits<double>::infinity();  // about 1; infinite: unknown
};

struct Alignment {
  double scale = 0;                         // meters per unit of the structure
  double scale_deviation = 0;               // standard deviation of `scale`
  Eigen::Vector3d gravity_G;                // [m/s^2], pointing down
  Eigen::Vector3d accel_bias;               // [m/s^2]
  std::vector<Eigen::Vector3d> velocity_G;  // velocity of B, one per view [m/s]
};

// Estimates velocities, gravity and scale from preintegrated measurements and positions up to scale
// by weighted linear least squares ([Qin2018], section V.B, in another frame): first with free
// gravity, then with gravity of known norm in its tangent plane and with the accelerometer bias.
// `preintegrations[i]` is from view i to view i + 1 and is linearized at the gyroscope bias.
// Returns nullopt, with the reason, if gravity or scale are impossible.
std::optional<Alignment> AlignVisualInertial(
    const std::vector<AlignmentView>& views,
    const std::vector<const Preintegration*>& preintegrations, const AlignmentOptions& options,
    std::string* reason);

}  // namespace plm_vins
