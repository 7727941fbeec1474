// SPDX-License-Identifier: BSD-3-Clause
// A flight past points, as observed by drifting odometry, with repeated visits.
#pragma once

#include <map>
#include <vector>

#include "common/geometry/so3.h"
#include "map_bundle/map_bundle.h"
#include "pose_graph/map/keyframe_map.h"
#include "simulator/imu_simulator.h"
#include "simulator/random.h"
#include "simulator/trajectory.h"

namespace plm_vins::testing {

struct DriftingFlightOptions {
  double seconds = 40;
  int keyframes_of_visit = 10;  // tracks differ between visits
  double noise = 1e-3;          // of corners (normalized)
  double scale = 1.02;          // of odometry
  double drift = 0.002;         // of its heading from keyframe to keyframe [rad]
  double wrong_share = 0;       // share of wrong loop observations, of another landmark
  double restart = 0;       // time at which the clock and odometry's world restart; 0: never [s]
  double camera_clock = 0;  // camera clock minus IMU clock [s]
  int far_points = 0;       // additional points, kilometers away
  int loaded = 0;           // number of keyframes of a loaded map, which has another T_B_C
  bool refused = false;     // the graph rejects all of its loops
  bool stereo = false;      // a second camera observes the points as well
  uint64_t seed = 1;
};

// Keyframes are half a second apart; the first one has its true pose.
class DriftingFlight {
 public:
  explicit DriftingFlight(const DriftingFlightOptions& options)
      : options_(options), random_(options.seed), trajectory_(TrajectoryOf(options)) {
    for (int i = 0; i < 700; ++i) {
      const Eigen::Vector3d direction =
          Eigen::Vector3d(random_.Normal(), random_.Normal(), random_.Normal()).normalized();
      points_.push_back(Eigen::Vector3d(0, 0, 1.5) + random_.Uniform(4, 8) * direction);
    }
    for (int i = 0; i < options.far_points; ++i) {
      const double angle = 2 * M_PI * i / options.far_points;
      points_.push_back(5000 * Eigen::Vector3d(std::cos(angle), std::sin(angle), 0));
    }
    simulator::ImuSimulationOptions imu;
    imu.noise = noise_;
    imu.initial_bias = {{0.05, -0.1, 0.08}, {0.01, -0.02, 0.005}};
    imu.seed = options.seed;
    imu_ = simulator::SimulateImu(trajectory_, imu);
    for (int i = 0; Seconds(i) + kInterval < options.seconds; ++i) AddKeyframe(i);
  }

  const KeyframeMap& map() const { return map_; }
  const std::map<int, RecognizedPlace>& places() const { return places_; }  // by keyframe number
  Rigid3d True(int number) const { return trajectory_.At(Seconds(number)).T_W_B; }
  Rigid3d InMap(int number) const {
    return map_.T_M_O(number).ToRigid() * map_.keyframes[number].T_O_B;
  }

  // Passes all data of a run to the bundle.
  void Tell(MapBundle* bundle) const {
    KeyframeMap map;
    auto sample = imu_.samples.begin();
    for (size_t i = 0; i < map_.keyframes.size(); ++i) {
      const int number = map.graph.AddNode(map_.graph.node(static_cast<int>(i)));
      map.keyframes.push_back(map_.keyframes[i]);
      const int64_t t_ns = ToNanoseconds(Seconds(number));
      for (; sample->t_ns <= t_ns; ++sample) bundle->AddImu(Told(*sample));
      if (number >= options_.loaded) {
        bundle->AddKeyframe(map, odometry_[i], Told(t_ns), frames_[i]);
      }
      bundle->AddLoops(map, LoopsOf(number));
    }
  }

 private:
  static constexpr double kInterval = 0.5;  // [s]

  static simulator::TrajectoryOptions TrajectoryOf(const DriftingFlightOptions& options) {
    simulator::TrajectoryOptions result;
    result.duration = options.seconds;
    result.seed = options.seed;
    result.rest = 0.5;
    return result;
  }

  static double Seconds(int number) { return 1 + kInterval * number; }

  // Result of loop closure for a keyframe.
  LoopClosure LoopsOf(int number) const {
    LoopClosure closure;
    const auto place = places_.find(number);
    if (place == places_.end()) return closure;
    closure.place = place->second;
    LoopCandidate& loop = closure.candidates.emplace_back();
    loop.earlier = place->second.earlier;
    loop.later = number;
    if (options_.refused) loop.failed = LoopGate::kGraph;
    return closure;
  }

  bool IsRestarted(int64_t t_ns) const {
    return options_.restart > 0 && t_ns >= ToNanoseconds(options_.restart);
  }

  // Timestamp of the restarted clock.
  int64_t Told(int64_t t_ns) const {
    return IsRestarted(t_ns) ? t_ns - ToNanoseconds(options_.restart) : t_ns;
  }
  ImuSample Told(ImuSample sample) const {
    sample.t_ns = Told(sample.t_ns);
    return sample;
  }

  void AddKeyframe(int number) {
    const int64_t t_ns = ToNanoseconds(Seconds(number));
    const simulator::BodyState truth = trajectory_.At(Seconds(number));
    const LevelTransform T_O_W = {options_.drift * number, {0.003 * number, 0, -0.002 * number}};
    const auto in_O = [&](const Eigen::Vector3d& p_W) -> Eigen::Vector3d {
      return T_O_W * (options_.scale * p_W);
    };
    Keyframe keyframe;
    keyframe.t_ns = Told(t_ns);
    keyframe.world = IsRestarted(t_ns) ? 1 : 0;
    keyframe.T_O_B = {T_O_W.rotation() * truth.T_W_B.rotation, in_O(truth.T_W_B.translation)};
    Rigid3d T_B_C(Eigen::Quaterniond(0.5, -0.5, 0.5, -0.5), {0.1, 0, 0.05});
    if (number < options_.loaded) T_B_C.translation.y() += 0.3;
    const Rigid3d T_B_C1 = T_B_C * Rigid3d(Eigen::Quaterniond::Identity(), {0.2, 0, 0});
    keyframe.T_B_C = {T_B_C, T_B_C1};
    keyframe.covariance = 1e-4 * (number + 1) * Matrix4d::Identity();
    const int visit = number / options_.keyframes_of_visit;
    const Rigid3d T_C_W = (truth.T_W_B * T_B_C).Inverse();
    PointFrame& frame = frames_.emplace_back();
    RecognizedPlace place;
    for (size_t i = 0; i < points_.size(); ++i) {
      const Eigen::Vector3d p_C = T_C_W * points_[i];
      if (p_C.z() < 1 || p_C.hnormalized().cwiseAbs().maxCoeff() > 0.7) continue;
      DescribedCorner& corner = keyframe.corners.emplace_back();
      corner.track = Track(visit, i);
      corner.xy = (p_C.hnormalized() + Noise()).cast<float>();
      corner.p_O = in_O(points_[i]).cast<float>();
      SeeAgain(visit, i, corner, &place);
      if (!options_.stereo) continue;
      PointObservation& second = frame.points.emplace_back();
      second.id = corner.track;
      second.camera = 1;
      second.xy = ((truth.T_W_B * T_B_C1).Inverse() * points_[i]).hnormalized() + Noise();
    }
    const int node = map_.graph.AddNode(keyframe.T_O_L());
    if (node > 0) {
      const LevelTransform step = map_.graph.node(node - 1).Inverse() * map_.graph.node(node);
      map_.graph.AddEdge({node - 1, node, step, 1e-4 * Matrix4d::Identity()});
    }
    map_.keyframes.push_back(keyframe);
    EstimatorOutput& odometry = odometry_.emplace_back();
    const int64_t camera_ns = keyframe.t_ns + ToNanoseconds(options_.camera_clock);
    odometry.state = simulator::TrueState(camera_ns, truth, imu_.BiasAt(t_ns));
    odometry.state.SetPose(keyframe.T_O_B);
    odometry.state.velocity() = options_.scale * (T_O_W.rotation() * truth.v_W);
    odometry.imu_noise = noise_;
    odometry.calibration.cameras = {{{}, T_B_C}, {{}, T_B_C1}};
    if (!place.observations.of_earlier.empty()) places_[node] = place;
  }

  // Adds a loop observation of the landmark from two visits before.
  void SeeAgain(int visit, size_t point, const DescribedCorner& corner, RecognizedPlace* place) {
    const int earlier_visit = visit - 2;
    if (earlier_visit < 0) return;
    place->earlier = earlier_visit * options_.keyframes_of_visit;
    const bool wrong = random_.Uniform(0, 1) < options_.wrong_share;
    const size_t seen = wrong ? (point + 1) % points_.size() : point;
    place->observations.of_earlier.push_back(
        {corner.p_O->cast<double>(), corner.xy.cast<double>(), Track(earlier_visit, seen)});
  }

  static int64_t Track(int visit, size_t point) {
    return 10000 * visit + static_cast<int64_t>(point);
  }

  Eigen::Vector2d Noise() {
    return {options_.noise * random_.Normal(), options_.noise * random_.Normal()};
  }

  const DriftingFlightOptions options_;
  simulator::Random random_;
  simulator::Trajectory trajectory_;
  ImuNoise noise_;
  simulator::ImuSimulation imu_;
  std::vector<Eigen::Vector3d> points_;
  KeyframeMap map_;
  std::vector<EstimatorOutput> odometry_;
  std::vector<PointFrame> frames_;  // observations by the second camera
  std::map<int, RecognizedPlace> places_;
};

// Root mean square error of positions relative to the first keyframe [m].
template <typename PoseFunction>
double PositionError(const DriftingFlight& flight, const PoseFunction& pose) {
  const Rigid3d T_W_M = flight.True(0) * pose(0).Inverse();
  double sum = 0;
  const int count = flight.map().graph.size();
  for (int i = 0; i < count; ++i) {
    sum += (T_W_M * pose(i).translation - flight.True(i).translation).squaredNorm();
  }
  return std::sqrt(sum / count);
}

}  // namespace plm_vins::testing
