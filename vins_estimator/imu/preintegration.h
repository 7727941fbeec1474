// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <vector>

#include "common/imu/imu_noise.h"
#include "common/imu/imu_samples.h"
#include "common/measurements.h"
#include "vins_estimator/state/frame_state.h"

namespace plm_vins {

using Matrix15d = Eigen::Matrix<double, 15, 15>;
using Vector15d = Eigen::Matrix<double, 15, 1>;

// Rows of the 15-dimensional error state between two frames.
struct ImuErrorIndex {
  static constexpr int kPosition = 0, kRotation = 3, kVelocity = 6, kAccelBias = 9, kGyroBias = 12;
};

// Standard deviations of a bias step, in addition to its random walk.
struct BiasStep {
  double gyro = 0;   // [rad/s]
  double accel = 0;  // [m/s^2]
};

// Effect of timestamp errors of one standard deviation on the states at both ends of an interval;
// rows as in ImuErrorIndex, position and velocity in the body frame at the start.
struct StampErrors {
  Vector15d at_start = Vector15d::Zero(), at_end = Vector15d::Zero();
};

// Preintegrated IMU measurement between two images, independent of the state (midpoint rule).
// [Forster2017], [Qin2018] section IV.B. A gap in the samples (over 50 ms) is integrated the same
// way, with noise increased for the vehicle's unknown motion in it. Rotation errors are
// perturbations on the right. All deltas are in the body frame B0 at the start:
//   delta_p  position change without gravity and start velocity [m]
//   delta_q  R_B0_B1
//   delta_v  velocity change without gravity [m/s]
class Preintegration {
 public:
  Preintegration(const ImuNoise& noise, const ImuBias& linearization_bias);

  // Appends a sample. The first one only sets the start; each further one integrates the interval
  // that it ends. Throws std::invalid_argument unless time strictly increases.
  void Append(const ImuSample& sample);

  // Appends the interval that follows this one. The covariance keeps the noise of each part until
  // it is integrated again; noise() becomes the greater one. The greater bias step applies to both.
  void Join(const Preintegration& next);

  // Re-integrates the samples with another linearization bias.
  void Repropagate(const ImuBias& linearization_bias);

  // Re-integrates the samples with another noise.
  void Reweigh(const ImuNoise& noise);

  // Allows the biases to step at the start of the interval, with these standard deviations.
  void AllowBiasStep(const BiasStep& step);

  // Allows timestamp errors of the states at both ends.
  void AllowStampErrors(const StampErrors& errors);

  // Deltas, corrected to first order for the change of bias.
  Eigen::Vector3d DeltaP(const ImuBias& bias) const;
  Eigen::Quaterniond DeltaQ(const ImuBias& bias) const;
  Eigen::Vector3d DeltaV(const ImuBias& bias) const;

  // Returns the state at the end of the interval, given that at its start. `gravity_W` is (0, 0,
  // -g).
  FrameState Predict(const FrameState& start, const Eigen::Vector3d& gravity_W) const;

  bool HasGap() const { return LeaveGap(samples_); }  // more than 50 ms between samples
  bool HasOneNoise() const { return one_noise_; }     // within 10 %, in all joined parts
  bool HasBiasStep() const { return bias_step_.gyro != 0 || bias_step_.accel != 0; }
  double duration() const { return duration_; }  // [s]
  const std::vector<ImuSample>& samples() const { return samples_; }
  const ImuBias& linearization_bias() const { return bias_; }
  const ImuNoise& noise() const { return noise_; }
  const BiasStep& bias_step() const { return bias_step_; }
  const Eigen::Vector3d& delta_p() const { return delta_p_; }
  const Eigen::Quaterniond& delta_q() const { return delta_q_; }
  const Eigen::Vector3d& delta_v() const { return delta_v_; }
  // d(error state at the end)/d(error state at the start), rows and columns as in ImuErrorIndex.
  const Matrix15d& jacobian() const { return jacobian_; }
  Matrix15d Covariance() const;
  // Upper triangular U with U^T U = covariance^-1. Computed and cached by the first call, which
  // must therefore not run in several threads. Throws std::logic_error if no interval is integrated
  // yet.
  const Matrix15d& SqrtInformation() const;

 private:
  void IntegrateInterval(const ImuSample& begin, const ImuSample& end);
  void Restart();

  ImuNoise noise_;
  bool one_noise_ = true;
  ImuBias bias_;
  BiasStep bias_step_;
  StampErrors stamp_errors_;
  std::vector<ImuSample> samples_;
  double duration_ = 0;
  Eigen::Vector3d delta_p_ = Eigen::Vector3d::Zero();
  Eigen::Quaterniond delta_q_ = Eigen::Quaterniond::Identity();
  Eigen::Vector3d delta_v_ = Eigen::Vector3d::Zero();
  Matrix15d jacobian_ = Matrix15d::Identity();
  Matrix15d covariance_ = Matrix15d::Zero();  // excludes bias steps and timestamp errors
  mutable Matrix15d sqrt_information_ = Matrix15d::Zero();
  mutable bool sqrt_information_valid_ = false;
};

}  // namespace plm_vins
