// SPDX-License-Identifier: BSD-3-Clause
#include "offline/results/pose_files.h"

#include <filesystem>
#include <utility>

#include "vins_estimator/output/covariance_table.h"
#include "vins_estimator/output/tum_format.h"

namespace plm_vins {

PoseFiles::PoseFiles(const std::string& folder)
    : trajectory_path_(std::filesystem::path(folder) / "trajectory.tum"),
      covariance_path_(std::filesystem::path(folder) / "covariance.csv"),
      trajectory_(trajectory_path_),
      covariance_(covariance_path_) {
  WriteCovarianceHeader(&covariance_.stream());
}

void PoseFiles::Add(int64_t t_ns, const Rigid3d& T_W_B, const Matrix6d& covariance) {
  if (last_ns_ && t_ns <= *last_ns_) BeginAnew();
  last_ns_ = t_ns;
  ++poses_;
  trajectory_.stream() << std::exchange(comments_, "") << FormatTumRow(t_ns, T_W_B);
  WriteCovarianceRow(t_ns, covariance, &covariance_.stream());
}

void PoseFiles::BeginWorld(const std::string& reason) { comments_ += FormatTumRestart(reason); }

void PoseFiles::BeginAnew() {
  forgotten_ += std::exchange(poses_, 0);
  trajectory_.Close();  // what is in its buffer must not come later
  covariance_.Close();
  trajectory_ = OutputFile(trajectory_path_);
  covariance_ = OutputFile(covariance_path_);
  WriteCovarianceHeader(&covariance_.stream());
}

void PoseFiles::Finish() {
  trajectory_.stream() << comments_;
  trajectory_.Close();
  covariance_.Close();
}

}  // namespace plm_vins
