// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <unordered_map>

#include "common/measurements.h"

namespace plm_vins {

// Shorter intervals are not used to compute velocities [s].
constexpr double kMinTrackInterval = 0.005;

// Computes point velocities for trackers that send none (PL-VINS), as other trackers do: from the
// positions in this image and the previous one.
class TrackVelocities {
 public:
  // Sets the velocities; zero if the point is not in the previous image, or that image is too old.
  void Fill(PointFrame* frame);

 private:
  int64_t t_ns_ = 0;  // time of the previous image
  std::unordered_map<int64_t, Eigen::Vector2d> places_;
};

}  // namespace plm_vins
