// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/monitoring/imu_monitor.h"

#include <algorithm>

#include "vins_estimator/monitoring/forgetting_sum.h"

namespace plm_vins {
namespace {

// Of the excess that is added up.
constexpr double kNormal = 3.0;  // flights with the right noise exceed it once in a hundred images
constexpr double kAlarm = 24.0;  // by one image: beyond the 1 - 1e-4 quantile of chi-square with 6

constexpr int64_t kSettling_ns = 1'000'000'000;  // until the camera has told the new biases

// Of the noise that is followed.
constexpr double kExpected = 1.0;    // its mean is 0.2 ... 0.7 on flights with the right noise
constexpr double kFollowing = 0.1;   // share of an image: half a second at 20 Hz
constexpr double kMaxGrowth = 1.5;   // by one image, which may be an outlier
constexpr double kMaxScale = 1e4;    // a hundred times the deviation
constexpr double kLeastScale = 4.0;  // less is chance

// Of the turns: their mean square is of the square of their mean by this share. Of noise it is an
// eightieth; what errors of stamps and saturation make goes to and fro with the turns.
constexpr double kForgetting = 0.025;  // per image: two seconds at 20 Hz
constexpr double kOneDirection = 0.5;
constexpr double kMinTurnImages = 20;  // fewer may have one direction by chance

constexpr int kMinPoints = 20;              // fewer are no evidence
constexpr double kContradictedShare = 0.5;  // outliers are a few per cent

// Too far for the robust loss: the optimisation gave them up instead of the IMU.
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

// A scale that is right leaves chi_square as expected.
void ImuMonitor::FollowNoise(double chi_square) {
  const double growth = 1 + kFollowing * (chi_square / kExpected - 1);
  followed_scale_ = std::clamp(followed_scale_ * std::min(growth, kMaxGrowth), 1.0, kMaxScale);
}

}  // namespace plm_vins
