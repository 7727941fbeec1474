// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/input/track_velocities.h"

#include <utility>

#include "common/features/feature_checks.h"

namespace plm_vins {
namespace {

constexpr double kMaxInterval = 1.0;  // [s] between images: longer, the mean is no current velocity

}  // namespace

void TrackVelocities::Fill(PointFrame* frame) {
  const double interval = ToSeconds(frame->t_ns - t_ns_);
  const bool follows = interval >= kMinTrackInterval && interval <= kMaxInterval;
  std::unordered_map<int64_t, Eigen::Vector2d> places;
  for (PointObservation& point : frame->points) {
    const auto before = places_.find(point.id);
    point.velocity.setZero();
    if (follows && before != places_.end()) {
      const Eigen::Vector2d velocity = (point.xy - before->second) / interval;
      if (IsWithin(velocity, kMaxImageVelocity)) point.velocity = velocity;
    }
    places[point.id] = point.xy;
  }
  places_ = std::move(places);
  t_ns_ = frame->t_ns;
}

}  // namespace plm_vins
