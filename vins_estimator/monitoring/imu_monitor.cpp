// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/monitoring/imu_monitor.h"

#include <algorithm>

#include "common/statistics.h"

namespace plm_vins {
namespace {

// Limits of the accumulated excess of chi-square.
constexpr double kNormal = 3.0;  // exceeded by 1 % of images with correct noise
constexpr double kAlarm = 24.0;  // in one image: about the 1 - 1e-4 quantile of chi-square

constexpr int64_t kSettling_ns = 1'000'000'000;  // until the camera has corrected the biases

// Adaptation of the noise scale.
constexpr double kExpected = 1.0;    // its mean is 0.2 ... 0.7 in flights with correct noise
constexpr double kFollowing = 0.1;   // weight of an image: time constant of 0.5 s at 20 Hz
constexpr double kMaxGrowth = 1.5;   // per image, which may be an outlier
constexpr double kMaxScale = 1e4;    // a hundred times the standard deviation
constexpr double kLeastScale = 4.0;  // smaller scales are not significant

// Rotation residuals have one direction if the squared mean exceeds this share of the mean square.
// For noise the ratio is 1/80; errors of timestamps and saturation change sign with the rotation.
constexpr double kForgetting = 0.025;  // per image: 2 s at 20 Hz
constexpr double kOneDirection = 0.5;
constexpr double kMinTurnImages = 20;  // fewer may agree by chance

constexpr int kMinPoints = 20;              // fewer are no evidence
constexpr double kContradictedShare = 0.5;  // a few percent are outliers anyway

// Returns whether the displacement of points is so large that the robust loss rejected them instead
// of the IMU.
bool PointsAreDisplaced(const ImuMonitor::Evidence& evidence) {
  return evidence.points >= kMinPoints &&
         evidence.contradicted > kContradictedShare * evidence.points;
}

}  // namespace

std::optional<double> ImuMonitor::Add(const Evidence& evidence) {
  FollowNoise(evidence.chi_square);
  FollowTurn(evidence.turn_residual);
  excess_ = std::max(0.0, excess_ + evidence.chi_square - kNormal);
  const bool displaced = PointsAreDisplaced(evidence);
  const bool biased = NoiseHasOneDirection();
  if (!displaced && !biased && excess_ <= kAlarm) return std::nullopt;
  excess_ = 0;
  if (doubted_ns_ && evidence.t_ns - *doubted_ns_ < kSettling_ns) return std::nullopt;
  doubted_ns_ = evidence.t_ns;
  const double scale = std::max(noise_scale(), evidence.chi_square / kNormal);
  if (biased) followed_scale_ = 1;
  turns_.setZero();
  squared_turns_ = images_ = 0;
  return displaced ? kMaxScale : scale;
}

double ImuMonitor::noise_scale() const {
  return followed_scale_ < kLeastScale ? 1.0 : followed_scale_;
}

void ImuMonitor::FollowTurn(const Eigen::Vector3d& turn_residual) {
  AddForgetting(kForgetting, turn_residual, &turns_);
  AddForgetting(kForgetting, turn_residual.squaredNorm(), &squared_turns_);
  AddForgetting(kForgetting, 1.0, &images_);
}

bool ImuMonitor::NoiseHasOneDirection() const {
  const bool long_enough = images_ > kMinTurnImages;
  return noise_scale() > 1 && long_enough &&
         turns_.squaredNorm() > kOneDirection * images_ * squared_turns_;
}

// With the correct scale, chi_square has its expected mean.
void ImuMonitor::FollowNoise(double chi_square) {
  const double growth = 1 + kFollowing * (chi_square / kExpected - 1);
  followed_scale_ = std::clamp(followed_scale_ * std::min(growth, kMaxGrowth), 1.0, kMaxScale);
}

}  // namespace plm_vins
