// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/imu_monitor.h"

#include <algorithm>

#include "common/measurements.h"

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
  excess_ = std::max(0.0, excess_ + evidence.chi_square - kNormal);
  const bool displaced = PointsAreDisplaced(evidence);
  if (!displaced && excess_ <= kAlarm) return std::nullopt;
  excess_ = 0;
  if (doubted_ns_ && evidence.t_ns - *doubted_ns_ < kSettling_ns) return std::nullopt;
  doubted_ns_ = evidence.t_ns;
  return displaced ? kMaxScale : std::max(noise_scale(), evidence.chi_square / kNormal);
}

double ImuMonitor::noise_scale() const {
  return followed_scale_ < kLeastScale ? 1.0 : followed_scale_;
}

// A scale that is right leaves chi_square as expected.
void ImuMonitor::FollowNoise(double chi_square) {
  const double growth = 1 + kFollowing * (chi_square / kExpected - 1);
  followed_scale_ = std::clamp(followed_scale_ * std::min(growth, kMaxGrowth), 1.0, kMaxScale);
}

}  // namespace plm_vins
