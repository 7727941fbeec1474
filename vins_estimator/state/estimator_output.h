// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "common/camera/camera_model.h"
#include "common/geometry/rigid3.h"
#include "common/imu/imu_noise.h"
#include "vins_estimator/state/estimate_counts.h"
#include "vins_estimator/state/frame_state.h"
#include "vins_estimator/state/map_elements.h"

namespace plm_vins {

// Intrinsics and extrinsics of a camera.
struct CameraCalibration {
  CameraParameters parameters;
  Rigid3d T_B_C;
};

// Calibration that the estimator may refine: cameras by number, at least one, and time offset.
struct Calibration {
  std::vector<CameraCalibration> cameras{CameraCalibration()};
  double td = 0;  // t_imu = t_image + td [s]
};

// Statistics of the residuals of points in a ring of the image around the principal point.
struct ResidualRing {
  double inner_px = 0, outer_px = 0;  // radii
  int64_t count = 0;                  // number of residuals
  double radial_px = 0;               // median of the radial components, positive outwards
  double deviation_px = 0;            // standard deviation of these, from the quartiles
};

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

// Standard deviations from which an error is certain enough to be reported.
constexpr double kMinSignificance = 5.0;

// Error of a stated length by the evidence of motion and IMU, and its standard deviation; both
// logarithmic, so relative.
struct LengthEvidence {
  double error = 0;
  double deviation = 0;

  // Returns whether an error is too large and too certain to be left unreported.
  bool IsSignificant() const { return std::abs(error) > kMinSignificance * deviation; }
};

// Faults of a camera other than the first that its residuals show.
struct CameraFaults {
  int camera = 0;
  std::optional<double> misfit_px;  // median residual, if it is too large for the camera to be used
  std::optional<double> delay;      // exposure later than that of the first camera [s]
  std::optional<LengthEvidence> baseline;  // to an overlapping camera
};

// Distance in the image by which depth images are not aligned to the camera, at its axis or half a
// focal length beside it, and its standard deviation [px].
struct Misalignment {
  double distance_px = 0;
  double deviation_px = 0;
};

// Faults of measured depths that motion and IMU show.
struct DepthFaults {
  std::optional<LengthEvidence> scale;
  std::optional<double> delay;  // by which they are older than their timestamps [s]
  std::optional<Misalignment> misalignment;
};

// Processing time of the stages of one frame [ms].
struct EstimatorTimings {
  double initialization = 0;
  double line_merging = 0;  // includes the search for the Manhattan frame
  double optimization = 0;
  double marginalization = 0;
  double total = 0;
};

// Covariances of a state.
struct StateUncertainty {
  // Covariance of (p_W [m], rotation in B [rad]), right perturbation R_W_B Exp(theta).
  Matrix6d pose;
  Eigen::Matrix3d velocity;       // covariance of v_W [m/s]
  Eigen::Matrix3d body_velocity;  // covariance of v_B = R_W_B^T v_W [m/s]
  Matrix6d biases;                // accelerometer [m/s^2], gyroscope [rad/s]
};

// The part of the output that reports and warnings are made of.
struct EstimatorReport {
  int64_t t_ns = 0;
  EstimatorStatus status = EstimatorStatus::kInitializing;
  std::string reason;                 // why not tracking, or why reinitialized; else empty
  bool has_pose = false;              // state, calibration and `imu_noise` are valid
  ImuNoise imu_noise;                 // in use: as configured, or as estimated in flight
  double imu_noise_scale = 1;         // factor on its variance (ImuMonitor)
  bool imu_doubted = false;           // the newest IMU interval was re-weighted
  std::vector<CameraFaults> cameras;  // all but the first
  DepthFaults depth;
  bool contradicted = false;  // many known landmarks are outliers
  bool on_imu_alone = false;  // too few features to constrain the pose
  bool keyframe = false;      // the previous image becomes a keyframe of the window
  bool stationary = false;    // standstill detected
  bool restarted = false;     // poses are in a new world frame from here on
  bool bridged = false;       // tracking again after a loss, in the same world frame
  EstimatorCounts counts;
  EstimatorTimings timings;
};

// Output of the estimator for one image. The state is the estimate at that image right after it was
// processed.
struct EstimatorOutput : EstimatorReport {
  FrameState state;
  std::optional<StateUncertainty> uncertainty;  // nullopt if the equations are rank deficient
  Calibration calibration;
  std::optional<Eigen::Quaterniond> R_W_M;  // Manhattan frame; nullopt if not found
  std::vector<FrameState> window;           // states of the window, oldest first
  std::vector<MapPoint> points;             // landmarks in the window
  std::vector<MapPoint> departed_points;    // landmarks that left the window with this frame
  std::vector<MapLine> lines;               // lines in the window
  std::vector<MapLine> departed_lines;
  std::vector<int64_t> absorbed_lines;  // ids of lines that were merged into others
};

}  // namespace plm_vins
