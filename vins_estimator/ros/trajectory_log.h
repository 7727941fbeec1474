// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <deque>
#include <mutex>
#include <string>

#include "common/geometry/rigid3.h"

namespace plm_vins {

// A file's path from the root on; empty where the name is.
std::string FullPath(const std::string& file);

// The poses so far, to be saved on request. Keeps the newest million (14 hours at 20 Hz), and none
// from before their stamps jumped back: time runs forward in a file. For several threads: Add()
// does not wait while another one saves.
class TrajectoryLog {
 public:
  void Add(int64_t t_ns, const Rigid3d& T_W_B);

  // The next pose is in another world frame than those before: a comment in the file says why.
  void BeginWorld(const std::string& reason);

  bool empty() const;

  // Makes the folder of a file that is to be saved later. Throws std::runtime_error, which says
  // why, where it could not be written.
  static void CheckWritable(const std::string& file);

  // Replaces a TUM file in one step, and makes its folder where it is missing. Returns the number
  // of poses; throws std::runtime_error, which says why, where there is none or the file cannot be
  // written. It stays as it was then.
  size_t Save(const std::string& file) const;

 private:
  struct Pose {
    int64_t t_ns = 0;
    Rigid3d T_W_B;
    std::string new_world;  // why its world frame is a new one; empty: it is not
  };

  std::deque<Pose> Poses() const;

  mutable std::mutex mutex_;
  std::deque<Pose> poses_;
  std::string new_world_;  // of the next pose
};

}  // namespace plm_vins
