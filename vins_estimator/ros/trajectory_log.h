// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <deque>
#include <mutex>
#include <string>
#include <utility>

#include "common/rigid3.h"

namespace plm_vins {

// The poses of the current world frame, to be saved on request. Keeps the newest million (14 hours
// at 20 Hz). For several threads.
class TrajectoryLog {
 public:
  void Add(int64_t t_ns, const Rigid3d& T_W_B);
  void Clear();

  // Writes a TUM file. Returns the number of poses; throws std::runtime_error where the file cannot
  // be written.
  size_t Save(const std::string& file) const;

 private:
  mutable std::mutex mutex_;
  std::deque<std::pair<int64_t, Rigid3d>> poses_;
};

}  // namespace plm_vins
