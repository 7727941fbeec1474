// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/ros/trajectory_log.h"

#include <filesystem>
#include <stdexcept>
#include <system_error>
#include <utility>

#include "common/io/output_file.h"
#include "vins_estimator/output/tum_format.h"

namespace plm_vins {
namespace {

constexpr size_t kMaxPoses = 1'000'000;

}  // namespace

void TrajectoryLog::Add(int64_t t_ns, const Rigid3d& T_W_B) {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (!poses_.empty() && t_ns <= poses_.back().t_ns) poses_.clear();
  if (poses_.size() == kMaxPoses) poses_.pop_front();
  poses_.push_back({t_ns, T_W_B, std::exchange(new_world_, "")});
}

void TrajectoryLog::BeginWorld(const std::string& reason) {
  const std::lock_guard<std::mutex> lock(mutex_);
  new_world_ = reason;
}

bool TrajectoryLog::empty() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return poses_.empty();
}

size_t TrajectoryLog::Save(const std::string& file) const {
  if (empty()) {
    throw std::runtime_error("there is no pose to save yet; " + file + " stays as it is");
  }
  std::error_code error;
  std::filesystem::create_directories(std::filesystem::path(file).parent_path(), error);
  if (error) throw std::runtime_error("cannot write " + file + ": " + error.message());
  ReplacedFile output(file);
  const size_t poses = Write(output.stream());
  output.Commit();  // waits for the disk, Add() does not
  return poses;
}

size_t TrajectoryLog::Write(std::ostream& stream) const {
  const std::lock_guard<std::mutex> lock(mutex_);
  for (const Pose& pose : poses_) {
    if (!pose.new_world.empty()) stream << FormatTumRestart(pose.new_world);
    stream << FormatTumRow(pose.t_ns, pose.T_W_B);
  }
  return poses_.size();
}

}  // namespace plm_vins
