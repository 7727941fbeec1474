// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/map/recalibration.h"

#include <algorithm>

#include "common/camera/ray_transfer.h"

namespace plm_vins {
namespace {

// Calls `change_point` and `change_line` with each observation of the map's landmarks.
template <typename ChangePoint, typename ChangeLine>
void ChangeViews(const ChangePoint& change_point, const ChangeLine& change_line, LocalMap* map) {
  for (auto& [id, point] : map->points.landmarks()) {
    for (PointView& view : point.views) change_point(&view);
  }
  for (auto& [id, line] : map->lines.landmarks()) {
    for (LineView& view : line.views) change_line(&view);
    for (LineView& view : line.anchor_views) change_line(&view);
  }
  map->memory.ChangeViews(change_line);
}

}  // namespace

double Recalibration::LargestMove() const {
  constexpr int kSteps = 4;
  const CameraParameters& camera = from_->parameters();
  double largest = 0;
  for (int row = 0; row <= kSteps; ++row) {
    for (int col = 0; col <= kSteps; ++col) {
      const Eigen::Vector2d pixel(col * camera.width / kSteps, row * camera.height / kSteps);
      const auto from = from_->Unproject(pixel);
      const auto to = to_->Unproject(pixel);
      if (from && to) largest = std::max(largest, (*to - *from).norm());
    }
  }
  return largest;
}

void Recalibration::Move(Eigen::Vector2d* xy) const { TransferRay(*from_, *to_, xy); }

void Recalibration::Move(Eigen::Vector2d* xy, Eigen::Vector2d* velocity) const {
  TransferRay(*from_, *to_, xy, velocity);
}

void Recalibration::Move(FrameMeasurement* measurement) const {
  for (PointObservation& point : measurement->points.points) Move(&point.xy, &point.velocity);
  if (!measurement->lines) return;
  for (LineObservation& line : measurement->lines->lines) {
    Move(&line.start);
    Move(&line.end);
  }
}

void Recalibration::Move(LineView* view) const {
  Move(&view->segment.start);
  Move(&view->segment.end);
}

void Recalibration::Move(LocalMap* map) const {
  ChangeViews([this](PointView* view) { Move(&view->bearing.xy, &view->bearing.velocity); },
              [this](LineView* view) { Move(view); }, map);
}

void Recalibration::MoveRight(std::optional<RightSegment>* segment) const {
  if (!*segment) return;
  Move(&(*segment)->start);
  Move(&(*segment)->end);
}

void Recalibration::MoveRight(FrameMeasurement* measurement) const {
  for (PointObservation& point : measurement->points.points) {
    if (point.right) Move(&*point.right);
  }
  if (!measurement->lines) return;
  for (LineObservation& line : measurement->lines->lines) MoveRight(&line.right);
}

void Recalibration::MoveRight(LocalMap* map) const {
  ChangeViews(
      [this](PointView* view) {
        if (view->right) Move(&*view->right);
      },
      [this](LineView* view) { MoveRight(&view->right); }, map);
}

void FollowIntrinsics(const SensorConfig& sensor, double max_error, LocalMap* map) {
  SlidingWindow& window = map->window;
  const CameraParameters& camera = sensor.cameras[0].parameters;
  const Recalibration first(camera.With(window.ray_intrinsics), camera.With(window.intrinsics));
  if (first.LargestMove() >= max_error) {
    first.Move(map);
    window.ray_intrinsics = window.intrinsics;
  }
  if (sensor.cameras.size() == 1) return;
  const CameraParameters& right = sensor.cameras[1].parameters;
  const Recalibration second(right.With(window.right_ray_intrinsics),
                             right.With(window.right_intrinsics));
  if (second.LargestMove() >= max_error) {
    second.MoveRight(map);
    window.right_ray_intrinsics = window.right_intrinsics;
  }
}

}  // namespace plm_vins
