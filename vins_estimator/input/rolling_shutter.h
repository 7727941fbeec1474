// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstdint>
#include <memory>
#include <optional>
#include <unordered_map>
#include <vector>

#include "common/camera/camera_model.h"
#include "common/config/sensor_config.h"
#include "common/measurements.h"

namespace plm_vins {

// Corrects the features of a rolling-shutter camera, row by row, to the time of the image's
// timestamp, which is that of the middle row: x(stamp) = x(row) - share * readout * v, with the
// row's share of the readout (ReadoutShare()) and the velocity v in the image. v is the motion of
// the track since the previous image, corrected by the gyroscope for the change of angular rate
// since then. For a line's end only the velocity across the line is observable and relevant; it is
// computed from the end's distance to the line in the previous image.
//
// Features that are new in an image have no velocity and are dropped: they would be off by pixels.
// If a camera with a lower number observes the same landmark in nearly the same row, a feature has
// the velocity of that observation.
class RollingShutter {
 public:
  explicit RollingShutter(const std::vector<CameraSensor>& cameras);

  // Returns the measurement that a global shutter would have given at the timestamp, with the
  // velocities of its points. `R_B_C` are the current estimates by camera, `readout` the time from
  // the first row to the last [s].
  FrameMeasurement ToStamp(FrameMeasurement measurement,
                           const std::vector<Eigen::Quaterniond>& R_B_C, double readout);

 private:
  // Position in an image, normalized and undistorted, and its time as a share of the readout.
  struct TimedPosition {
    Eigen::Vector2d xy;
    double share;
  };
  // Quantities common to all features of an image.
  struct Motion {
    const CameraModel* camera;
    double interval;                // between the timestamps of the previous image and this one [s]
    double readout;                 // [s]
    Eigen::Vector3d rate_change_C;  // angular rate now minus its mean over the interval [rad/s]
  };

  void MovePoints(const std::vector<Motion>& motions, std::vector<PointObservation>* points);
  void MoveLines(const std::vector<Motion>& motions, std::vector<LineObservation>* lines);
  static TimedPosition TimedPositionOf(const CameraModel& camera, const PointObservation& point);
  // Returns nullopt outside the camera model's range.
  static std::optional<TimedPosition> TimedPositionOf(const CameraModel& camera,
                                                      const Eigen::Vector2d& xy);
  // Moves an end of a line to the timestamp; `before` is the line in the previous image.
  static std::optional<Eigen::Vector2d> MoveEnd(const Motion& motion, const LineObservation& before,
                                                const Eigen::Vector2d& end);
  static std::optional<Eigen::Vector2d> Velocity(const Motion& motion, const TimedPosition& before,
                                                 const TimedPosition& now);

  std::vector<std::shared_ptr<const CameraModel>> cameras_;
  // Previous frame, as observed; by TrackKey().
  int64_t t_ns_ = 0;
  std::unordered_map<int64_t, TimedPosition> points_;
  std::unordered_map<int64_t, LineObservation> lines_;
};

}  // namespace plm_vins
