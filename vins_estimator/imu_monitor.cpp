// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/imu_monitor.h"

#include <algorithm>

#include "common/measurements.h"

namespace plm_vins {
namespace {

// Of chi_square, whose mean is 0.2 ... 0.7 on flights with the right noise.
constexpr double kNormal = 3.0;

// Of the added excess: beyond the quantile of 1 - 1e-4 of six degrees of freedom, 28, in one image.
constexpr double kAlarm = 24.0;

constexpr int64_t kSettling_ns = 1'000'000'000;  // until the camera has told the new biases

constexpr double kFollowing = 0.1;   // share of an image in the noise: half a second at 20 Hz
constexpr double kMaxGrowth = 4.0;   // by one image
constexpr double kMaxScale = 1e4;    // a hundred times the deviation
constexpr double kLeastScale = 2.0;  // less is chance

constexpr int kMinPoints = 20;              // fewer are no evidence
constexpr double kContradictedShare = 0.5;  // outliers are a few per cent
constexpr double kContradictedScale = kMaxScale;

}  // namespace

bool ImuMonitor::Add(const Evidence& evidence) {
  FollowNoise(evidence.chi_square);
  excess_ = std::max(0.0, excess_ + evidence.chi_square - kNormal);
  if (!Contradicts(evidence)) return false;
  excess_ = 0;
  if (doubted_ns_ && evidence.t_ns - *doubted_ns_ < kSettling_ns) return false;
  doubted_ns_ = evidence.t_ns;
  return true;
}

double ImuMonitor::noise_scale() const {
  return followed_scale_ < kLeastScale ? 1.0 : followed_scale_;
}

// A scale that is right leaves chi_square normal.
void ImuMonitor::FollowNoise(double chi_square) {
  const double growth = 1 + kFollowing * (chi_square / kNormal - 1);
  followed_scale_ = std::clamp(followed_scale_ * std::min(growth, kMaxGrowth), 1.0, kMaxScale);
}

bool ImuMonitor::Contradicts(const Evidence& evidence) {
  return excess_ > kAlarm || (evidence.points >= kMinPoints &&
                              evidence.contradicted > kContradictedShare * evidence.points);
}

}  // namespace plm_vins
