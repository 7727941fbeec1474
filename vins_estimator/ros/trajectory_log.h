// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <deque>
#include <mutex>
#include <string>

#include "common/geometry/rigid3.h"

namespace plm_vins {

// Returns the absolute path of a file; empty if the name is empty.
std::string FullPath(const std::string& file);

// Stores the poses so far, to be saved on request: the newest million (14 hours at 20 Hz). If
// timestamps jump back, earlier poses are dropped, because time must increase in a file.
// Thread-safe: Add() does not block while another thread saves.
class TrajectoryLog {
 public:
  void Add(int64_t t_ns, const Rigid3d& T_W_B);

  // Marks the next pose as the first of a new world frame; the file states the reason in a comment.
  void BeginWorld(const std::string& reason);

  bool empty() const;

  // Creates the folder of a file that is to be saved later. Throws std::runtime_error with the
  // reason if the file could not be written.
  static void CheckWritable(const std::string& file);

  // Replaces a TUM file atomically, creating its folder if necessary. Returns the number of poses.
  // Throws std::runtime_error with the reason if there is none or the file cannot be written; an
  // existing file is then not changed.
  size_t Save(const std::string& file) const;

 private:
  struct Pose {
    int64_t t_ns = 0;
    Rigid3d T_W_B;
    std::string new_world;  // reason for a new world frame at this pose; empty: none
  };

  std::deque<Pose> Poses() const;

  mutable std::mutex mutex_;
  std::deque<Pose> poses_;
  std::string new_world_;  // for the next pose
};

}  // namespace plm_vins
