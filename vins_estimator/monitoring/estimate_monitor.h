// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>

#include "vins_estimator/monitoring/blindness_monitor.h"
#include "vins_estimator/monitoring/failure_detector.h"
#include "vins_estimator/state/estimate_counts.h"
#include "vins_estimator/state/frame_state.h"

namespace plm_vins {

// Why an estimate cannot be kept.
struct Failure {
  std::string why;
  bool has_drifted = false;  // further on the IMU alone than a bridge may lead on from
};

// Whether an estimate can be kept, image after image.
class EstimateMonitor {
 public:
  // What an image says of the estimate.
  struct Evidence {
    bool solved = false;                          // the equations had a solution
    FrameState predicted;                         // the newest state, from the IMU alone
    FrameState newest;                            // the same, solved for
    Eigen::Matrix<double, 6, 6> pose_covariance;  // of that; zero where it is not known
    EstimatorCounts counts;
    double time_offset_change = 0;  // td as estimated, from what is configured [s]
  };

  // Why the estimate cannot be kept; nothing where it can.
  std::optional<Failure> Add(const Evidence& evidence);

  bool contradicted() const { return contradiction_monitor_.contradicts(); }  // by the camera
  bool blind() const { return blindness_monitor_.blind(); }

 private:
  ContradictionMonitor contradiction_monitor_;
  BlindnessMonitor blindness_monitor_;
};

}  // namespace plm_vins
