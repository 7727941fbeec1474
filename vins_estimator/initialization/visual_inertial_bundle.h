// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "common/geometry/rigid3.h"
#include "vins_estimator/imu/preintegration.h"
#include "vins_estimator/state/frame_state.h"
#include "vins_estimator/structure_from_motion/tracks.h"

namespace plm_vins {

struct VisualInertialBundleOptions {
  std::vector<Rigid3d> T_B_C;   // by camera
  double gravity_norm;          // [m/s^2]
  double noise;                 // standard deviation of a normalized coordinate
  double accel_bias_deviation;  // standard deviation of the accelerometer bias about 0 [m/s^2]
  double gyro_bias_deviation = 0.05;  // deviation of the gyroscope bias from its start [rad/s]
  double depth_noise = 0;             // noise of a measured inverse depth, if tracks have any [1/m]
  double max_scale_deviation = std::numeric_limits<double>::infinity();  // accepted, relative
};

// Residuals of the adjusted states, in standard deviations (1 is ideal), and the scale uncertainty.
struct VisualInertialBundle {
  double reprojection_rms = 0;
  double imu_rms = 0;
  double outlier_share = 0;             // share of the observations of points
  double relative_scale_deviation = 0;  // standard deviation of the trajectory's size
};

// Refines poses, velocities and biases of a few frames together with their points by the IMU and
// reprojection residuals. Position and heading of the first frame are fixed. `p_W` has one entry
// per track; tracks with nullopt are ignored. `preintegrations[i]` is from state i to state i + 1.
// If the scale is too uncertain and the residuals show far less noise of the accelerometer than
// assumed, solves again with that noise.
// Returns nullopt, with the reason, if the states are unobservable.
std::optional<VisualInertialBundle> AdjustVisualInertialBundle(
    const std::vector<Track>& tracks, const std::vector<std::optional<Eigen::Vector3d>>& p_W,
    const std::vector<Preintegration>& preintegrations, const VisualInertialBundleOptions& options,
    std::vector<FrameState>* states, std::string* reason);

}  // namespace plm_vins
