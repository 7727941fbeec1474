// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/initialization/extrinsic_calibrator.h"

#include <Eigen/SVD>
#include <cmath>

#include "vins_estimator/imu/preintegration.h"
#include "vins_estimator/initialization/frame_selection.h"
#include "vins_estimator/initialization/relative_pose.h"
#include "vins_estimator/initialization/tracks.h"

namespace plm_vins {
namespace {

constexpr double kPairDuration = 0.3;  // between the two images of a pair [s]
constexpr double kPairStride = 0.1;    // between consecutive pairs [s]
constexpr double kMinTurn = 0.02;  // with less rotation, a pair has no information on axes [rad]
// Uncertainty of a pair in addition to its covariance, which wrong tracks make too small [rad].
constexpr double kExcessDeviation = 0.003;
constexpr size_t kMaxPairs = 200;

// Returns the rotation that aligns the rays of the first image best with those of the second, as if
// all points were at infinity; parallax makes it wrong by a few degrees.
Eigen::Quaterniond AlignRays(const std::vector<Correspondence>& correspondences) {
  Eigen::Matrix3d products = Eigen::Matrix3d::Zero();
  for (const Correspondence& c : correspondences) {
    products += c.xy1.homogeneous().normalized() * c.xy0.homogeneous().normalized().transpose();
  }
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(products, Eigen::ComputeFullU | Eigen::ComputeFullV);
  const double sign = svd.matrixU().determinant() * svd.matrixV().determinant();
  const Eigen::Vector3d diagonal(1, 1, sign < 0 ? -1 : 1);
  return Eigen::Quaterniond(
      Eigen::Matrix3d(svd.matrixU() * diagonal.asDiagonal() * svd.matrixV().transpose()));
}

// Returns the last frame that is old enough to form a pair with the newest one.
std::optional<size_t> FindPartner(const std::deque<FrameMeasurement>& frames) {
  for (size_t i = frames.size(); i-- > 0;) {
    if (ToSeconds(frames.back().t_ns - frames[i].t_ns) > kPairDuration - 1e-3) return i;
  }
  return std::nullopt;
}

}  // namespace

std::optional<RotationPair> ExtrinsicCalibrator::MeasurePair(
    const std::deque<FrameMeasurement>& frames, std::string* reason) const {
  const std::optional<size_t> partner = FindPartner(frames);
  if (!partner) return std::nullopt;
  const std::vector<FrameMeasurement> ends = JoinFrames(frames, {*partner, frames.size() - 1});
  Preintegration imu(imu_noise_, ImuBias{});
  for (const ImuSample& sample : ends[1].imu) imu.Append(sample);
  const auto correspondences =
      FindCorrespondences(CollectTracks({&ends[0].points, &ends[1].points}), 0, 1);
  const auto pose =
      EstimateRelativePose(correspondences, AlignRays(correspondences), noise_, reason);
  if (!pose || Eigen::AngleAxisd(pose->R_C1_C0).angle() < kMinTurn) return std::nullopt;
  const double variance = pose->rotation_information.inverse().trace() / 3;
  // If all points coincide, the variance is a rounding error.
  if (!(std::isfinite(variance) && variance >= 0)) return std::nullopt;
  return RotationPair{imu.delta_q(), pose->R_C1_C0.conjugate(), imu.duration(),
                      std::sqrt(variance + kExcessDeviation * kExcessDeviation)};
}

std::optional<Eigen::Quaterniond> ExtrinsicCalibrator::Add(
    const std::deque<FrameMeasurement>& frames, std::string* reason) {
  const int64_t newest_ns = frames.back().t_ns;
  if (last_ns_ && ToSeconds(newest_ns - *last_ns_) < kPairStride - 1e-3) return std::nullopt;
  last_ns_ = newest_ns;
  const std::optional<RotationPair> pair = MeasurePair(frames, reason);
  if (pair) pairs_.push_back(*pair);
  if (pairs_.size() > kMaxPairs) pairs_.erase(pairs_.begin());
  const auto R_B_C = CalibrateExtrinsicRotation(pairs_, ExtrinsicRotationOptions(), reason);
  if (!R_B_C) *reason = "calibrating the camera's rotation: " + *reason;
  return R_B_C;
}

}  // namespace plm_vins
