// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/uncertainty/rig_monitor.h"

#include <algorithm>

#include "vins_estimator/uncertainty/length_evidence.h"

namespace plm_vins {

RigMonitor::RigMonitor(const ProblemOptions& options, double focal_length)
    : focal_length_(focal_length),
      cameras_(options.cameras),
      links_(options.extrinsics_links),
      baseline_errors_(links_.size()) {
  for (size_t i = 1; i < cameras_.size(); ++i) {
    const double line_noise = cameras_[i].noise_ratio / options.line_weight;
    monitors_.emplace_back(static_cast<int>(i),
                           CameraNoise{1 / cameras_[i].point_weight, line_noise});
  }
}

void RigMonitor::DropUnfit(LocalMap* map) const {
  for (const CameraMonitor& monitor : monitors_) {
    if (monitor.misfit()) map->points.DropUntriangulated(monitor.camera());
    if (!monitor.UsesLines(map->window.newest().state.t_ns)) {
      map->lines.DropUntriangulated(monitor.camera());
    }
  }
}

DepthCounts RigMonitor::Judge(LocalMap* map) {
  DepthCounts sum;
  for (CameraMonitor& monitor : monitors_) {
    const DepthCounts counts = monitor.Judge(map->window, &map->points, &map->lines);
    sum.used += counts.used;
    sum.rejected += counts.rejected;
  }
  return sum;
}

void RigMonitor::JudgeBaselines(const SlidingWindow& window, NormalEquations* equations) {
  for (size_t i = 0; i < links_.size(); ++i) {
    if (links_[i].is_pair) baseline_errors_[i] = BaselineError(links_[i], window, equations);
  }
}

void RigMonitor::SetWeights(int64_t newest_ns, ProblemOptions* options) const {
  for (const CameraMonitor& monitor : monitors_) {
    ProblemCamera& camera = options->cameras[monitor.camera()];
    camera.point_weight = std::min(camera.point_weight, 1 / monitor.noise());
    camera.line_noise_factor = monitor.line_noise_factor(newest_ns);
  }
}

std::vector<CameraFaults> RigMonitor::Faults() const {
  std::vector<CameraFaults> faults;
  for (size_t i = 0; i < monitors_.size(); ++i) {
    const int camera = monitors_[i].camera();
    faults.push_back({camera, monitors_[i].misfit(), monitors_[i].delay(), baseline_errors_[i]});
    if (auto& misfit = faults.back().misfit_px) {
      *misfit *= focal_length_ / cameras_[camera].noise_ratio;
    }
  }
  return faults;
}

}  // namespace plm_vins
