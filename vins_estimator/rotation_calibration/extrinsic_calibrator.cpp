// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/rotation_calibration/extrinsic_calibrator.h"

#include "vins_estimator/rotation_calibration/rotation_pair.h"

namespace plm_vins {
namespace {

constexpr double kPairStride = 0.1;  // between consecutive pairs [s]
constexpr size_t kMaxRotationPairs = 200;

}  // namespace

std::optional<Eigen::Quaterniond> ExtrinsicCalibrator::Add(
    const std::deque<FrameMeasurement>& frames, std::string* reason) {
  const int64_t newest_ns = frames.back().t_ns;
  if (last_ns_ && ToSeconds(newest_ns - *last_ns_) < kPairStride - 1e-3) return std::nullopt;
  last_ns_ = newest_ns;
  const std::optional<RotationPair> pair =
      MeasureRotationPair(frames, 0, imu_noise_, noise_, reason);
  if (pair) pairs_.push_back(*pair);
  if (pairs_.size() > kMaxRotationPairs) pairs_.erase(pairs_.begin());
  auto R_B_C = CalibrateExtrinsicRotation(pairs_, ExtrinsicRotationOptions(), reason);
  if (!R_B_C) *reason = "calibrating the camera's rotation: " + *reason;
  return R_B_C;
}

}  // namespace plm_vins
