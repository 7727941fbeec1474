// SPDX-License-Identifier: BSD-3-Clause
#include "test/feature_simulator/feature_simulator.h"

#include <cmath>
#include <memory>
#include <optional>

#include "common/camera/camera_model.h"
#include "simulator/random.h"
#include "test/feature_simulator/track_selector.h"

namespace plm_vins::simulator {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kNearest = 0.2;  // [m]; closer landmarks are invisible

// Independent random streams derived from one seed.
enum Stream : uint64_t {
  kWorld,
  kImu,
  kPointTracks,
  kLineTracks,
  kPointNoise,
  kLineNoise,
  kSecondNoise,
  kDepthNoise
};

uint64_t StreamSeed(uint64_t seed, Stream stream) { return seed * 64 + stream; }

TrajectoryOptions WithForwardCamera(const FeatureSimulationOptions& options) {
  TrajectoryOptions trajectory = options.trajectory;
  trajectory.R_V_B = ForwardLookingBody(options.sensors.cameras[0].T_B_C);
  return trajectory;
}

ImuSimulationOptions ImuOptions(const FeatureSimulationOptions& options) {
  ImuSimulationOptions imu;
  imu.noise = options.sensors.imu_noise;
  imu.add_noise = options.add_imu_noise;
  imu.gravity_norm = options.sensors.gravity_norm;
  imu.rate_hz = options.sensors.imu_rate;
  imu.start_ns = options.start_ns;
  imu.initial_bias = options.initial_bias;
  imu.seed = StreamSeed(options.seed, kImu);
  return imu;
}

// Simulates the front ends during the flight; each Expose() adds one image to the dataset.
class FeatureCamera {
 public:
  FeatureCamera(const FeatureSimulationOptions& options, FeatureDataset* dataset)
      : options_(options),
        dataset_(dataset),
        camera_(CameraModel::Create(options.sensors.cameras[0].parameters)),
        point_tracks_(options.max_points, options.point_break_probability,
                      StreamSeed(options.seed, kPointTracks)),
        line_tracks_(options.max_lines, options.line_break_probability,
                     StreamSeed(options.seed, kLineTracks)),
        point_random_(StreamSeed(options.seed, kPointNoise)),
        line_random_(StreamSeed(options.seed, kLineNoise)),
        second_random_(StreamSeed(options.seed, kSecondNoise)),
        depth_random_(StreamSeed(options.seed, kDepthNoise)) {
    const std::vector<CameraSensor>& cameras = options.sensors.cameras;
    if (cameras.size() > 1) second_camera_ = CameraModel::Create(cameras[1].parameters);
  }

  // Adds the image with timestamp `t_ns`, exposed `time` seconds after the start.
  void Expose(int64_t t_ns, const Trajectory& trajectory, double time) {
    const double readout = options_.sensors.ReadoutTime();
    const int height = options_.sensors.cameras[0].parameters.height;
    T_C_W_.resize(readout > 0 ? height : 1);
    for (size_t row = 0; row < T_C_W_.size(); ++row) {
      const double delay = readout * ReadoutShare(static_cast<double>(row), height);
      T_C_W_[row] =
          (trajectory.At(time + delay).T_W_B * options_.sensors.cameras[0].T_B_C).Inverse();
    }
    dataset_->points.push_back(ObservePoints(t_ns));
    dataset_->lines.push_back(ObserveLines(t_ns));
  }

  const TrackSelector& point_tracks() const { return point_tracks_; }
  const TrackSelector& line_tracks() const { return line_tracks_; }

 private:
  // Returns the raw pixel of a point of W, or nullopt if it is not visible. Iterates to find the
  // camera pose at the readout of the pixel's row.
  std::optional<Vector2d> Project(const Vector3d& p_W) const {
    constexpr int kRollingIterations = 4;
    const int rows = static_cast<int>(T_C_W_.size());
    auto pixel = ProjectFrom(T_C_W_[rows / 2], p_W);
    for (int i = 1; rows > 1 && pixel && i < kRollingIterations; ++i) {
      pixel = ProjectFrom(RowAt(*pixel), p_W);
    }
    return pixel;
  }

  // The camera's pose when it reads the row of a pixel.
  const Rigid3d& RowAt(const Vector2d& pixel) const {
    return T_C_W_[T_C_W_.size() > 1 ? std::lround(pixel.y()) : 0];
  }

  std::optional<Vector2d> ProjectFrom(const Rigid3d& T_C_W, const Vector3d& p_W) const {
    return ProjectTo(*camera_, T_C_W * p_W);
  }

  static std::optional<Vector2d> ProjectTo(const CameraModel& camera, const Vector3d& p_C) {
    if (p_C.z() < kNearest) return std::nullopt;
    auto pixel = camera.Project(p_C);
    if (!pixel || !camera.IsInImage(*pixel)) return std::nullopt;
    // Outside the field of view, a distortion polynomial may fold back into the image.
    const auto xy = camera.Unproject(*pixel);
    if (!xy || (*xy - p_C.head<2>() / p_C.z()).norm() > 1e-4) return std::nullopt;
    return pixel;
  }

  PointFrame ObservePoints(int64_t t_ns) {
    std::map<int, Vector2d> pixels;
    std::vector<int> visible;
    for (size_t i = 0; i < dataset_->world.points.size(); ++i) {
      const auto pixel = Project(dataset_->world.points[i]);
      if (!pixel) continue;
      pixels[static_cast<int>(i)] = *pixel;
      visible.push_back(static_cast<int>(i));
    }
    PointFrame frame;
    frame.t_ns = t_ns;
    for (const auto& track : point_tracks_.Update(visible)) {
      PointObservation observation;
      observation.id = track.id;
      observation.uv_px = Disturb(pixels.at(track.landmark));
      const auto xy = camera_->Unproject(observation.uv_px);
      if (!xy) continue;
      observation.xy = *xy;
      const Vector3d p_C =
          RowAt(pixels.at(track.landmark)) * dataset_->world.points[track.landmark];
      ObserveDepth(p_C, &observation);
      frame.points.push_back(observation);
      if (const auto second = ObserveInSecond(p_C)) {
        frame.points.emplace_back().id = track.id;
        frame.points.back().xy = *second;
        frame.points.back().camera = 1;
      }
    }
    FillVelocities(&frame);
    SortByCamera(&frame.points);
    return frame;
  }

  // Returns the observation in the second camera, if there is one and it sees the point.
  std::optional<Vector2d> ObserveInSecond(const Vector3d& p_C) {
    if (!second_camera_) return std::nullopt;
    const Rigid3d T_C1_C =
        options_.sensors.cameras[1].T_B_C.Inverse() * options_.sensors.cameras[0].T_B_C;
    const auto pixel = ProjectTo(*second_camera_, T_C1_C * p_C);
    if (!pixel) return std::nullopt;
    return second_camera_->Unproject(
        Disturb(*pixel, options_.second_outlier_ratio, &second_random_));
  }

  // Adds the measured depth, if there is a sensor.
  void ObserveDepth(const Vector3d& p_C, PointObservation* observation) {
    const auto& depth = options_.sensors.depth;
    if (depth && p_C.z() < depth->max) {
      observation->depth = p_C.z() + depth->noise * p_C.z() * p_C.z() * depth_random_.Normal();
    }
  }

  Vector2d Disturb(const Vector2d& pixel) {
    return Disturb(pixel, options_.point_outlier_ratio, &point_random_);
  }

  Vector2d Disturb(const Vector2d& pixel, double outlier_ratio, Random* random) {
    const double u = random->Normal(), v = random->Normal();
    if (random->Uniform() >= outlier_ratio) {
      return pixel + options_.point_noise_px * Vector2d(u, v);
    }
    const double limit = options_.outlier_px;
    const double du = random->Uniform(-limit, limit);
    const double dv = random->Uniform(-limit, limit);
    return pixel + Vector2d(du, dv);
  }

  void FillVelocities(PointFrame* frame) {
    std::map<int64_t, Vector2d> current_xy;  // by TrackKey()
    const double interval = ToSeconds(frame->t_ns - previous_t_ns_);
    for (PointObservation& point : frame->points) {
      const auto previous = previous_xy_.find(TrackKey(point));
      if (previous != previous_xy_.end()) point.velocity = (point.xy - previous->second) / interval;
      current_xy[TrackKey(point)] = point.xy;
    }
    previous_xy_ = std::move(current_xy);
    previous_t_ns_ = frame->t_ns;
  }

  struct PixelSegment {
    Vector2d start, end;
  };

  // Returns the longest visible piece of a line, between its first and last visible samples.
  std::optional<PixelSegment> ProjectLine(const LineSegment3d& line) const {
    constexpr int kSamples = 50;
    std::optional<PixelSegment> longest, piece;
    for (int i = 0; i <= kSamples; ++i) {
      const auto pixel = Project(line.start + i / double(kSamples) * (line.end - line.start));
      if (!pixel) {
        piece.reset();
        continue;
      }
      piece = piece ? PixelSegment{piece->start, *pixel} : PixelSegment{*pixel, *pixel};
      if (!longest || Length(*piece) > Length(*longest)) longest = piece;
    }
    if (!longest || Length(*longest) < options_.min_line_length_px) return std::nullopt;
    return longest;
  }

  static double Length(const PixelSegment& segment) { return (segment.end - segment.start).norm(); }

  LineFrame ObserveLines(int64_t t_ns) {
    std::map<int, PixelSegment> segments;
    std::vector<int> visible;
    for (size_t i = 0; i < dataset_->world.lines.size(); ++i) {
      const auto segment = ProjectLine(dataset_->world.lines[i]);
      if (!segment) continue;
      segments[static_cast<int>(i)] = *segment;
      visible.push_back(static_cast<int>(i));
    }
    LineFrame frame;
    frame.t_ns = t_ns;
    for (const auto& track : line_tracks_.Update(visible)) {
      const auto observation = ObserveSegment(segments.at(track.landmark));
      if (!observation) continue;
      frame.lines.push_back(*observation);
      frame.lines.back().id = track.id;
    }
    return frame;
  }

  // Moves the endpoints along the straight (undistorted) line, then adds noise in raw pixels.
  std::optional<LineObservation> ObserveSegment(const PixelSegment& segment) {
    const auto start = camera_->Unproject(segment.start), end = camera_->Unproject(segment.end);
    if (!start || !end) return std::nullopt;
    const Vector2d along = *end - *start;
    const auto noisy_start = DisturbEnd(*start + Slide() * along);
    const auto noisy_end = DisturbEnd(*end - Slide() * along);
    if (!noisy_start || !noisy_end) return std::nullopt;
    return LineObservation{-1, *noisy_start, *noisy_end};
  }

  double Slide() { return line_random_.Uniform(0, options_.line_end_slide); }

  std::optional<Vector2d> DisturbEnd(const Vector2d& xy) {
    const double u = line_random_.Normal(), v = line_random_.Normal();
    const auto pixel = camera_->Project(xy.homogeneous());
    if (!pixel) return std::nullopt;
    return camera_->Unproject(*pixel + options_.line_noise_px * Vector2d(u, v));
  }

  const FeatureSimulationOptions& options_;
  FeatureDataset* dataset_;
  std::unique_ptr<const CameraModel> camera_;
  std::unique_ptr<const CameraModel> second_camera_;  // null without a second camera
  TrackSelector point_tracks_, line_tracks_;
  Random point_random_, line_random_, second_random_, depth_random_;
  std::vector<Rigid3d> T_C_W_;  // for each row; a single one for a global shutter
  std::map<int64_t, Vector2d> previous_xy_;
  int64_t previous_t_ns_ = 0;
};

}  // namespace

FeatureDataset SimulateFeatures(const FeatureSimulationOptions& options) {
  const Trajectory trajectory(WithForwardCamera(options));
  const ImuSimulation imu = SimulateImu(trajectory, ImuOptions(options));
  FeatureDataset dataset;
  dataset.imu = imu.samples;
  dataset.world = MakeFeatureRoom(options.room, StreamSeed(options.seed, kWorld));

  FeatureCamera camera(options, &dataset);
  const int64_t td_ns = ToNanoseconds(options.sensors.td);
  for (int i = 1;; ++i) {  // the first image has preceding IMU samples
    const int64_t exposure_ns = ToNanoseconds(i / options.frame_rate_hz);  // since the start
    if (ToSeconds(exposure_ns) > trajectory.duration()) break;
    const int64_t t_ns = options.start_ns + exposure_ns - td_ns;
    const BodyState body = trajectory.At(ToSeconds(exposure_ns));
    camera.Expose(t_ns, trajectory, ToSeconds(exposure_ns));
    dataset.truth.push_back(TrueState(t_ns, body, imu.BiasAt(t_ns + td_ns)));
  }
  dataset.point_landmark = camera.point_tracks().landmark_of_id();
  dataset.line_landmark = camera.line_tracks().landmark_of_id();
  return dataset;
}

}  // namespace plm_vins::simulator
