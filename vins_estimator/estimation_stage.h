// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "common/config/config.h"
#include "common/finding.h"
#include "common/measurements.h"
#include "common/streams/drop_counts.h"
#include "vins_estimator/input/feature_door.h"
#include "vins_estimator/input/input_check.h"
#include "vins_estimator/input/measurement_sync.h"
#include "vins_estimator/state/estimator_output.h"

namespace plm_vins {

class Estimator;
class StatedLengths;

// The estimate of an image, with the other data to publish.
struct EstimatedFrame {
  EstimatorOutput output;
  PointFrame points;           // used for the estimate
  LineFrame lines;             // used for the estimate; empty if there were none
  std::vector<ImuSample> imu;  // since the previous frame, starting with its last sample
  int64_t imu_ns = 0;          // time of the state on the IMU's clock
  Eigen::Vector3d angular_velocity = Eigen::Vector3d::Zero();  // in B, without bias [rad/s]
  // Variance of each component due to the noise of one gyroscope sample [rad^2/s^2].
  double angular_velocity_variance = 0;
};

// The back end as used by the node and the offline runner: synchronizes features with IMU samples
// and passes them to the estimator. Synchronous; add input in order of arrival, then call Pop()
// until it returns nullopt.
class EstimationStage {
 public:
  // Images that wait longer than `max_wait` [s] are dropped (MeasurementSync::Options).
  explicit EstimationStage(const Config& config,
                           double max_wait = std::numeric_limits<double>::infinity());
  ~EstimationStage();

  void AddImu(const ImuSample& sample);
  void AddPoints(PointFrame frame);
  void AddLines(LineFrame frame);

  // Returns the estimate of the next image; nullopt if none is ready.
  std::optional<EstimatedFrame> Pop() { return Process(sync_.Pop()); }

  // To be called instead of Pop() after the end of the input.
  std::optional<EstimatedFrame> Flush() { return Process(sync_.Flush()); }

  // Ignores from the start the lengths that another run over the same input found wrong.
  void LearnFrom(const EstimationStage& earlier);

  // Returns whether a stated length was found wrong in this run, so that the poses before were
  // estimated with it.
  bool has_found_wrong_length() const { return has_found_wrong_length_; }

  // Reinitializes: drops queued data and the state, keeps the statistics. `reason` is reported with
  // the next output, which announces the new world frame.
  void Reset(const std::string& reason);

  // Describes the problem if the IMU rate is too low to be integrated, if the camera persistently
  // contradicts the IMU, or if the estimated IMU noise is at its limit; with possible causes in the
  // timestamps. Empty if there is no such problem.
  std::string ImuContradiction() const;

  // Describes a distortion model that does not fit the lens of a camera; empty if all fit
  // (LensMonitor).
  std::string LensWarning() const;
  std::vector<ResidualRing> ResidualRings() const;  // of camera 0
  // Returns what is wrong with the input as a whole, or was since the last restart.
  const Finding& InputFinding() const;

  // Describes what is wrong with cameras other than the first (calibration, time of exposure,
  // length of the baseline) and with measured depths. Empty if nothing is.
  std::string SensorFaults() const;

  int64_t frames() const { return frames_; }  // images estimated so far
  int64_t resets() const { return resets_; }  // number of abandoned world frames
  size_t queued_frames() const { return sync_.queued_frames(); }
  bool lines_are_missing() const { return sync_.lines_are_missing(); }
  bool lines_are_of_other_images() const { return sync_.lines_are_of_other_images(); }
  SyncStatistics statistics() const { return sync_.statistics(); }
  DropCounts Drops() const;  // unusable inputs by cause

 private:
  // All state that does not outlive a restart, besides that of the estimator.
  struct PerWorld;

  std::optional<EstimatedFrame> Process(std::optional<FrameMeasurement> measurement);
  // Looks for what is wrong with the input, at every tenth call only.
  void CheckInput(int64_t t_ns);
  RankedFinding FindInputFault() const;
  RankedFinding FindRotationFault() const;
  void StartOver(const std::string& reason);
  // Repeats the estimate from the stored images without the lengths that are wrong.
  void RepeatWithoutWrongLengths();
  // Returns the noise densities of the newest estimate; the configured ones before the start.
  const ImuNoise& EstimatedNoise() const;
  // Returns the ratio of the estimated noise to the configured one, or to that which the samples
  // show if it is greater.
  double NoiseFactor() const;
  // Searches for the cause (RotationCheck) if the estimate stays in doubt.
  void CheckRotations(const FrameMeasurement& measurement, const EstimatorOutput& output);

  const Config config_;
  std::unique_ptr<Estimator> estimator_;  // hides the solver from users of this header
  std::unique_ptr<StatedLengths> lengths_;
  FeatureDoor door_;
  InputCheck input_check_;
  MeasurementSync sync_;
  std::unique_ptr<PerWorld> world_;
  int64_t inputs_ = 0;  // IMU samples and images
  int64_t frames_ = 0;
  int64_t frames_repeated_ = 0;  // repeated images, whose features were ignored
  int64_t resets_ = 0;
  bool has_found_wrong_length_ = false;
  bool reinitializing_ = true;                 // no image since the start or the last reset
  std::optional<std::string> restart_reason_;  // for the next output
};

}  // namespace plm_vins
