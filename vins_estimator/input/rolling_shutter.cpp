// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/input/rolling_shutter.h"

#include <utility>

#include "common/camera/readout_share.h"
#include "common/features/feature_checks.h"
#include "vins_estimator/input/track_velocities.h"

namespace plm_vins {
namespace {

// Returns the mean angular rate in B from the last sample at or before `from_ns`, to the last
// sample.
Eigen::Vector3d MeanRate(const std::vector<ImuSample>& imu, int64_t from_ns) {
  Eigen::Vector3d turn = Eigen::Vector3d::Zero();
  size_t first = imu.size() - 1;
  do {
    const ImuSample &a = imu[first - 1], &b = imu[first];
    turn += ToSeconds(b.t_ns - a.t_ns) * 0.5 * (a.gyro + b.gyro);
    --first;
  } while (first > 0 && imu[first].t_ns > from_ns);
  const double duration = ToSeconds(imu.back().t_ns - imu[first].t_ns);
  return duration > 0 ? Eigen::Vector3d(turn / duration) : imu.back().gyro;
}

// Returns the angular rate at the image minus its mean since the previous image. The rate at the
// image is averaged over the half of the readout that the samples cover, because a single sample is
// dominated by vibration.
Eigen::Vector3d RateChange(const std::vector<ImuSample>& imu, double readout) {
  if (imu.size() < 2) return Eigen::Vector3d::Zero();
  return MeanRate(imu, imu.back().t_ns - ToNanoseconds(readout / 2)) -
         MeanRate(imu, imu.front().t_ns);
}

// Returns the image velocity of a static point due to rotation of the camera.
Eigen::Vector2d RotationalFlow(const Eigen::Vector2d& xy, const Eigen::Vector3d& rate_C) {
  const Eigen::Vector3d change = xy.homogeneous().cross(rate_C);
  return change.head<2>() - xy * change.z();
}

// Returns the point of the line nearest to `xy`.
Eigen::Vector2d FootOnLine(const LineObservation& line, const Eigen::Vector2d& xy) {
  const Eigen::Vector2d along = (line.end - line.start).normalized();
  return line.start + along.dot(xy - line.start) * along;
}

}  // namespace

FrameMeasurement RollingShutter::ToStamp(FrameMeasurement measurement,
                                         const Eigen::Quaterniond& R_B_C, double readout) {
  const Motion motion{ToSeconds(measurement.t_ns - t_ns_), readout,
                      R_B_C.conjugate() * RateChange(measurement.imu, readout)};
  MovePoints(motion, &measurement.points.points);
  if (measurement.lines) {
    MoveLines(motion, &measurement.lines->lines);
  } else {
    lines_.clear();
  }
  t_ns_ = measurement.t_ns;
  return measurement;
}

void RollingShutter::MovePoints(const Motion& motion, std::vector<PointObservation>* points) {
  std::unordered_map<int64_t, TimedPosition> positions;
  std::vector<PointObservation> moved;
  moved.reserve(points->size());
  for (PointObservation& point : *points) {
    const TimedPosition now = TimedPositionOf(point);
    positions.emplace(point.id, now);
    const auto before = points_.find(point.id);
    if (before == points_.end()) continue;
    const auto velocity = Velocity(motion, before->second, now);
    if (!velocity) continue;
    point.velocity = *velocity;
    point.xy -= now.share * motion.readout * *velocity;
    if (point.right) *point.right -= now.share * motion.readout * *velocity;  // nearly the same row
    moved.push_back(point);
  }
  points_ = std::move(positions);
  *points = std::move(moved);
}

void RollingShutter::MoveLines(const Motion& motion, std::vector<LineObservation>* lines) {
  std::unordered_map<int64_t, LineObservation> seen;
  std::vector<LineObservation> moved;
  moved.reserve(lines->size());
  for (const LineObservation& line : *lines) {
    seen.emplace(line.id, line);
    const auto before = lines_.find(line.id);
    if (before == lines_.end()) continue;
    const auto start = MoveEnd(motion, before->second, line.start);
    const auto end = MoveEnd(motion, before->second, line.end);
    if (!start || !end) continue;
    LineObservation& at_stamp = moved.emplace_back(line);
    at_stamp.start = *start;
    at_stamp.end = *end;
    if (!line.right) continue;
    at_stamp.right->start += *start - line.start;
    at_stamp.right->end += *end - line.end;
  }
  lines_ = std::move(seen);
  *lines = std::move(moved);
}

RollingShutter::TimedPosition RollingShutter::TimedPositionOf(const PointObservation& point) const {
  return {point.xy, ReadoutShare(point.uv_px.y(), camera_->parameters().height)};
}

std::optional<RollingShutter::TimedPosition> RollingShutter::TimedPositionOf(
    const Eigen::Vector2d& xy) const {
  const auto pixel = camera_->Project(xy.homogeneous());
  if (!pixel) return std::nullopt;
  return TimedPosition{xy, ReadoutShare(pixel->y(), camera_->parameters().height)};
}

std::optional<Eigen::Vector2d> RollingShutter::MoveEnd(const Motion& motion,
                                                       const LineObservation& before,
                                                       const Eigen::Vector2d& end) const {
  const auto now = TimedPositionOf(end), foot = TimedPositionOf(FootOnLine(before, end));
  if (!now || !foot) return std::nullopt;
  const auto velocity = Velocity(motion, *foot, *now);
  if (!velocity) return std::nullopt;
  return end - now->share * motion.readout * *velocity;
}

std::optional<Eigen::Vector2d> RollingShutter::Velocity(const Motion& motion,
                                                        const TimedPosition& before,
                                                        const TimedPosition& now) {
  const double interval = motion.interval + motion.readout * (now.share - before.share);
  if (interval < kMinTrackInterval) return std::nullopt;
  const Eigen::Vector2d velocity =
      (now.xy - before.xy) / interval + RotationalFlow(now.xy, motion.rate_change_C);
  if (!IsWithin(velocity, kMaxImageVelocity)) return std::nullopt;
  return velocity;
}

}  // namespace plm_vins
