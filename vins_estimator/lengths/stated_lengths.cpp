// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/lengths/stated_lengths.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "common/format.h"

namespace plm_vins {
namespace {

constexpr double kMemory = 10;                  // longest time from the start to repeat [s]
constexpr double kPatience = 3;                 // for the unit of depths to be known [s]
constexpr double kLargestByCalibration = 0.25;  // error of the logarithm of a length
constexpr double kSuspicious = 2;               // standard deviations

// Units of depth images other than mm in 16UC1 and m in 32FC1.
struct DepthUnit {
  double meters;
  const char* name;
  bool is_integer;  // of 16UC1
};
constexpr DepthUnit kDepthUnits[] = {
    {1e-3, "1 mm", true},      {1e-4, "0.1 mm", true},      {2e-4, "1/5000 m", true},
    {2.5e-4, "0.25 mm", true}, {5e-4, "0.5 mm", true},      {1 / 256.0, "1/256 m", true},
    {1e-2, "cm", true},        {1.25e-4, "1/8000 m", true}, {1e-3, "mm", false},
    {1e-2, "cm", false},       {0.3048, "feet", false},     {0.0254, "inches", false}};

template <typename Observation>
void DropCamera(int camera, std::vector<Observation>* observations) {
  const auto is_of_camera = [camera](const Observation& o) { return o.camera == camera; };
  observations->erase(std::remove_if(observations->begin(), observations->end(), is_of_camera),
                      observations->end());
}

// Returns the logarithm of the ratio of the stated to the true length; nullopt if the estimator has
// no evidence of an error.
std::optional<LengthEvidence> EvidenceFor(const std::optional<StereoPair>& pair,
                                          const EstimatorReport& report) {
  if (!pair) return report.depth.scale;
  for (const CameraFaults& faults : report.cameras) {
    if (faults.camera != pair->second || !faults.baseline) continue;
    return LengthEvidence{-faults.baseline->error, faults.baseline->deviation};
  }
  return std::nullopt;
}

// Depths of another unit contradict the motion like those of another view.
bool HasRightUnit(const RatioEstimate& ratio) {
  return std::hypot(ratio.log_ratio, ratio.deviation) < kLargestByCalibration;
}

}  // namespace

std::string ProbableDepthUnit(double ratio, double deviation, double depth_unit) {
  const double tolerance = std::max(0.05, 3 * deviation);
  std::string text;
  double best = tolerance;
  for (const DepthUnit& unit : kDepthUnits) {
    const double expected = (unit.is_integer ? depth_unit : 1) / unit.meters;
    const double error = std::abs(std::log(ratio / expected));
    if (error >= best) continue;
    best = error;
    text = unit.is_integer ? Format("unit %s? depth_unit: %.6g", unit.name, unit.meters)
                           : Format("are these 32FC1 images in %s? They must be in m", unit.name);
  }
  const bool is_far_off = std::abs(std::log(ratio)) > kLargestByCalibration;
  return text.empty() && is_far_off ? "of no common unit: disparity instead of depth?" : text;
}

StatedLengths::StatedLengths(const Config& config) : sensor_(config.sensor) {
  const double noise_px = config.estimator.point_noise;
  for (const StereoPair& pair : StereoPairs(sensor_)) checks_.emplace_back(sensor_, noise_px, pair);
  if (sensor_.depth) checks_.emplace_back(sensor_, noise_px, std::nullopt);
}

void StatedLengths::StartOver() {
  images_.clear();
  for (LengthCheck& check : checks_) check.Interrupt();
}

bool StatedLengths::Add(const FrameMeasurement& measurement, const EstimatorReport& previous) {
  bool is_news = false, is_open = false;
  for (LengthCheck& check : checks_) {
    const bool was_wrong = check.is_wrong();
    if (const auto evidence = EvidenceFor(check.pair(), previous)) check.Add(*evidence);
    check.Add(measurement);
    is_news |= check.is_wrong() && !was_wrong;
    is_open |= check.is_open();
  }
  if (sensor_.depth && !DropsDepth()) {
    unaligned_ = Confirmed(previous.depth.misalignment, measurement.t_ns);
    if (unaligned_) checks_.pop_back();
    is_news |= unaligned_.has_value();
    is_open = true;
  }
  if (is_news) return true;
  if (!is_open) images_.clear();
  if (is_open) images_.push_back(measurement);
  while (!images_.empty() && ToSeconds(measurement.t_ns - images_.front().t_ns) > kMemory) {
    images_.pop_front();
  }
  return false;
}

std::optional<Misalignment> StatedLengths::Confirmed(const std::optional<Misalignment>& found,
                                                     int64_t t_ns) {
  if (!found) return std::nullopt;
  if (!misaligned_ns_) misaligned_ns_ = t_ns;
  const bool has_waited = ToSeconds(t_ns - *misaligned_ns_) > kPatience;
  return has_waited || HasRightUnit(checks_.back().ratio()) ? found : std::nullopt;
}

bool StatedLengths::IsDropped(int camera) const {
  return std::any_of(checks_.begin(), checks_.end(), [camera](const LengthCheck& check) {
    return check.is_wrong() && check.pair() && check.pair()->second == camera;
  });
}

bool StatedLengths::DropsDepth() const {
  return sensor_.depth && (unaligned_ || checks_.back().is_wrong());
}

FrameMeasurement StatedLengths::Usable(FrameMeasurement measurement) const {
  for (int camera = 1; camera < static_cast<int>(sensor_.cameras.size()); ++camera) {
    if (!IsDropped(camera)) continue;
    DropCamera(camera, &measurement.points.points);
    if (measurement.lines) DropCamera(camera, &measurement.lines->lines);
  }
  if (!sensor_.depth) return measurement;
  const double max = DropsDepth() ? 0 : sensor_.depth->max;
  for (PointObservation& point : measurement.points.points) {
    if (point.depth && *point.depth > max) point.depth.reset();
  }
  return measurement;
}

Config StatedLengths::Usable(Config config) const {
  std::string pairs;
  if (DropsDepth()) config.sensor.depth.reset();
  for (const LengthCheck& check : checks_) {
    if (!check.pair() || check.is_wrong()) continue;
    if (!pairs.empty()) pairs += " ";
    pairs += Format("%d-%d", check.pair()->first, check.pair()->second);
  }
  config.sensor.stereo_pairs = pairs.empty() ? "none" : pairs;
  return config;
}

std::string StatedLengths::Describe(const LengthCheck& check) const {
  const double ratio = std::exp(check.ratio().log_ratio);
  const double times = std::max(ratio, 1 / ratio);
  const bool is_long = check.IsTooLong();
  const std::string factor = check.KnowsRatio()
                                 ? Format("%.*f", times < 1.995 ? 2 : 1, times) +
                                       (is_long ? " times too long" : " times too short")
                                 : (is_long ? "too long" : "too short");
  if (!check.pair()) {
    const std::string unit =
        check.KnowsRatio() ? ProbableDepthUnit(ratio, check.ratio().deviation, sensor_.depth->unit)
                           : "";
    return "depth_topic " + sensor_.depth->topic + ": by motion and IMU, depths are " + factor +
           (unit.empty() ? "" : " (" + unit + ")") + "; they are not used";
  }
  const auto& [first, second] = *check.pair();
  const double stated =
      (sensor_.cameras[first].T_B_C.Inverse() * sensor_.cameras[second].T_B_C).translation.norm();
  const std::string right = check.KnowsRatio() ? Format("%.3g m, ", stated / ratio) : "";
  return TransformKey(second) +
         Format(": by motion and IMU, the baseline of cameras %d and %d is ", first, second) +
         right + Format("not the configured %.3g m, which are ", stated) + factor +
         ", unless its rotation or a principal point is wrong" +
         Format("; camera %d is not used", second);
}

std::string StatedLengths::Finding() const {
  std::vector<std::string> findings;
  for (const LengthCheck& check : checks_) {
    if (check.is_wrong()) findings.push_back(Describe(check));
  }
  if (unaligned_) {
    findings.push_back(
        "depth_topic " + sensor_.depth->topic +
        Format(": by motion, depth images are not aligned to camera 0, by at least %.0f px, or "
               "much older than their timestamps; they are not used",
               unaligned_->distance_px));
  }
  return JoinTexts(findings, "; ");
}

double StatedLengths::Doubt() const {
  double worst = 0;
  for (const LengthCheck& check : checks_) worst = std::max(worst, check.Doubt());
  return worst;
}

double StatedLengths::Contradiction() const {
  double worst = unaligned_ ? unaligned_->distance_px / unaligned_->deviation_px : 0;
  for (const LengthCheck& check : checks_) {
    if (check.is_wrong()) worst = std::max(worst, check.contradiction());
  }
  return worst;
}

}  // namespace plm_vins
