// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "common/imu/imu_noise.h"
#include "vins_estimator/state/calibration.h"
#include "vins_estimator/state/estimate_counts.h"
#include "vins_estimator/state/frame_state.h"
#include "vins_estimator/state/map_elements.h"

namespace plm_vins {

using Matrix6d = Eigen::Matrix<double, 6, 6>;

enum class EstimatorStatus { kInitializing, kTracking, kLost };

inline const char* ToString(EstimatorStatus status) {
  switch (status) {
    case EstimatorStatus::kInitializing:
      return "initializing";
    case EstimatorStatus::kTracking:
      return "tracking";
    default:
      return "lost";
  }
}

// Milliseconds that the stages of one frame took.
struct EstimatorTimings {
  double initialization = 0;
  double line_merging = 0;  // with the search for the Manhattan frame
  double optimization = 0;
  double marginalization = 0;
  double total = 0;
};

// Everything the estimator says about one image. The state is that of this image, as far as it is
// known when the image has been processed.
struct EstimatorOutput {
  int64_t t_ns = 0;
  EstimatorStatus status = EstimatorStatus::kInitializing;
  std::string reason;     // why not tracking, or why restarted; empty otherwise
  bool has_pose = false;  // `state`, covariances, calibration and `imu_noise` are valid
  FrameState state;
  // Covariance of (p_W [m], rotation in B [rad]), right perturbation R_W_B Exp(theta).
  Matrix6d pose_covariance = Matrix6d::Zero();
  Eigen::Matrix3d velocity_covariance = Eigen::Matrix3d::Zero();       // of v_W [m/s]
  Eigen::Matrix3d body_velocity_covariance = Eigen::Matrix3d::Zero();  // of v_B = R_W_B^T v_W
  Matrix6d bias_covariance = Matrix6d::Zero();  // of the accelerometer [m/s^2] and gyro [rad/s]
  Calibration calibration;
  std::optional<Eigen::Quaterniond> R_W_M;  // the Manhattan frame, where the scene has one
  ImuNoise imu_noise;                       // as it counts: configured, or as flight shows it
  double imu_noise_scale = 1;               // of its variance beyond that (ImuMonitor)
  bool imu_doubted = false;                 // in this image, at once
  std::optional<double> delay;              // error of td that shows, roughly [s] (DelayMonitor)
  bool contradicted = false;                // much of what is known is not where it should be
  bool on_imu_alone = false;                // next to nothing that is known holds the pose
  bool keyframe = false;           // the image before this one stays in the window as a keyframe
  bool stationary = false;         // standing still was recognised
  bool restarted = false;          // the world frame is a new one from here on
  bool bridged = false;            // tracks again after a loss, in the same world frame
  std::vector<FrameState> window;  // states of the sliding window, oldest first
  std::vector<MapPoint> points;    // landmarks in the window
  std::vector<MapPoint> departed_points;  // landmarks that left the window with this frame
  std::vector<MapLine> lines;             // the same for lines
  std::vector<MapLine> departed_lines;
  std::vector<int64_t> absorbed_lines;  // ids: others go on with them, departed ones as well
  EstimatorCounts counts;
  EstimatorTimings timings;
};

}  // namespace plm_vins
