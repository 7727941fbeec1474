// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/map/recalibration.h"

#include <algorithm>

#include "common/camera/ray_transfer.h"

namespace plm_vins {

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

void Recalibration::Move(int camera, FrameMeasurement* measurement) const {
  for (PointObservation& point : measurement->points.points) {
    if (point.camera == camera) Move(&point.xy, &point.velocity);
  }
  if (!measurement->lines) return;
  for (LineObservation& line : measurement->lines->lines) {
    if (line.camera != camera) continue;
    Move(&line.start);
    Move(&line.end);
  }
}

void Recalibration::Move(int camera, LocalMap* map) const {
  for (auto& [id, point] : map->points.landmarks()) {
    for (PointLandmark::Observation& observation : point.observations) {
      if (observation.camera != camera) continue;
      Move(&observation.bearing.xy, &observation.bearing.velocity);
    }
  }
  const auto move_line = [this, camera](LineLandmark::Observation* observation) {
    if (observation->camera != camera) return;
    Move(&observation->segment.start);
    Move(&observation->segment.end);
  };
  for (auto& [id, line] : map->lines.landmarks()) {
    for (LineLandmark::Observation& observation : line.observations) move_line(&observation);
    for (LineLandmark::Observation& observation : line.anchor_observations) move_line(&observation);
  }
  map->memory.ChangeObservations(move_line);
}

void FollowIntrinsics(const SensorConfig& sensor, double max_error, LocalMap* map) {
  for (size_t i = 0; i < map->window.cameras.size(); ++i) {
    WindowCamera& camera = map->window.cameras[i];
    const CameraParameters& configured = sensor.cameras[i].parameters;
    const Recalibration recalibration(configured.With(camera.ray_intrinsics),
                                      configured.With(camera.intrinsics));
    if (recalibration.LargestMove() < max_error) continue;
    recalibration.Move(static_cast<int>(i), map);
    camera.ray_intrinsics = camera.intrinsics;
  }
}

}  // namespace plm_vins
