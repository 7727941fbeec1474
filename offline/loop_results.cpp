// SPDX-License-Identifier: BSD-3-Clause
#include "offline/loop_results.h"

#include <algorithm>
#include <filesystem>
#include <stdexcept>
#include <utility>

#include "common/stopwatch.h"
#include "offline/loop_input.h"
#include "pose_graph/output/colmap_writer.h"
#include "pose_graph/output/g2o_writer.h"
#include "pose_graph/output/loop_table.h"
#include "pose_graph/output/map_file.h"
#include "vins_estimator/output/series_summary.h"
#include "vins_estimator/output/tum_format.h"

namespace plm_vins {

LoopResults::LoopResults(const Config& config, const std::string& folder, const std::string& map_in)
    : folder_(folder),
      camera_(CameraModel::Create(config.sensor.camera)),
      loops_(LoopCloserOptions(), camera_),
      trajectory_(Open("trajectory_map.tum")),
      table_(Open("loops.csv")) {
  if (!map_in.empty()) loops_.SetMap(LoadMap(map_in));
  WriteLoopHeader(&table_);
}

std::ofstream LoopResults::Open(const std::string& name) const {
  const std::filesystem::path file = std::filesystem::path(folder_) / name;
  std::ofstream stream(file);
  if (!stream) throw std::runtime_error("cannot write " + file.string());
  return stream;
}

void LoopResults::Add(const PipelineFrame& frame) {
  if (frame.output.restarted) restart_reason_ = frame.output.reason;
  if (!frame.output.has_pose) return;
  if (frame.image.gray.empty()) {
    throw std::runtime_error("loop closure needs images, and there are none with --features");
  }
  const bool restarted = !restart_reason_.empty() && !poses_.empty();
  if (restarted) worlds_.emplace_back(poses_.size(), restart_reason_);
  restart_reason_.clear();

  const Stopwatch stopwatch;
  const LoopClosure closure = loops_.Add(ToOdometryFrame(frame, restarted));
  Count(closure, stopwatch.Milliseconds());
  const Rigid3d T_O_B = frame.output.state.T_W_B();
  const int newest = loops_.map().graph.size() - 1;
  poses_.push_back({frame.output.t_ns, T_O_B, newest});
  if (!closure.fix) return;
  trajectory_ << FormatTumRow(frame.output.t_ns, closure.fix->T_M_O.ToRigid() * T_O_B);
  if (!first_fix_) first_fix_ = ToSeconds(frame.output.t_ns - poses_.front().t_ns);
}

void LoopResults::Count(const LoopClosure& closure, double milliseconds) {
  for (const LoopCandidate& candidate : closure.candidates) {
    WriteLoopRow(candidate, &table_);
    ++candidates_;
    ++(candidate.failed ? refused_[static_cast<size_t>(*candidate.failed)] : accepted_);
  }
  if (!closure.is_keyframe) return;
  ++keyframes_;
  keyframe_ms_.push_back({milliseconds});
}

void LoopResults::Finish(const std::string& map_out) {
  WriteFinalTrajectory();
  std::ofstream g2o = Open("pose_graph.g2o");
  WriteG2o(loops_.map(), &g2o);
  WriteColmapModel((std::filesystem::path(folder_) / "colmap").string(), camera_->parameters(),
                   loops_.map());
  trajectory_.close();
  table_.close();
  if (!trajectory_ || !table_ || !g2o) {
    throw std::runtime_error("cannot write to " + folder_ + ": disk full?");
  }
  if (!map_out.empty()) SaveMap(map_out, loops_.map());
}

void LoopResults::WriteFinalTrajectory() const {
  std::ofstream stream = Open("trajectory_final.tum");
  auto world = worlds_.begin();
  for (size_t i = 0; i < poses_.size(); ++i) {
    if (world != worlds_.end() && world->first == i) {
      const int keyframe = poses_[i].keyframe;
      if (!loops_.map().graph.AreConnected(0, keyframe)) stream << FormatTumRestart(world->second);
      ++world;
    }
    stream << FormatTumRow(poses_[i].t_ns, PoseInMap(loops_.map(), poses_[i]));
  }
  if (!stream) throw std::runtime_error("cannot write to " + folder_ + ": disk full?");
}

Json LoopResults::Summary() const {
  Json refused = Json::object();
  for (int gate = 0; gate < kLoopGates; ++gate) {
    refused[ToString(static_cast<LoopGate>(gate))] = refused_[gate];
  }
  const SeriesSummary timing = Summarize(keyframe_ms_, 0);
  Json json;
  json["keyframes"] = keyframes_;
  json["map_keyframes"] = loops_.map().CountKept();
  json["candidates"] = candidates_;
  json["accepted"] = accepted_;
  json["refused"] = refused;
  json["first_fix_s"] = first_fix_ ? Json(*first_fix_) : Json(nullptr);
  json["keyframe_ms"] = {{"mean", timing.mean}, {"p95", timing.p95}};
  return json;
}

}  // namespace plm_vins
