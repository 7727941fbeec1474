// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <deque>
#include <optional>

#include "common/geometry/rigid3.h"
#include "common/imu/imu_gate.h"
#include "common/measurements.h"
#include "common/streams/backward_jump.h"
#include "common/streams/forward_jump.h"

namespace plm_vins {

// The camera's rotation between two images from the gyro alone, to predict where features move.
// Keeps a bounded history; samples that no sensor gives, out of order, or the first after a leap in
// time are ignored, those that do not fit the others replaced (ImuGate); where all stamps go back,
// the history begins anew.
class GyroPredictor {
 public:
  // `td`: t_imu = t_image + td [s].
  GyroPredictor(const Rigid3d& T_B_C, double td, const ImuRange& imu_range = ImuRange());

  void AddImu(const ImuSample& sample);

  // True when the samples reach the time of the image.
  bool Covers(int64_t t_image_ns) const;

  // R_C1_C0: directions of the camera at t0 to the camera at t1. Nothing where the samples do not
  // cover the interval or leave a gap in it.
  std::optional<Eigen::Quaterniond> Rotation(int64_t t0_ns, int64_t t1_ns) const;

 private:
  void Clear();

  Eigen::Quaterniond R_B_C_;
  int64_t td_ns_;
  std::deque<ImuSample> samples_;
  std::optional<int64_t> last_ns_;  // of the newest sample that went to the gate
  ImuGate gate_;
  ForwardJumpDetector leap_;
  BackwardJumpDetector jump_;
};

}  // namespace plm_vins
