// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/rotation_calibration/stamp_lag.h"

#include <algorithm>
#include <cmath>

#include "common/geometry/so3.h"

namespace plm_vins {
namespace {

constexpr int64_t kStep_ns = 20'000'000;  // between lags
constexpr double kTellingTurn = 0.03;     // of a rotation that tells lags apart [rad]
constexpr double kGyroBiasTurn = 0.01;    // what the bias of the gyroscope leaves [rad]
constexpr double kMaxCost = 9;            // of one rotation, so that outliers do not decide
constexpr int kMinRotations = 12;
constexpr int kLeastLag = 3;  // smaller ones are RotationFit's [lags]
constexpr int kApart = 5;     // lags that differ by more are other explanations
constexpr double kWorse = 3;  // least cost of other lags, as a multiple of that of the best one

}  // namespace

void StampLag::AddImu(const std::vector<ImuSample>& imu) {
  if (attitudes_.empty() && !imu.empty()) {
    attitudes_.push_back({imu.front().t_ns, Eigen::Quaterniond::Identity()});
  }
  for (size_t i = 1; i < imu.size(); ++i) {
    if (imu[i].t_ns <= attitudes_.back().t_ns) continue;
    const double dt = ToSeconds(imu[i].t_ns - attitudes_.back().t_ns);
    const Eigen::Vector3d turn = 0.5 * dt * (imu[i - 1].gyro + imu[i].gyro);
    attitudes_.push_back({imu[i].t_ns, (attitudes_.back().R_G_B * SO3Exp(turn)).normalized()});
  }
  const int64_t reach_ns = kHalf * kStep_ns;
  while (!waiting_.empty() && waiting_.front().now_ns + reach_ns <= attitudes_.back().t_ns) {
    Compare(waiting_.front());
    waiting_.pop_front();
  }
  constexpr double kKept = 3;  // more than the largest lag on both sides of a rotation [s]
  while (!attitudes_.empty() &&
         ToSeconds(attitudes_.back().t_ns - attitudes_.front().t_ns) > kKept) {
    attitudes_.pop_front();
  }
}

void StampLag::AddRotation(int64_t then_ns, int64_t now_ns, const Eigen::Quaterniond& R_then_now,
                           double deviation) {
  if (Eigen::AngleAxisd(R_then_now).angle() < kTellingTurn) return;
  waiting_.push_back({then_ns, now_ns, R_then_now, std::hypot(deviation, kGyroBiasTurn)});
}

void StampLag::Clear() {
  attitudes_.clear();
  waiting_.clear();
  costs_ = {};
  compared_ = 0;
}

Eigen::Quaterniond StampLag::AttitudeAt(int64_t t_ns) const {
  const auto after =
      std::lower_bound(attitudes_.begin(), attitudes_.end(), t_ns,
                       [](const Attitude& attitude, int64_t t) { return attitude.t_ns < t; });
  if (after == attitudes_.begin()) return after->R_G_B;
  const Attitude& before = *(after - 1);
  const double share =
      static_cast<double>(t_ns - before.t_ns) / static_cast<double>(after->t_ns - before.t_ns);
  return before.R_G_B.slerp(share, after->R_G_B);
}

void StampLag::Compare(const CameraRotation& rotation) {
  const int64_t reach_ns = kHalf * kStep_ns;
  if (rotation.then_ns - reach_ns < attitudes_.front().t_ns) return;
  for (int i = 0; i < kLags; ++i) {
    const int64_t lag_ns = (i - kHalf) * kStep_ns;
    const Eigen::Quaterniond R_B0_B1 =
        AttitudeAt(rotation.then_ns + lag_ns).conjugate() * AttitudeAt(rotation.now_ns + lag_ns);
    const double error =
        (R_B_C_.conjugate() * R_B0_B1 * R_B_C_).angularDistance(rotation.R_then_now);
    costs_[i] += std::min(kMaxCost, std::pow(error / rotation.deviation, 2));
  }
  ++compared_;
}

std::optional<double> StampLag::lag() const {
  if (compared_ < kMinRotations) return std::nullopt;
  const int best =
      static_cast<int>(std::min_element(costs_.begin(), costs_.end()) - costs_.begin());
  const double misfit = costs_[best] / compared_;
  if (std::abs(best - kHalf) < kLeastLag) return std::nullopt;
  for (int i = 0; i < kLags; ++i) {
    const bool is_other = std::abs(i - best) > kApart;
    if (is_other && costs_[i] < kWorse * std::max(misfit, 1.0) * compared_) return std::nullopt;
  }
  if (costs_[kHalf] < kWorse * std::max(misfit, 1.0) * compared_) return std::nullopt;
  return 1e-9 * static_cast<double>((best - kHalf) * kStep_ns);
}

}  // namespace plm_vins
