// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/imu/unseen_motion.h"

#include <algorithm>

namespace plm_vins {
namespace {

constexpr double kReference = 3;            // [s]
constexpr double kFelt = 0.2, kEnds = 0.1;  // [m/s]
constexpr double kLongestAcceleration = 6;  // [s]

}  // namespace

// Until the motion is felt, the reference follows the readings, so that the velocity is forgotten.
void UnseenMotion::Add(const std::vector<ImuSample>& imu, bool is_standstill) {
  if (rest_ == 0 && !is_standstill) return;
  if (rest_ == 0) accel_ = imu.back().accel;
  for (size_t i = 1; i < imu.size(); ++i) {
    const double dt = ToSeconds(imu[i].t_ns - imu[i - 1].t_ns);
    const Eigen::Vector3d change = 0.5 * (imu[i - 1].accel + imu[i].accel) - accel_;
    velocity_ += dt * change;
    position_ += dt * velocity_;
    if (is_felt_ || dt <= 0) continue;
    rest_ = std::min(rest_ + dt, kReference);
    accel_ += dt / rest_ * change;
  }
  const double speed = velocity_.norm();
  is_felt_ = speed > (is_felt_ ? kEnds : kFelt);
  if (!is_felt_) {
    greatest_speed_ = acceleration_ = 0;
  } else if (speed > greatest_speed_) {
    greatest_speed_ = speed;
    acceleration_ += ToSeconds(imu.back().t_ns - imu.front().t_ns);
    if (acceleration_ > kLongestAcceleration) Reset();
  }
}

void UnseenMotion::Reset() {
  const Eigen::Vector3d position = position_;
  *this = UnseenMotion();
  position_ = position;
}

}  // namespace plm_vins
