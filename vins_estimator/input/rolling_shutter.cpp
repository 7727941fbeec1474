// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/input/rolling_shutter.h"

#include <utility>

#include "common/camera/camera_model.h"
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

RollingShutter::RollingShutter(const std::vector<CameraSensor>& cameras) {
  for (const CameraSensor& camera : cameras) {
    cameras_.push_back(CameraModel::Create(camera.parameters));
  }
}

FrameMeasurement RollingShutter::ToStamp(FrameMeasurement measurement,
                                         const std::vector<Eigen::Quaterniond>& R_B_C,
                                         double readout) {
  const double interval = ToSeconds(measurement.t_ns - t_ns_);
  const Eigen::Vector3d rate_change_B = RateChange(measurement.imu, readout);
  std::vector<Motion> motions;
  for (size_t i = 0; i < cameras_.size(); ++i) {
    motions.push_back({cameras_[i].get(), interval, readout, R_B_C[i].conjugate() * rate_change_B});
  }
  MovePoints(motions, &measurement.points.points);
  if (measurement.lines) {
    MoveLines(motions, &measurement.lines->lines);
  } else {
    lines_.clear();
  }
  t_ns_ = measurement.t_ns;
  return measurement;
}

void RollingShutter::MovePoints(const std::vector<Motion>& motions,
                                std::vector<PointObservation>* points) {
  std::unordered_map<int64_t, TimedPosition> positions;
  std::unordered_map<int64_t, Eigen::Vector2d> velocities;  // by id
  std::vector<PointObservation> moved;
  moved.reserve(points->size());
  for (PointObservation& point : *points) {
    const Motion& motion = motions[point.camera];
    const TimedPosition now = TimedPositionOf(*motion.camera, point);
    positions.emplace(TrackKey(point), now);
    const auto before = points_.find(TrackKey(point));
    if (before != points_.end()) {
      const auto velocity = Velocity(motion, before->second, now);
      if (velocity) velocities.emplace(point.id, *velocity);
      if (!velocity) continue;
      point.velocity = *velocity;
    } else if (const auto other = velocities.find(point.id); other != velocities.end()) {
      point.velocity = other->second;
    } else {
      continue;
    }
    point.xy -= now.share * motion.readout * point.velocity;
    moved.push_back(point);
  }
  points_ = std::move(positions);
  *points = std::move(moved);
}

void RollingShutter::MoveLines(const std::vector<Motion>& motions,
                               std::vector<LineObservation>* lines) {
  struct Shift {
    Eigen::Vector2d start, end;
  };
  std::unordered_map<int64_t, LineObservation> seen;
  std::unordered_map<int64_t, Shift> shifts;  // by id
  std::vector<LineObservation> moved;
  moved.reserve(lines->size());
  for (const LineObservation& line : *lines) {
    seen.emplace(TrackKey(line), line);
    const auto before = lines_.find(TrackKey(line));
    if (before != lines_.end()) {
      const auto start = MoveEnd(motions[line.camera], before->second, line.start);
      const auto end = MoveEnd(motions[line.camera], before->second, line.end);
      if (!start || !end) continue;
      moved.push_back(line);
      moved.back().start = *start;
      moved.back().end = *end;
      shifts.emplace(line.id, Shift{*start - line.start, *end - line.end});
    } else if (const auto other = shifts.find(line.id); other != shifts.end()) {
      moved.push_back(line);
      moved.back().start += other->second.start;
      moved.back().end += other->second.end;
    }
  }
  lines_ = std::move(seen);
  *lines = std::move(moved);
}

RollingShutter::TimedPosition RollingShutter::TimedPositionOf(const CameraModel& camera,
                                                              const PointObservation& point) {
  return {point.xy, ReadoutShare(point.uv_px.y(), camera.parameters().height)};
}

std::optional<RollingShutter::TimedPosition> RollingShutter::TimedPositionOf(
    const CameraModel& camera, const Eigen::Vector2d& xy) {
  const auto pixel = camera.Project(xy.homogeneous());
  if (!pixel) return std::nullopt;
  return TimedPosition{xy, ReadoutShare(pixel->y(), camera.parameters().height)};
}

std::optional<Eigen::Vector2d> RollingShutter::MoveEnd(const Motion& motion,
                                                       const LineObservation& before,
                                                       const Eigen::Vector2d& end) {
  const auto now = TimedPositionOf(*motion.camera, end);
  const auto foot = TimedPositionOf(*motion.camera, FootOnLine(before, end));
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
