// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/ros/trajectory_log.h"

#include <fstream>
#include <stdexcept>

#include "vins_estimator/output/tum_format.h"

namespace plm_vins {
namespace {

constexpr size_t kMaxPoses = 1'000'000;

}  // namespace

void TrajectoryLog::Add(int64_t t_ns, const Rigid3d& T_W_B) {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (poses_.size() == kMaxPoses) poses_.pop_front();
  poses_.emplace_back(t_ns, T_W_B);
}

void TrajectoryLog::Clear() {
  const std::lock_guard<std::mutex> lock(mutex_);
  poses_.clear();
}

size_t TrajectoryLog::Save(const std::string& file) const {
  const std::lock_guard<std::mutex> lock(mutex_);
  std::ofstream stream(file);
  for (const auto& [t_ns, T_W_B] : poses_) stream << FormatTumRow(t_ns, T_W_B);
  stream.close();
  if (!stream) throw std::runtime_error("cannot write " + file);
  return poses_.size();
}

}  // namespace plm_vins
