// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "common/rigid3.h"
#include "vins_estimator/map/line_map.h"
#include "vins_estimator/map/point_map.h"
#include "vins_estimator/merging/line_merging.h"
#include "vins_estimator/state/frame_state.h"

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

// Feature counts of one frame.
struct EstimatorCounts {
  int points_observed = 0;   // in this image
  int points_in_window = 0;  // landmarks in the optimisation
  int points_rejected = 0;   // landmarks or observations thrown out in this frame
  int lines_observed = 0;    // in this image
  int lines_in_window = 0;   // landmarks in the optimisation
  int lines_rejected = 0;    // landmarks or observations thrown out in this frame
  LineTriangulationCounts line_triangulation;
  LineMergingCounts line_merging;
};

// Everything the estimator says about one image. The state is that of this image, as known at this
// time.
struct EstimatorOutput {
  int64_t t_ns = 0;
  EstimatorStatus status = EstimatorStatus::kInitializing;
  std::string reason;     // why not tracking, or why restarted; empty otherwise
  bool has_pose = false;  // `state` and covariances are valid
  FrameState state;
  // Covariance of (p_W [m], rotation in B [rad]), right perturbation R_W_B Exp(theta).
  Matrix6d pose_covariance = Matrix6d::Zero();
  Eigen::Matrix3d velocity_covariance = Eigen::Matrix3d::Zero();  // of v_W [m/s]
  Rigid3d T_B_C;
  double td = 0;                            // [s]
  std::optional<Eigen::Quaterniond> R_W_M;  // the Manhattan frame, where the scene has one
  bool keyframe = false;
  bool stationary = false;                // standing still was recognised
  bool restarted = false;                 // the world frame is a new one from here on
  std::vector<FrameState> window;         // states of the sliding window, oldest first
  std::vector<MapPoint> points;           // landmarks in the window
  std::vector<MapPoint> departed_points;  // landmarks that left the window with this frame
  std::vector<MapLine> lines;             // the same for lines
  std::vector<MapLine> departed_lines;
  EstimatorCounts counts;
  EstimatorTimings timings;
};

}  // namespace plm_vins
