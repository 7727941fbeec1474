// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "common/io/output_file.h"
#include "vins_estimator/state/estimator_output.h"

namespace plm_vins {

// trajectory.tum and covariance.csv, written as poses come. Time runs forward in a file: where
// stamps jump back, both begin anew, as the estimator node's TrajectoryLog does. What cannot be
// written throws as OutputFile does.
class PoseFiles {
 public:
  explicit PoseFiles(const std::string& folder);

  void Add(int64_t t_ns, const Rigid3d& T_W_B, const Matrix6d& covariance);

  // The next pose is in another world frame than those before: a comment says why.
  void BeginWorld(const std::string& reason);

  void Finish();

  int64_t forgotten() const { return forgotten_; }  // poses from before stamps jumped back

 private:
  void BeginAnew();

  std::string trajectory_path_, covariance_path_;
  OutputFile trajectory_, covariance_;
  std::string comments_;  // before the next pose
  std::optional<int64_t> last_ns_;
  int64_t poses_ = 0;  // in the files
  int64_t forgotten_ = 0;
};

}  // namespace plm_vins
