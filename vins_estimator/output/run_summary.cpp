// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/output/run_summary.h"

#include "common/measurements.h"

namespace plm_vins {
namespace {

constexpr int64_t kLongestPause_ns = 60'000'000'000;

// Returns the time between two frames; zero if the clock was set back or far ahead.
int64_t Elapsed(int64_t from_ns, int64_t to_ns) {
  const int64_t elapsed = to_ns - from_ns;
  return elapsed > 0 && elapsed <= kLongestPause_ns ? elapsed : 0;
}

double Ratio(double numerator, double denominator) {
  return denominator > 0 ? numerator / denominator : 0.0;
}

Json DropsToJson(const DropCounts& drops) {
  Json json = Json::object();
  for (const DropCount& drop : drops) json[drop.cause] = drop.count;
  return json;
}

Json PinholeToJson(const CameraParameters& camera) {
  return {camera.fx, camera.fy, camera.cx, camera.cy};
}

Json DistortionToJson(const CameraParameters& camera) {
  const Eigen::Vector4d& d = camera.distortion;
  return {d[0], d[1], d[2], d[3]};
}

Json CameraToJson(const CameraCalibration& camera) {
  const Eigen::Quaterniond& q = camera.T_B_C.rotation;
  const Eigen::Vector3d& p = camera.T_B_C.translation;
  return {{"fx_fy_cx_cy_px", PinholeToJson(camera.parameters)},
          {"distortion", DistortionToJson(camera.parameters)},
          {"q_B_C_xyzw", {q.x(), q.y(), q.z(), q.w()}},
          {"p_B_C_m", {p.x(), p.y(), p.z()}}};
}

// The first camera's values are at the top, those of others in "camera1", ...
Json CalibrationToJson(const Calibration& calibration) {
  Json json = CameraToJson(calibration.cameras.front());
  json["td_s"] = calibration.td;
  for (size_t i = 1; i < calibration.cameras.size(); ++i) {
    json["camera" + std::to_string(i)] = CameraToJson(calibration.cameras[i]);
  }
  return json;
}

using NamedSeries = std::vector<Column<Series>>;

template <typename T>
NamedSeries NamesOf(const std::vector<Column<T>>& columns) {
  NamedSeries series;
  for (const Column<T>& column : columns) series.push_back({column.name, {}});
  return series;
}

template <typename T>
void Append(const std::vector<Column<T>>& columns, NamedSeries* series) {
  for (size_t i = 0; i < series->size(); ++i) {
    (*series)[i].value.Add(static_cast<double>(columns[i].value));
  }
}

Json TimingsToJson(const NamedSeries& timings) {
  Json json;
  for (const auto& stage : timings) {
    const SeriesSummary summary = stage.value.Summary();
    json[stage.name] = {{"mean", summary.mean}, {"p95", summary.p95}, {"p99", summary.p99}};
  }
  return json;
}

Json CountsToJson(const NamedSeries& counts) {
  Json json;
  for (const auto& count : counts) {
    const SeriesSummary summary = count.value.Summary();
    json[count.name] = {{"mean", summary.mean}, {"median", summary.median}};
  }
  return json;
}

Json RingsToJson(const std::vector<ResidualRing>& rings) {
  Json json = Json::array();
  for (const ResidualRing& ring : rings) {
    json.push_back({{"inner_px", ring.inner_px},
                    {"outer_px", ring.outer_px},
                    {"count", ring.count},
                    {"radial_px", ring.radial_px},
                    {"deviation_px", ring.deviation_px}});
  }
  return json;
}

}  // namespace

RunSummary::RunSummary(const FrameColumns& columns)
    : timings_(NamesOf(columns.timings)), counts_(NamesOf(columns.counts)) {}

void RunSummary::Add(const EstimatorOutput& output, const FrameColumns& columns) {
  ++frames_;
  points_ += output.counts.points_observed;
  Append(columns.timings, &timings_);
  Append(columns.counts, &counts_);
  if (last_frame_ns_) duration_ns_ += Elapsed(*last_frame_ns_, output.t_ns);
  last_frame_ns_ = output.t_ns;
  if (!output.reason.empty()) last_reason_ = output.reason;
  if (output.restarted) {
    ++resets_;
    last_position_.reset();  // the path does not continue across world frames
  }
  if (output.has_pose) AddPose(output);
}

void RunSummary::AddPose(const EstimatorOutput& output) {
  ++poses_;
  stationary_ += output.stationary ? 1 : 0;
  keyframes_ += output.keyframe ? 1 : 0;
  bridged_losses_ += output.bridged ? 1 : 0;
  imu_doubts_ += output.imu_doubted ? 1 : 0;
  accel_density_ += output.imu_noise.accel_density;
  gyro_density_ += output.imu_noise.gyro_density;
  imu_noisy_ += output.imu_noise_scale > 1 ? 1 : 0;
  merged_lines_ += output.counts.line_merging.merged;
  recognized_lines_ += output.counts.lines_recognized;
  manhattan_ += output.R_W_M ? 1 : 0;
  if (!first_pose_ns_) first_pose_ns_ = output.t_ns;
  const Eigen::Vector3d position = output.state.position();
  if (last_position_) path_length_ += (position - *last_position_).norm();
  last_position_ = position;
  calibration_ = output.calibration;
}

Json RunSummary::ToJson(const Run& run) const {
  const double duration = ToSeconds(duration_ns_);
  Json json;
  json["input"] = run.input;
  json["images"] = run.images;
  json["frames"] = frames_;
  json["poses"] = poses_;
  json["keyframes"] = keyframes_;
  json["init_time_s"] = nullptr;
  if (first_pose_ns_ && run.first_image_ns) {
    json["init_time_s"] = ToSeconds(*first_pose_ns_ - *run.first_image_ns);
  }
  json["duration_s"] = duration;
  json["wall_time_s"] = run.wall_time;
  json["real_time_factor"] = Ratio(duration, run.wall_time);
  json["path_length_m"] = path_length_;
  json["standstill_share"] = Ratio(static_cast<double>(stationary_), static_cast<double>(poses_));
  json["points"] = run.map_points;
  json["points_per_frame"] = Ratio(static_cast<double>(points_), static_cast<double>(frames_));
  json["lines"] = run.map_lines;
  json["merged_lines"] = merged_lines_;
  json["recognized_lines"] = recognized_lines_;
  json["manhattan_share"] = Ratio(static_cast<double>(manhattan_), static_cast<double>(poses_));
  json["resets"] = resets_;
  json["bridged_losses"] = bridged_losses_;
  json["imu_doubts"] = imu_doubts_;
  json["imu_noise"] = {{"accel_density", Ratio(accel_density_, static_cast<double>(poses_))},
                       {"gyro_density", Ratio(gyro_density_, static_cast<double>(poses_))}};
  json["imu_noisy_share"] = Ratio(static_cast<double>(imu_noisy_), static_cast<double>(poses_));
  json["calibration"] = poses_ > 0 ? CalibrationToJson(calibration_) : Json(nullptr);
  json["timing_ms"] = TimingsToJson(timings_);
  json["counts_per_frame"] = CountsToJson(counts_);
  json["residual_rings"] = RingsToJson(run.residual_rings);
  json["dropped"] = DropsToJson(run.drops);
  json["findings"] = run.findings;
  return json;
}

}  // namespace plm_vins
