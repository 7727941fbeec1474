// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <unordered_map>

#include "common/measurements.h"

namespace plm_vins {

// [s]: less between two sights of a track is no interval to divide by.
constexpr double kMinTrackInterval = 0.005;

// Velocities of points for a tracker that sends none (PL-VINS): as the others do, from the places
// in this image and the one before.
class TrackVelocities {
 public:
  // Zero where the point is not in the image before, or that was long ago.
  void Fill(PointFrame* frame);

 private:
  int64_t t_ns_ = 0;  // of the image before
  std::unordered_map<int64_t, Eigen::Vector2d> places_;
};

}  // namespace plm_vins
