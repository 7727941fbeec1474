// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/ros/trajectory_log.h"

#include <filesystem>
#include <stdexcept>
#include <system_error>
#include <utility>

#include "common/io/output_file.h"
#include "vins_estimator/output/pose_rows.h"

namespace plm_vins {
namespace {

constexpr size_t kMaxPoses = 1'000'000;

void MakeFolderOf(const std::string& file) {
  std::error_code error;
  std::filesystem::create_directories(std::filesystem::path(file).parent_path(), error);
  if (error) throw std::runtime_error("cannot write " + file + ": " + error.message());
}

}  // namespace

std::string FullPath(const std::string& file) {
  if (file.empty()) return "";  // an error for std::filesystem
  return std::filesystem::absolute(file).lexically_normal().string();
}

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

void TrajectoryLog::CheckWritable(const std::string& file) {
  MakeFolderOf(file);
  const ReplacedFile not_committed(file);
}

size_t TrajectoryLog::Save(const std::string& file) const {
  const std::deque<Pose> poses = Poses();
  if (poses.empty()) {
    throw std::runtime_error("there is no pose to save yet; " + file + " is unchanged");
  }
  MakeFolderOf(file);
  ReplacedFile output(file);
  for (const Pose& pose : poses) {
    if (!pose.new_world.empty()) output.stream() << FormatTumRestart(pose.new_world);
    output.stream() << FormatTumRow(pose.t_ns, pose.T_W_B);
  }
  output.Commit();
  return poses.size();
}

std::deque<TrajectoryLog::Pose> TrajectoryLog::Poses() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return poses_;
}

}  // namespace plm_vins
