// SPDX-License-Identifier: BSD-3-Clause
// Flights along given poses in a room of points, which the simulator's trajectories do not cover.
#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "common/camera/camera_model.h"
#include "common/geometry/so3.h"
#include "simulator/default_sensors.h"
#include "simulator/random.h"
#include "simulator/trajectory.h"
#include "test/vins_estimator/initialization/simulated_frames.h"

namespace plm_vins::testing {

struct FlightPlan {
  std::function<Rigid3d(double t)> T_W_V;      // vehicle pose, x forward, z up; smooth
  double duration = 10;                        // [s]
  Eigen::Vector3d room{10, 8, 4};              // size [m], with the floor's center at the origin
  std::vector<Eigen::Vector3d> points_W = {};  // instead of points at the walls of the room
  double nearest = 0.3;                        // depth of a point that is seen [m]
  double min_dist_px = 0;                      // between points of an image
  double corner_noise_px = 0.15;
  double imu_noise = 1;  // factor of the configured noise
};

// Rises from 0 to 1 between two times, with continuous velocity and acceleration.
inline double SmoothStep(double t, double begin, double end) {
  const double u = std::clamp((t - begin) / (end - begin), 0.0, 1.0);
  return u * u * u * (10 + u * (-15 + 6 * u));
}

// Oscillation by about a meter on all axes between two times, with a smooth start and end of two
// seconds each; standstill before and after.
inline Rigid3d GentleFlight(double t, double begin, double end) {
  const double share = SmoothStep(t, begin, begin + 2) * (1 - SmoothStep(t, end - 2, end));
  const double s = t - begin;
  const Eigen::Vector3d p_W(1.0 * std::sin(0.9 * s), 0.8 * std::sin(1.3 * s + 0.5),
                            0.4 * std::sin(1.7 * s));
  const Eigen::Quaterniond R_W_V = SO3Exp(share * Eigen::Vector3d(0, 0, 0.4 * std::sin(0.7 * s))) *
                                   SO3Exp(share * Eigen::Vector3d(0, 0.2 * std::sin(1.1 * s), 0));
  return {R_W_V, Eigen::Vector3d(0, 0, 1.5) + share * p_W};
}

// A gentle flight that begins after a second and has not ended at `duration` [s].
inline FlightPlan GentlePlan(double duration) {
  FlightPlan plan;
  plan.duration = duration;
  plan.T_W_V = [](double t) { return GentleFlight(t, 1, 100); };
  return plan;
}

// Simulates images at 20 Hz and the IMU at 200 Hz.
class PlannedFlight {
 public:
  explicit PlannedFlight(const FlightPlan& plan)
      : plan_(plan),
        sensor_(simulator::DefaultSensors()),
        camera_(CameraModel::Create(sensor_.cameras[0].parameters)),
        R_V_B_(simulator::ForwardLookingBody(sensor_.cameras[0].T_B_C)),
        points_W_(plan.points_W) {
    if (!points_W_.empty()) return;
    for (int i = 0; i < 1500; ++i) {
      Eigen::Vector3d p(random_.Uniform(-1, 1), random_.Uniform(-1, 1), random_.Uniform(-1, 1));
      p[i % 3] = (i % 2 == 0 ? 1 : -1) * random_.Uniform(0.85, 1);
      points_W_.push_back(0.5 * plan.room.cwiseProduct(p + Eigen::Vector3d::UnitZ()));
    }
  }

  SimulatedFlight Simulate() {
    SimulatedFlight flight;
    flight.sensor = sensor_;
    const int images = static_cast<int>(plan_.duration / kImageInterval);
    for (int i = 1; i <= images; ++i) {
      FrameMeasurement frame;
      frame.t_ns = Stamp(i * kSamplesPerImage);
      for (int k = i > 1 ? (i - 1) * kSamplesPerImage : i * kSamplesPerImage;
           k <= i * kSamplesPerImage; ++k) {
        frame.imu.push_back(SampleAt(k));
      }
      frame.points = PointsAt(i * kImageInterval, frame.t_ns);
      flight.frames.push_back(frame);
      flight.truth.push_back(StateAt(i * kImageInterval, frame.t_ns));
    }
    return flight;
  }

 private:
  static constexpr double kSampleInterval = 0.005;
  static constexpr int kSamplesPerImage = 10;
  static constexpr double kImageInterval = kSamplesPerImage * kSampleInterval;
  static constexpr double kStep = 1e-3;  // of numeric derivatives [s]
  static constexpr size_t kMaxPoints = 100;

  static int64_t Stamp(int sample) { return 1'000'000'000'000 + sample * 5'000'000LL; }

  Rigid3d BodyAt(double t) const {
    const Rigid3d T_W_V = plan_.T_W_V(t);
    return {(T_W_V.rotation * R_V_B_).normalized(), T_W_V.translation};
  }

  FrameState StateAt(double t, int64_t t_ns) const {
    FrameState state;
    state.t_ns = t_ns;
    state.SetPose(BodyAt(t));
    state.velocity() =
        (BodyAt(t + kStep).translation - BodyAt(t - kStep).translation) / (2 * kStep);
    return state;
  }

  // Cached, so that repeated calls return the same noise.
  ImuSample SampleAt(int index) {
    const auto known = samples_.find(index);
    if (known != samples_.end()) return known->second;
    const double t = index * kSampleInterval;
    const Rigid3d before = BodyAt(t - kStep), now = BodyAt(t), after = BodyAt(t + kStep);
    const Eigen::Vector3d a_W =
        (after.translation - 2 * now.translation + before.translation) / (kStep * kStep);
    const double share = plan_.imu_noise / std::sqrt(kSampleInterval);
    ImuSample sample;
    sample.t_ns = Stamp(index);
    sample.gyro = SO3Log(before.rotation.conjugate() * after.rotation) / (2 * kStep) +
                  share * sensor_.imu_noise.gyro_density * random_.NormalVector3();
    sample.accel = now.rotation.conjugate() * (a_W + Eigen::Vector3d(0, 0, sensor_.gravity_norm)) +
                   share * sensor_.imu_noise.accel_density * random_.NormalVector3();
    return samples_[index] = sample;
  }

  std::optional<Eigen::Vector2d> Project(const Eigen::Vector3d& p_C) const {
    if (p_C.z() < plan_.nearest) return std::nullopt;
    auto uv_px = camera_->Project(p_C);
    if (!uv_px || !camera_->IsInImage(*uv_px)) return std::nullopt;
    return uv_px;
  }

  bool IsCrowded(const PointFrame& frame, const Eigen::Vector2d& uv_px) const {
    return std::any_of(frame.points.begin(), frame.points.end(), [&](const auto& point) {
      return (point.uv_px - uv_px).norm() < plan_.min_dist_px;
    });
  }

  // Tracked points come first; points that left the image get new ids.
  PointFrame PointsAt(double t, int64_t t_ns) {
    const Rigid3d T_C_W = (BodyAt(t) * sensor_.cameras[0].T_B_C).Inverse();
    PointFrame frame;
    frame.t_ns = t_ns;
    const std::map<size_t, PointObservation> before = std::move(followed_);
    followed_.clear();
    for (const bool known : {true, false}) {
      for (size_t i = 0; i < points_W_.size() && frame.points.size() < kMaxPoints; ++i) {
        const auto last = before.find(i);
        if ((last != before.end()) != known) continue;
        const auto uv_px = Project(T_C_W * points_W_[i]);
        if (!uv_px || IsCrowded(frame, *uv_px)) continue;
        PointObservation point;
        point.uv_px =
            *uv_px + plan_.corner_noise_px * Eigen::Vector2d(random_.Normal(), random_.Normal());
        const auto xy = camera_->Unproject(point.uv_px);
        if (!xy) continue;
        point.id = known ? last->second.id : next_id_++;
        point.xy = *xy;
        if (known) point.velocity = (*xy - last->second.xy) / kImageInterval;
        followed_[i] = point;
        frame.points.push_back(point);
      }
    }
    return frame;
  }

  const FlightPlan plan_;
  const SensorConfig sensor_;
  const std::unique_ptr<const CameraModel> camera_;
  const Eigen::Quaterniond R_V_B_;
  simulator::Random random_{7};
  std::vector<Eigen::Vector3d> points_W_;
  std::map<int, ImuSample> samples_;
  std::map<size_t, PointObservation> followed_;  // by index of the point
  int64_t next_id_ = 0;
};

}  // namespace plm_vins::testing
