// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/rotation_calibration/rotation_pair.h"

#include <Eigen/SVD>
#include <algorithm>
#include <cmath>

#include "vins_estimator/imu/preintegration.h"
#include "vins_estimator/structure_from_motion/frame_selection.h"
#include "vins_estimator/structure_from_motion/relative_pose.h"
#include "vins_estimator/structure_from_motion/tracks.h"

namespace plm_vins {
namespace {

constexpr double kPairDuration = 0.3;  // between the two images of a pair [s]
constexpr double kMinTurn = 0.02;  // with less rotation, a pair has no information on axes [rad]
// Uncertainty of a pair in addition to its covariance, which wrong tracks make too small [rad].
constexpr double kExcessDeviation = 0.003;
constexpr size_t kMaxPoints = 40;   // stored with a pair
constexpr size_t kRateSamples = 5;  // from whose mean a rate is known in spite of vibration

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
std::optional<size_t> FindPartner(const std::deque<FrameMeasurement>& frames, int camera) {
  for (size_t i = frames.size(); i-- > 0;) {
    const bool is_old = ToSeconds(frames.back().t_ns - frames[i].t_ns) > kPairDuration - 1e-3;
    if (is_old && Observes(frames[i].points, camera)) return i;
  }
  return std::nullopt;
}

// Returns the change of the mean rate from the first samples to the last [rad/s].
Eigen::Vector3d RateChange(const std::vector<ImuSample>& imu) {
  const size_t count = std::min(kRateSamples, imu.size());
  Eigen::Vector3d change = Eigen::Vector3d::Zero();
  for (size_t i = 0; i < count; ++i) change += imu[imu.size() - 1 - i].gyro - imu[i].gyro;
  return change / static_cast<double>(count);
}

}  // namespace

std::optional<RotationPair> MeasureRotationPair(const std::deque<FrameMeasurement>& frames,
                                                int camera, const ImuNoise& imu_noise, double noise,
                                                std::string* reason) {
  const std::optional<size_t> partner = FindPartner(frames, camera);
  if (!partner) return std::nullopt;
  const std::vector<FrameMeasurement> ends = JoinFrames(frames, {*partner, frames.size() - 1});
  Preintegration imu(imu_noise, ImuBias{});
  for (const ImuSample& sample : ends[1].imu) imu.Append(sample);
  const auto correspondences = FindCorrespondences(
      OfCamera(camera, CollectTracks({&ends[0].points, &ends[1].points})), 0, 1);
  const auto pose =
      EstimateRelativePose(correspondences, AlignRays(correspondences), noise, reason);
  if (!pose || Eigen::AngleAxisd(pose->R_now_then).angle() < kMinTurn) return std::nullopt;
  const double variance = pose->rotation_information.inverse().trace() / 3;
  // If all points coincide, the variance is a rounding error.
  if (!(std::isfinite(variance) && variance >= 0)) return std::nullopt;
  RotationPair pair;
  pair.R_B0_B1 = imu.delta_q();
  pair.R_then_now = pose->R_now_then.conjugate();
  pair.duration = imu.duration();
  pair.deviation = std::sqrt(variance + kExcessDeviation * kExcessDeviation);
  pair.rate_change = RateChange(ends[1].imu);
  for (size_t i = 0; i < correspondences.size(); i += 1 + correspondences.size() / kMaxPoints) {
    pair.points.push_back(correspondences[i]);
  }
  return pair;
}

}  // namespace plm_vins
