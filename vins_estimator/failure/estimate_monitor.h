// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>

#include "vins_estimator/failure/failure_detector.h"
#include "vins_estimator/state/estimate_counts.h"
#include "vins_estimator/state/frame_state.h"

namespace plm_vins {

// Reason to declare tracking lost.
struct Failure {
  std::string why;
  bool has_drifted = false;  // too uncertain for a FrameBridge to start from
};

// Decides after each image whether the estimate is still valid.
class EstimateMonitor {
 public:
  // Evidence from one image.
  struct Evidence {
    bool solved = false;      // the equations had a solution
    bool stationary = false;  // standstill at the newest image
    FrameState predicted;     // newest state, propagated by the IMU alone
    FrameState newest;        // newest state, optimized
    std::optional<Eigen::Matrix<double, 6, 6>> pose_covariance;  // belongs to `newest`
    int features_observed = 0;  // in the image, even if they are not used
    EstimatorCounts counts;
    double time_offset_change = 0;  // estimated minus configured td [s]
    double longest_imu_gap = 0;     // in the window [s]; a long one explains a failure
  };

  // Returns the reason to declare tracking lost; nullopt if the estimate is valid.
  std::optional<Failure> Add(const Evidence& evidence);

  bool contradicted() const { return contradiction_monitor_.contradicts(); }  // by the camera
  bool blind() const { return blindness_monitor_.blind(); }

 private:
  std::optional<Failure> Judge(const Evidence& evidence);

  ContradictionMonitor contradiction_monitor_;
  BlindnessMonitor blindness_monitor_;
};

}  // namespace plm_vins
