// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/imu/preintegration.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "common/geometry/small_cholesky.h"
#include "common/geometry/so3.h"
#include "common/imu/imu_samples.h"

namespace plm_vins {
namespace {

using Index = ImuErrorIndex;

// Random walks of angular rate and specific force that model the unknown motion in a gap. Errors
// when bridging 0.2 s of the EuRoC flights correspond to walks of 0.2 ... 0.7 and 1 ... 10.
constexpr double kRateWalk = 1.0;   // [rad/s/sqrt(s)]
constexpr double kForceWalk = 5.0;  // [m/s^2/sqrt(s)]

// Returns the squared density of white noise equivalent to sensor noise `density` over an interval.
// In a gap, the integral of a random walk pinned at both ends is added; its variance is walk^2 dt^3
// / 12.
double EffectiveDensitySquared(double density, double walk, double dt) {
  const double sensor = density * density;
  return dt <= kMaxImuInterval ? sensor : sensor + walk * walk * dt * dt / 12.0;
}

// Returns the squared density equivalent to the doubt about the readings at both ends. A reading
// counts by half in each of its two intervals, with the same error; as variances of intervals add
// up, each interval has half of the whole.
double DoubtSquared(double begin, double end, double dt) {
  return (begin * begin + end * end) / 2 * dt;
}

// Linearized error propagation over one interval: the blocks of F in error' = F error that are
// neither zero nor identity. The rows of position follow from those of velocity: dp' = dp + dt dv +
// dt/2 (dv' - dv).
struct Transition {
  double dt;
  Eigen::Matrix3d rotation_rotation, rotation_gyro;
  Eigen::Matrix3d velocity_rotation, velocity_accel, velocity_gyro;

  // Computes m <- F m.
  void Apply(Matrix15d* m) const {
    const Eigen::Matrix<double, 3, 15> velocity_change =
        velocity_rotation * m->middleRows<3>(Index::kRotation) +
        velocity_accel * m->middleRows<3>(Index::kAccelBias) +
        velocity_gyro * m->middleRows<3>(Index::kGyroBias);
    const Eigen::Matrix<double, 3, 15> rotation =
        rotation_rotation * m->middleRows<3>(Index::kRotation) +
        rotation_gyro * m->middleRows<3>(Index::kGyroBias);
    m->middleRows<3>(Index::kPosition) +=
        dt * m->middleRows<3>(Index::kVelocity) + 0.5 * dt * velocity_change;
    m->middleRows<3>(Index::kRotation) = rotation;
    m->middleRows<3>(Index::kVelocity) += velocity_change;
  }

  // Computes covariance <- F covariance F^T, applying F to the rows, then to the columns.
  void Propagate(Matrix15d* covariance) const {
    Apply(covariance);
    covariance->transposeInPlace();
    Apply(covariance);
  }
};

// Adds the covariance of white noise on rate, force and bias derivatives over one interval.
// Gyroscope noise acts like a gyroscope bias of that interval; force noise is doubly integrated
// exactly, so that a single interval already gives full rank.
void AddNoise(const ImuNoise& noise, const ImuSample& begin, const ImuSample& end,
              const Transition& transition, Matrix15d* covariance) {
  const double dt = transition.dt;
  const Eigen::Matrix3d I = Eigen::Matrix3d::Identity();
  Eigen::Matrix<double, 9, 3> d_gyro;
  d_gyro << 0.5 * dt * transition.velocity_gyro, transition.rotation_gyro, transition.velocity_gyro;
  const double gyro = EffectiveDensitySquared(noise.gyro_density, kRateWalk, dt) +
                      DoubtSquared(begin.gyro_doubt, end.gyro_doubt, dt);
  covariance->topLeftCorner<9, 9>() += gyro / dt * d_gyro * d_gyro.transpose();

  const double accel = EffectiveDensitySquared(noise.accel_density, kForceWalk, dt) +
                       DoubtSquared(begin.accel_doubt, end.accel_doubt, dt);
  const auto block = [covariance](int row, int column) {
    return covariance->block<3, 3>(row, column);
  };
  block(Index::kPosition, Index::kPosition) += accel * dt * dt * dt / 3.0 * I;
  block(Index::kPosition, Index::kVelocity) += accel * dt * dt / 2.0 * I;
  block(Index::kVelocity, Index::kPosition) += accel * dt * dt / 2.0 * I;
  block(Index::kVelocity, Index::kVelocity) += accel * dt * I;
  block(Index::kAccelBias, Index::kAccelBias) += noise.accel_walk * noise.accel_walk * dt * I;
  block(Index::kGyroBias, Index::kGyroBias) += noise.gyro_walk * noise.gyro_walk * dt * I;
}

}  // namespace

Preintegration::Preintegration(const ImuNoise& noise, const ImuBias& linearization_bias)
    : noise_(noise), bias_(linearization_bias) {}

void Preintegration::Append(const ImuSample& sample) {
  if (!samples_.empty()) {
    if (sample.t_ns <= samples_.back().t_ns) {
      throw std::invalid_argument("Preintegration: IMU stamp " + std::to_string(sample.t_ns) +
                                  " ns is not after " + std::to_string(samples_.back().t_ns) +
                                  " ns; filter the stream before integrating");
    }
    IntegrateInterval(samples_.back(), sample);
  }
  samples_.push_back(sample);
}

void Preintegration::Join(const Preintegration& next) {
  one_noise_ = one_noise_ && next.one_noise_ && !AreFarNoisier(noise_, next.noise_) &&
               !AreFarNoisier(next.noise_, noise_);
  const ImuNoise greater = Greater(noise_, next.noise_);
  noise_ = next.noise_;
  bias_step_ = {std::max(bias_step_.gyro, next.bias_step_.gyro),
                std::max(bias_step_.accel, next.bias_step_.accel)};
  stamp_errors_.at_end = next.stamp_errors_.at_end;
  for (const int row : {Index::kPosition, Index::kVelocity}) {
    stamp_errors_.at_end.segment<3>(row) = delta_q_ * next.stamp_errors_.at_end.segment<3>(row);
  }
  for (const ImuSample& sample : next.samples_) {
    if (sample.t_ns > samples_.back().t_ns) Append(sample);
  }
  noise_ = greater;
}

void Preintegration::Repropagate(const ImuBias& linearization_bias) {
  bias_ = linearization_bias;
  one_noise_ = true;
  Restart();
  for (size_t i = 1; i < samples_.size(); ++i) IntegrateInterval(samples_[i - 1], samples_[i]);
}

void Preintegration::Reweigh(const ImuNoise& noise) {
  noise_ = noise;
  Repropagate(bias_);
}

void Preintegration::AllowBiasStep(const BiasStep& step) {
  bias_step_ = step;
  sqrt_information_valid_ = false;
}

void Preintegration::AllowStampErrors(const StampErrors& errors) {
  stamp_errors_ = errors;
  sqrt_information_valid_ = false;
}

// A bias step at the start of the interval propagates like an error of the initial state.
Matrix15d Preintegration::Covariance() const {
  Matrix15d covariance = covariance_;
  if (HasBiasStep()) {
    const Eigen::Matrix<double, 15, 3> accel = jacobian_.middleCols<3>(Index::kAccelBias);
    const Eigen::Matrix<double, 15, 3> gyro = jacobian_.middleCols<3>(Index::kGyroBias);
    covariance += bias_step_.accel * bias_step_.accel * accel * accel.transpose() +
                  bias_step_.gyro * bias_step_.gyro * gyro * gyro.transpose();
  }
  const Vector15d start = jacobian_ * stamp_errors_.at_start, &end = stamp_errors_.at_end;
  if (!start.isZero(0) || !end.isZero(0)) {
    covariance += start * start.transpose() + end * end.transpose();
  }
  return covariance;
}

void Preintegration::Restart() {
  duration_ = 0;
  delta_p_.setZero();
  delta_q_.setIdentity();
  delta_v_.setZero();
  jacobian_.setIdentity();
  covariance_.setZero();
  sqrt_information_valid_ = false;
}

void Preintegration::IntegrateInterval(const ImuSample& begin, const ImuSample& end) {
  const double dt = ToSeconds(end.t_ns - begin.t_ns);
  const Eigen::Vector3d angle = (0.5 * (begin.gyro + end.gyro) - bias_.gyro) * dt;
  const Eigen::Quaterniond rotation_step = SO3Exp(angle);
  const Eigen::Quaterniond q_end = (delta_q_ * rotation_step).normalized();
  const Eigen::Matrix3d R_begin = delta_q_.toRotationMatrix();
  const Eigen::Matrix3d R_end = q_end.toRotationMatrix();
  const Eigen::Vector3d accel_begin = begin.accel - bias_.accel;
  const Eigen::Vector3d accel_end = end.accel - bias_.accel;
  const Eigen::Vector3d accel = 0.5 * (R_begin * accel_begin + R_end * accel_end);

  Transition transition;
  transition.dt = dt;
  transition.rotation_rotation = rotation_step.conjugate().toRotationMatrix();
  transition.rotation_gyro = -SO3RightJacobian(angle) * dt;
  const Eigen::Matrix3d d_velocity_d_end_rotation = -0.5 * dt * R_end * Skew(accel_end);
  transition.velocity_rotation = d_velocity_d_end_rotation * transition.rotation_rotation -
                                 0.5 * dt * R_begin * Skew(accel_begin);
  transition.velocity_gyro = d_velocity_d_end_rotation * transition.rotation_gyro;
  transition.velocity_accel = -0.5 * dt * (R_begin + R_end);
  transition.Apply(&jacobian_);
  transition.Propagate(&covariance_);
  AddNoise(noise_, begin, end, transition, &covariance_);

  delta_p_ += delta_v_ * dt + 0.5 * accel * dt * dt;
  delta_v_ += accel * dt;
  delta_q_ = q_end;
  duration_ += dt;
  sqrt_information_valid_ = false;
}

Eigen::Vector3d Preintegration::DeltaP(const ImuBias& bias) const {
  return delta_p_ +
         jacobian_.block<3, 3>(Index::kPosition, Index::kAccelBias) * (bias.accel - bias_.accel) +
         jacobian_.block<3, 3>(Index::kPosition, Index::kGyroBias) * (bias.gyro - bias_.gyro);
}

Eigen::Quaterniond Preintegration::DeltaQ(const ImuBias& bias) const {
  return delta_q_ * SO3Exp(jacobian_.block<3, 3>(Index::kRotation, Index::kGyroBias) *
                           (bias.gyro - bias_.gyro));
}

Eigen::Vector3d Preintegration::DeltaV(const ImuBias& bias) const {
  return delta_v_ +
         jacobian_.block<3, 3>(Index::kVelocity, Index::kAccelBias) * (bias.accel - bias_.accel) +
         jacobian_.block<3, 3>(Index::kVelocity, Index::kGyroBias) * (bias.gyro - bias_.gyro);
}

FrameState Preintegration::Predict(const FrameState& start,
                                   const Eigen::Vector3d& gravity_W) const {
  const double T = duration_;
  const ImuBias bias = start.bias();
  FrameState end = start;
  if (!samples_.empty()) end.t_ns += samples_.back().t_ns - samples_.front().t_ns;
  end.position() = start.position() + start.velocity() * T + 0.5 * gravity_W * T * T +
                   start.rotation() * DeltaP(bias);
  end.rotation() = (start.rotation() * DeltaQ(bias)).normalized();
  end.velocity() = start.velocity() + gravity_W * T + start.rotation() * DeltaV(bias);
  return end;
}

const Matrix15d& Preintegration::SqrtInformation() const {
  if (sqrt_information_valid_) return sqrt_information_;
  // Cholesky from the last row upwards: covariance = V V^T with V upper triangular, hence U = V^-1.
  Matrix15d lower = Covariance().reverse();
  if (!FactorizeCholesky(&lower)) {
    throw std::logic_error(
        "Preintegration: covariance is singular (no interval yet, or a noise density is zero)");
  }
  const Matrix15d upper = lower.reverse();
  sqrt_information_ = upper.triangularView<Eigen::Upper>().solve(Matrix15d::Identity());
  sqrt_information_valid_ = true;
  return sqrt_information_;
}

}  // namespace plm_vins
