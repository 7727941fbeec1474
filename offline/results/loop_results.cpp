// SPDX-License-Identifier: BSD-3-Clause
#include "offline/results/loop_results.h"

#include <algorithm>
#include <filesystem>
#include <stdexcept>
#include <utility>

#include "common/format.h"
#include "common/stopwatch.h"
#include "pose_graph/output/loop_table.h"
#include "vins_estimator/output/placed_features.h"
#include "vins_estimator/output/pose_rows.h"

namespace plm_vins {

namespace {

// Returns nullopt with a rolling shutter, since the bundle adjustment assumes that all rows of an
// image are exposed at the same time.
std::optional<MapBundle> BundleOf(const Config& config, double focal_length) {
  const SensorConfig& sensor = config.sensor;
  if (!config.pose_graph.bundle_adjustment || sensor.rolling_shutter) return std::nullopt;
  MapBundleOptions options;
  options.gravity_norm = sensor.gravity_norm;
  options.point_noise = config.estimator.point_noise / focal_length;
  if (sensor.depth) options.depth_noise = sensor.depth->noise;
  return MapBundle(options);
}

// Converts the result of an image with a pose to the input of loop closure. `restarted` means that
// the world frame has changed since the previous image with a pose.
OdometryFrame ToOdometryFrame(const PipelineFrame& frame, bool restarted) {
  const EstimatorOutput& output = frame.output;
  OdometryFrame result;
  result.t_ns = output.t_ns;
  result.restarted = restarted;
  result.T_O_B = output.state.T_W_B();
  result.T_B_C.clear();
  for (const CameraCalibration& camera : output.calibration.cameras) {
    result.T_B_C.push_back(camera.T_B_C);
    result.refined.push_back(camera.parameters);
  }
  // An unknown covariance is zero, so that odometry edges get the minimum of OdometryNoise.
  if (output.uncertainty) result.covariance = output.uncertainty->pose;
  result.corners = PlaceCorners(frame.points, output.points);
  result.segments = PlaceSegments(frame.lines, output.lines);
  for (size_t camera = 0; camera < frame.images.size(); ++camera) {
    const ImageSample& image = frame.images[camera];
    if (!image.gray.empty()) result.images[static_cast<int>(camera)] = {image.gray, image.owner};
  }
  return result;
}

}  // namespace

LoopResults::LoopResults(const Config& config, const std::string& folder,
                         std::optional<KeyframeMap> map)
    : folder_(folder),
      cameras_(CreateAll(config.sensor.cameras)),
      loops_(cameras_),
      bundle_(BundleOf(config, cameras_[0]->FocalLength())),
      trajectory_(File("trajectory_map.tum")),
      covariance_(File("covariance_map.csv"), CovarianceHeader()),
      table_(File("loops.csv")) {
  if (map) {
    loaded_keyframes_ = static_cast<int>(map->keyframes.size());
    loops_.SetMap(std::move(*map));
  }
  WriteLoopHeader(&table_.stream());
}

std::string LoopResults::File(const std::string& name) const {
  return (std::filesystem::path(folder_) / name).string();
}

void LoopResults::Add(const PipelineFrame& frame) {
  if (bundle_) {
    for (const ImuSample& sample : frame.imu) bundle_->AddImu(sample);
  }
  if (frame.output.restarted) restart_reason_ = frame.output.reason;
  if (!frame.output.has_pose) return;
  if (frame.images.empty()) {
    throw std::runtime_error("loop closure needs images, and there are none with --features");
  }
  const bool restarted = !restart_reason_.empty() && !poses_.empty();
  if (restarted) worlds_.emplace_back(poses_.size(), restart_reason_);
  restart_reason_.clear();

  const Stopwatch stopwatch;
  const LoopClosure closure = loops_.Add(ToOdometryFrame(frame, restarted));
  Count(closure, stopwatch.Milliseconds());
  if (bundle_) Remember(frame, closure);
  const Rigid3d T_O_B = frame.output.state.T_W_B();
  const int newest = loops_.map().graph.size() - 1;
  poses_.push_back({frame.output.t_ns, T_O_B, newest});
  if (!closure.fix) return;
  const int64_t t_ns = frame.output.t_ns;
  trajectory_.Row(t_ns) << FormatTumRow(t_ns, closure.fix->T_M_O.ToRigid() * T_O_B);
  if (const auto& known = frame.output.uncertainty) {
    WriteCovarianceRow(t_ns, CovarianceInMap(*closure.fix, T_O_B, known->pose),
                       &covariance_.Row(t_ns));
  }
  if (!first_fix_) first_fix_ = ToSeconds(frame.output.t_ns - poses_.front().t_ns);
}

void LoopResults::Count(const LoopClosure& closure, double milliseconds) {
  tally_.Add(closure);
  for (const auto* loops : {&closure.candidates, &closure.confirmed, &closure.reconsidered}) {
    for (const LoopCandidate& loop : *loops) {
      WriteLoopRow(loop, &table_.stream());
      recognitions_ += !loop.failed && loop.earlier < loaded_keyframes_;
    }
  }
  if (!closure.is_keyframe) return;
  ++keyframes_;
  keyframe_ms_.Add(milliseconds);
}

void LoopResults::Remember(const PipelineFrame& frame, const LoopClosure& closure) {
  if (closure.is_keyframe) {
    bundle_->AddKeyframe(loops_.map(), frame.output, frame.imu_ns, frame.points);
  }
  bundle_->AddLoops(loops_.map(), closure);
}

size_t LoopResults::KeyframesToAdjust() const {
  return bundle_ ? bundle_->KeyframesToAdjust(loops_.map()) : 0;
}

MapBundleSummary LoopResults::AdjustMap(const std::function<bool()>& is_end) {
  if (!bundle_) return {};
  const Stopwatch stopwatch;
  if (const std::optional<AdjustedMap> found = bundle_->Adjust(loops_.map(), is_end)) {
    Adjusted adjusted;
    adjusted.moved = loops_.map();
    MoveNodes(*found, &adjusted.moved);
    adjusted.rebuilt = RebuiltMap(*found, adjusted.moved);
    adjusted_ = std::move(adjusted);
  }
  bundle_ms_ = stopwatch.Milliseconds();
  return bundle_->summary();
}

void LoopResults::Finish() {
  trajectory_.Close();
  covariance_.Close();
  table_.Close();
  WriteFinalTrajectory();
}

// Poses of a world that is not connected with the map are written in that world, delimited by
// comments.
void LoopResults::WriteFinalTrajectory() const {
  TimedFile file(File("trajectory_final.tum"));
  auto world = worlds_.begin();
  std::string reason = "not recognized in the map";
  bool was_in_map = true;
  const KeyframeMap& moved = measured_map();
  const std::vector<bool> connected = moved.graph.ConnectedWith(0);
  for (size_t i = 0; i < poses_.size(); ++i) {
    const bool in_map = connected[poses_[i].keyframe];
    const bool begins = world != worlds_.end() && world->first == i;
    if (begins) reason = (world++)->second;
    if (in_map != was_in_map || (begins && !in_map)) file.Comment(FormatTumRestart(reason));
    was_in_map = in_map;
    file.Row(poses_[i].t_ns) << FormatTumRow(poses_[i].t_ns, PoseInMap(moved, poses_[i]));
  }
  file.Close();
}

// Null if the map was not bundle-adjusted.
Json LoopResults::BundleSummary() const {
  if (!adjusted_) return nullptr;
  const MapBundleSummary& bundle = bundle_->summary();
  const double focal_length = cameras_[0]->FocalLength();
  Json json;
  json["keyframes"] = bundle.keyframes;
  json["landmarks"] = bundle.landmarks;
  json["reobservations"] = bundle.reobservations;
  json["rounds"] = bundle.rounds;
  json["noise_px"] = bundle.noise.followed * focal_length;
  json["noise_again_px"] = bundle.noise.again * focal_length;
  json["ms"] = bundle_ms_;
  return json;
}

Json LoopResults::Summary() const {
  Json refused = Json::object();
  for (int gate = 0; gate < kLoopGates; ++gate) {
    refused[ToString(static_cast<LoopGate>(gate))] = 0;
  }
  for (const auto& [gate, count] : tally_.refused) refused[ToString(gate)] = count;
  const SeriesSummary timing = keyframe_ms_.Summary();
  Json json;
  json["keyframes"] = keyframes_;
  json["map_keyframes"] = map().CountKept();
  json["candidates"] = tally_.candidates;
  json["accepted"] = tally_.accepted;
  json["dropped"] = tally_.dropped;
  json["refused"] = refused;
  json["first_fix_s"] = first_fix_ ? Json(*first_fix_) : Json(nullptr);
  json["bundle"] = BundleSummary();
  json["keyframe_ms"] = {{"mean", timing.mean}, {"p95", timing.p95}};
  return json;
}

std::string LoopResults::Line() const {
  std::string line = "loops: " + std::to_string(tally_.accepted - tally_.dropped) + " closed of " +
                     std::to_string(tally_.candidates) + " candidates";
  if (loaded_keyframes_ == 0 || !first_fix_) return line;
  return line + Format("; the loaded map was recognized after %.1f s, ", *first_fix_) +
         std::to_string(recognitions_) + " times in all";
}

std::string LoopResults::Finding() const {
  if (loaded_keyframes_ == 0 || keyframes_ == 0 || first_fix_) return "";
  return "the loaded map was never recognized: no pose is in its frame; check that it is of this "
         "place, camera and calibration, in similar light (loops.csv has each candidate and the "
         "gate that refused it)";
}

}  // namespace plm_vins
