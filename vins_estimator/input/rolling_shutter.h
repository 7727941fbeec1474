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
#include "common/measurements.h"

namespace plm_vins {

// Moves what a rolling shutter has seen row by row to the time of the image's stamp, that of the
// middle row: x(stamp) = x(row) - share * readout * v, with the row's share (ReadoutShare()) and
// the velocity v in the image. v is what the track has moved by since the image before, and the
// turn of the camera now where the gyro says that it has changed since. Of a line's end only the
// velocity across the line is known, and only that counts: it comes from the end's distance from
// the line in the image before.
//
// What is new in an image has no velocity and is left out: it would be off by pixels.
class RollingShutter {
 public:
  explicit RollingShutter(const CameraParameters& camera) : camera_(CameraModel::Create(camera)) {}

  // The measurement as a global shutter at its stamp would have given it, with the velocities of
  // its points. `R_B_C` as known so far; `readout`: time from the first row to the last [s].
  FrameMeasurement ToStamp(FrameMeasurement measurement, const Eigen::Quaterniond& R_B_C,
                           double readout);

 private:
  // A place in an image, normalised and undistorted, and when in the read-out it was seen.
  struct Sight {
    Eigen::Vector2d xy;
    double share;
  };
  // What an image has in common.
  struct Motion {
    double interval;                // since the image before, from stamp to stamp [s]
    double readout;                 // [s]
    Eigen::Vector3d rate_change_C;  // angular rate now less its mean over the interval [rad/s]
  };

  void MovePoints(const Motion& motion, std::vector<PointObservation>* points);
  void MoveLines(const Motion& motion, std::vector<LineObservation>* lines);
  Sight SightOf(const PointObservation& point) const;
  // Nothing where the camera has no pixel for it.
  std::optional<Sight> SightOf(const Eigen::Vector2d& xy) const;
  // An end of a line, moved to the stamp; `before` is the line in the image before.
  std::optional<Eigen::Vector2d> MoveEnd(const Motion& motion, const LineObservation& before,
                                         const Eigen::Vector2d& end) const;
  static std::optional<Eigen::Vector2d> Velocity(const Motion& motion, const Sight& before,
                                                 const Sight& now);

  std::shared_ptr<const CameraModel> camera_;
  // Of the image before, as it was seen.
  int64_t t_ns_ = 0;
  std::unordered_map<int64_t, Sight> points_;
  std::unordered_map<int64_t, LineObservation> lines_;
};

}  // namespace plm_vins
