// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/lengths/length_check.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "common/camera/camera_model.h"
#include "common/imu/imu_noise.h"
#include "common/imu/imu_samples.h"
#include "vins_estimator/initialization/visual_inertial_alignment.h"
#include "vins_estimator/lengths/length_likelihood.h"
#include "vins_estimator/structure_from_motion/frame_selection.h"
#include "vins_estimator/structure_from_motion/stereo_structure.h"
#include "vins_estimator/structure_from_motion/tracks.h"

namespace plm_vins {
namespace {

constexpr double kPiece = 3.0, kLeastPiece = 0.3;  // [s]
constexpr double kRoughly = 0.1;                   // deviation of a ratio that is no gross error
constexpr double kStride = 0.1;                    // between judgements [s]
constexpr size_t kMaxTracks = 100;
constexpr size_t kMaxViews = 12, kLeastViews = 4;
constexpr double kRest = 0.75;    // standstill before a motion, which tells the inclination [s]
constexpr double kStillFlow = 3;  // image motion at standstill, in standard deviations of a corner
constexpr double kLeastDisparity = 6;  // of points in two cameras, in standard deviations
constexpr int kRefinements = 4;
constexpr double kWrong = 5;            // standard deviations
constexpr double kLargestError = 0.05;  // of a calibrated length, relative
constexpr int kContradictions = 2;
constexpr double kAgree = 2;  // standard deviations by which two estimates of a ratio may differ
// Deviation of the gyro's bias that is estimated from the images, times their duration [rad].
constexpr double kGyroBiasByTime = 0.002;
// Deviations of a ratio that needs no more evidence: if it fits, and if it does not.
constexpr double kFits = 2, kKnown = 0.025, kKnownBest = 0.012;
constexpr double kSteadiness = 3e-4;  // least deviation of positions, relative to the path's length

std::vector<Rigid3d> ExtrinsicsOf(const SensorConfig& sensor) {
  std::vector<Rigid3d> T_B_C;
  for (const CameraSensor& camera : sensor.cameras) T_B_C.push_back(camera.T_B_C);
  return T_B_C;
}

// Keeps the tracks with the most observations, which tell most.
std::vector<Track> Longest(std::vector<Track> tracks) {
  std::stable_sort(tracks.begin(), tracks.end(), [](const Track& a, const Track& b) {
    return a.observations.size() > b.observations.size();
  });
  if (tracks.size() > kMaxTracks) tracks.resize(kMaxTracks);
  return tracks;
}

// The path of a camera in the frame of a structure.
StatedPath PathOf(const StereoStructure& structure, const Rigid3d& T_B_C) {
  StatedPath path;
  for (size_t i = 0; i < structure.T_G_B.size(); ++i) {
    path.p_G_C.push_back((structure.T_G_B[i] * T_B_C).translation);
  }
  double length = 0;
  for (const Eigen::Vector3d& p_G : path.p_G_C) {
    length = std::max(length, (p_G - path.p_G_C[0]).norm());
  }
  const double least = std::pow(kSteadiness * length, 2);
  double mean_trace = 0;
  for (const Eigen::Matrix3d& information : structure.position_information) {
    const bool is_origin = information.isZero();
    path.covariance.push_back(is_origin ? Eigen::Matrix3d::Zero()
                                        : Eigen::Matrix3d(information.inverse()));
    mean_trace += path.covariance.back().trace() / structure.T_G_B.size();
  }
  for (Eigen::Matrix3d& covariance : path.covariance) {
    if (covariance.isZero()) covariance = mean_trace / 3 * Eigen::Matrix3d::Identity();
    covariance.diagonal().array() += least;
  }
  return path;
}

}  // namespace

LengthCheck::LengthCheck(const SensorConfig& sensor, double point_noise_px,
                         std::optional<StereoPair> pair)
    : sensor_(sensor),
      noise_(point_noise_px /
             CameraModel::Create(sensor.cameras[pair ? pair->first : 0].parameters)->FocalLength()),
      pair_(pair) {}

void LengthCheck::Interrupt() {
  piece_.clear();
  used_ns_.reset();
  judged_ns_.reset();
}

void LengthCheck::Add(const FrameMeasurement& measurement) {
  if (is_known_) return;
  if (!piece_.empty() && LeaveGap(measurement.imu)) Interrupt();
  piece_.push_back(OfSource(measurement));
  if (DependsOnLength(piece_.back().points)) used_ns_ = measurement.t_ns;
  if (ShortenRest()) return;
  const double duration = ToSeconds(measurement.t_ns - piece_.front().t_ns);
  const bool is_complete = duration > kPiece;
  if (!judged_ns_) judged_ns_ = measurement.t_ns;
  const bool is_urgent = ratio_.deviation > kRoughly || contradictions_ > 0;
  const bool is_due = is_urgent && ToSeconds(measurement.t_ns - *judged_ns_) > kStride - 1e-3;
  if (duration < kLeastPiece || piece_.size() < kLeastViews || !(is_due || is_complete)) return;
  judged_ns_ = measurement.t_ns;
  if (const auto curve = CurveOfPiece()) {
    RatioCurve all = earlier_;
    all.Add(*curve);
    Judge(all);
    if (is_complete) {
      earlier_ = all;
      scale_information_ += scale_information_of_piece_;
    }
  }
  if (is_complete) piece_.erase(piece_.begin(), piece_.end() - 1);
}

double LengthCheck::Doubt() const {
  if (!is_open() || !used_ns_ || ToSeconds(piece_.back().t_ns - *used_ns_) > kPiece) return 0;
  return std::min({1.0, doubt_of_estimator_, std::hypot(ratio_.deviation, ratio_.log_ratio)});
}

void LengthCheck::Judge(const RatioCurve& curve) {
  const double scale_information = scale_information_ + scale_information_of_piece_;
  ratio_ = curve.Estimate(std::hypot(kAccelScaleDeviation, 1 / std::sqrt(scale_information)));
  const bool contradicts =
      ratio_.contradiction > kWrong && std::abs(ratio_.log_ratio) > kLargestError;
  contradictions_ = contradicts ? contradictions_ + 1 : 0;
  is_wrong_ |= contradictions_ >= kContradictions;
  const bool fits = ratio_.contradiction < kFits || is_wrong_;
  const bool is_settled = is_wrong_ || contradictions_ == 0;
  is_known_ = is_settled && ratio_.deviation < (fits ? kKnown : kKnownBest);
}

void LengthCheck::Add(const LengthEvidence& log_ratio) {
  doubt_of_estimator_ = std::hypot(log_ratio.error, log_ratio.deviation);
  if (!log_ratio.IsSignificant() || is_known_ || is_wrong_) return;
  const double difference =
      (log_ratio.error - ratio_.log_ratio) / std::hypot(log_ratio.deviation, ratio_.deviation);
  if (std::abs(difference) > kAgree || std::abs(log_ratio.error) < kLargestError) return;
  by_estimator_ = log_ratio.error;
  is_wrong_ = true;
}

double LengthCheck::contradiction() const {
  return std::max(ratio_.contradiction, by_estimator_ ? kMinSignificance : 0);
}

bool LengthCheck::IsTooLong() const {
  return (KnowsRatio() ? ratio_.log_ratio : *by_estimator_) > 0;
}

bool LengthCheck::KnowsRatio() const { return !by_estimator_ || ratio_.deviation < kRoughly; }

// Drops the beginning of a long standstill. Returns whether it still lasts.
bool LengthCheck::ShortenRest() {
  const auto is_long = [this] {
    return ToSeconds(piece_.back().t_ns - piece_.front().t_ns) > kRest;
  };
  const auto rests = [this] {
    const PointFrame &first = piece_.front().points, &last = piece_.back().points;
    return CountCommonPoints(first, last) > 0 && MedianFlow(first, last) < kStillFlow * noise_;
  };
  if (!is_long() || !rests()) return false;
  while (is_long()) piece_.pop_front();
  return true;
}

bool LengthCheck::DependsOnLength(const PointFrame& frame) const {
  const auto& points = frame.points;
  return std::any_of(points.begin(), points.end(), [this](const PointObservation& point) {
    return pair_ ? point.camera == pair_->second : point.depth.has_value();
  });
}

// Keeps the observations by the pair, or by camera 0 with measured depths.
FrameMeasurement LengthCheck::OfSource(const FrameMeasurement& measurement) const {
  FrameMeasurement result = measurement;
  result.lines.reset();
  std::vector<PointObservation>& points = result.points.points;
  const auto is_other = [this](const PointObservation& point) {
    return pair_ ? point.camera != pair_->first && point.camera != pair_->second
                 : point.camera != 0;
  };
  points.erase(std::remove_if(points.begin(), points.end(), is_other), points.end());
  for (PointObservation& point : points) {
    if (pair_) point.depth.reset();
  }
  return result;
}

std::optional<RatioCurve> LengthCheck::CurveOfPiece() {
  const auto frames = JoinFrames(piece_, SelectFrames(piece_, kMaxViews));
  std::vector<Preintegration> intervals;
  std::vector<Eigen::Quaterniond> R_G_B = {Eigen::Quaterniond::Identity()};
  std::vector<const PointFrame*> views = {&frames[0].points};
  for (size_t i = 1; i < frames.size(); ++i) {
    intervals.emplace_back(sensor_.imu_noise, ImuBias{});
    for (const ImuSample& sample : frames[i].imu) intervals.back().Append(sample);
    R_G_B.push_back((R_G_B.back() * intervals.back().delta_q()).normalized());
    views.push_back(&frames[i].points);
  }
  std::string reason;
  const StereoStructureOptions options{ExtrinsicsOf(sensor_), noise_, kLeastDisparity * noise_,
                                       kRefinements};
  const auto structure =
      ReconstructFromStereo(Longest(CollectTracks(views)), R_G_B, options, &reason);
  if (!structure) return std::nullopt;
  scale_information_of_piece_ = std::pow(structure->scale_deviation, -2);
  const auto gyro_bias = EstimateGyroBias(RotationsBetween(*structure, intervals), &reason);
  if (!gyro_bias) return std::nullopt;
  MeasuredMotion motion{
      {}, structure->T_G_B[0].rotation, sensor_.cameras[pair_ ? pair_->first : 0].T_B_C};
  for (Preintegration& imu : intervals) {
    imu.Repropagate({Eigen::Vector3d::Zero(), *gyro_bias});
    motion.intervals.push_back(&imu);
  }
  return LikelihoodOfRatio(PathOf(*structure, motion.T_B_C), motion,
                           {sensor_.gravity_norm, sensor_.accel_bias_deviation,
                            kGyroBiasByTime / ToSeconds(frames.back().t_ns - frames[0].t_ns)});
}

}  // namespace plm_vins
