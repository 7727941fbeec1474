// SPDX-License-Identifier: BSD-3-Clause
#include "map_bundle/bundle_problem.h"

#include <ceres/loss_function.h>

#include <array>
#include <deque>
#include <utility>
#include <vector>

#include "vins_estimator/equations/chain_variables.h"
#include "vins_estimator/equations/window_problem.h"
#include "vins_estimator/factors/imu_factor.h"
#include "vins_estimator/factors/point_factor.h"
#include "vins_estimator/factors/priors.h"
#include "vins_estimator/factors/zero_velocity_factor.h"
#include "vins_estimator/geometry/point_in_host.h"
#include "vins_estimator/solver/ceres_solver.h"

namespace plm_vins {
namespace {

constexpr double kGaugeDeviation = 1e-3;  // [m] and [rad]; any small value fixes the gauge
// Standard deviations of the bias prior at the start of a world, about the odometry's estimate.
constexpr double kAccelBiasDeviation = 0.1;  // [m/s^2]
constexpr double kGyroBiasDeviation = 0.05;  // [rad/s]
constexpr double kStillVelocity = 0.005;     // at standstill [m/s]

// Builds the bundle adjustment as a WindowProblem and writes its solution back to `bundle`.
class BundleProblem {
 public:
  BundleProblem(const ImuHistory& imu, const BundleOptions& options, BundleState* bundle);

  const WindowProblem& problem() const { return problem_; }
  void TakeOverLandmarks();

 private:
  void AddVariables();
  void AddMotions();
  void AddImu(int from, int to);
  void HoldFirst();
  void AddLandmark(const LandmarkTrack& landmark);
  int Pose(int keyframe) const { return problem_.Find({BlockKind::kPose, keyframe}); }
  int Motion(int keyframe) const { return problem_.Find({BlockKind::kMotion, keyframe}); }
  int Extrinsics(int camera) const { return problem_.Find({BlockKind::kExtrinsic, camera}); }

  const BundleOptions options_;
  const Eigen::Vector3d gravity_M_;
  BundleState* bundle_;
  const ImuHistory& imu_;
  std::vector<FrameState> extrinsics_;  // as poses, by camera
  std::array<double, kDepthStreamSize> depth_stream_ = {};
  double time_offset_ = 0;
  int depth_stream_variable_ = -1, td_variable_ = -1;
  std::deque<Preintegration> preintegrations_;
  std::vector<std::array<double, kPointSize>> points_;  // image point, inverse depth in the host
  ceres::CauchyLoss loss_{1.0};
  WindowProblem problem_;
};

BundleProblem::BundleProblem(const ImuHistory& imu, const BundleOptions& options,
                             BundleState* bundle)
    : options_(options),
      gravity_M_(0, 0, -options.gravity_norm),
      bundle_(bundle),
      imu_(imu),
      extrinsics_(bundle->T_B_C.size()) {
  AddVariables();
  AddMotions();
  HoldFirst();
  points_.reserve(bundle->landmarks.size());  // the problem keeps pointers to the elements
  for (const LandmarkTrack& landmark : bundle->landmarks) AddLandmark(landmark);
}

void BundleProblem::AddVariables() {
  for (auto& [number, keyframe] : bundle_->keyframes) {
    FrameState& state = keyframe.state;
    const bool constant = !keyframe.moves();
    problem_.AddVariable({BlockKind::kPose, number}, state.pose.data(), constant);
    problem_.AddVariable({BlockKind::kMotion, number}, state.motion.data(), constant);
  }
  constexpr bool kConstant = true;
  for (size_t i = 0; i < extrinsics_.size(); ++i) {
    extrinsics_[i].SetPose(bundle_->T_B_C[i]);
    problem_.AddVariable({BlockKind::kExtrinsic, static_cast<int64_t>(i)},
                         extrinsics_[i].pose.data(), kConstant);
  }
  depth_stream_variable_ =
      problem_.AddVariable({BlockKind::kDepthStream, 0}, depth_stream_.data(), kConstant);
  td_variable_ = problem_.AddVariable({BlockKind::kTimeOffset, 0}, &time_offset_, kConstant);
}

void BundleProblem::AddMotions() {
  const BundleKeyframe* before = nullptr;
  int number_before = -1;
  for (const auto& [number, keyframe] : bundle_->keyframes) {
    if (before != nullptr && HasMotionBetween(*before, keyframe)) {
      AddImu(number_before, number);
    } else if (keyframe.moves()) {
      problem_.AddTerm(BiasPrior(keyframe.start.bias(), kAccelBiasDeviation, kGyroBiasDeviation),
                       nullptr, {Motion(number)});
    }
    if (keyframe.moves() && keyframe.stationary) {
      problem_.AddTerm(ZeroVelocityFactor(kStillVelocity), nullptr, {Motion(number)});
    }
    before = &keyframe;
    number_before = number;
  }
}

void BundleProblem::AddImu(int from, int to) {
  const BundleKeyframe& begin = bundle_->keyframes.at(from);
  const BundleKeyframe& end = bundle_->keyframes.at(to);
  auto preintegration = imu_.Between(begin.recording, begin.state.t_ns, end.state.t_ns, *end.noise,
                                     begin.state.bias());
  if (!preintegration) return;
  preintegrations_.push_back(std::move(*preintegration));
  problem_.AddTerm(ImuFactor(&preintegrations_.back(), gravity_M_), nullptr,
                   {Pose(from), Motion(from), Pose(to), Motion(to)});
}

void BundleProblem::HoldFirst() {
  const auto& [number, first] = *bundle_->keyframes.begin();
  if (!first.moves()) return;  // the keyframes of a loaded map fix the gauge
  problem_.AddTerm(GaugePrior(first.start, kGaugeDeviation), nullptr, {Pose(number)});
}

// Parameterizes the landmark by its first observation (host) and inverse depth, with one factor for
// each observation and each measured depth.
void BundleProblem::AddLandmark(const LandmarkTrack& landmark) {
  const LandmarkTrack::Observation& host = landmark.observations.front();
  const Eigen::Vector3d p_C = bundle_->T_M_C(host.keyframe, host.camera).Inverse() * landmark.p_M;
  const BlockId id{BlockKind::kPoint, static_cast<int64_t>(points_.size())};
  points_.push_back({p_C.x() / p_C.z(), p_C.y() / p_C.z(), 1 / p_C.z()});
  const int index = problem_.AddLandmark(id, points_.back().data());
  const int point = problem_.Find(id);
  for (const LandmarkTrack::Observation& target : landmark.observations) {
    const ChainKind kind{target.keyframe == host.keyframe, target.camera == host.camera};
    const ChainEnds ends{Pose(host.keyframe), Extrinsics(host.camera), Pose(target.keyframe),
                         Extrinsics(target.camera)};
    const TimedBearing bearing{target.xy, Eigen::Vector2d::Zero(), 0};
    problem_.AddLandmarkTerm(index, PointFactor(kind, bearing, 1 / options_.noise.Of(target, host)),
                             &loss_, ChainVariables(kind, ends, {td_variable_, point}));
    if (!target.depth) continue;
    problem_.AddLandmarkTerm(index, DepthFactor(kind, {*target.depth}, 1 / options_.depth_noise),
                             &loss_, ChainVariables(kind, ends, {depth_stream_variable_, point}));
  }
}

void BundleProblem::TakeOverLandmarks() {
  for (size_t i = 0; i < points_.size(); ++i) {
    LandmarkTrack& landmark = bundle_->landmarks[i];
    const auto& [x, y, inverse_depth] = points_[i];
    const LandmarkTrack::Observation& host = landmark.observations.front();
    landmark.p_M =
        bundle_->T_M_C(host.keyframe, host.camera) * (Eigen::Vector3d(x, y, 1) / inverse_depth);
  }
}

}  // namespace

bool AdjustBundle(const ImuHistory& imu, const BundleOptions& options, BundleState* bundle) {
  BundleProblem problem(imu, options, bundle);
  SolverOptions solver;
  solver.max_iterations = options.max_iterations;
  solver.deviation_tolerance = 0.02;
  if (!SolveByCeres(solver, problem.problem(), CeresEquations::kSparse).solved) return false;
  problem.TakeOverLandmarks();
  return true;
}

}  // namespace plm_vins
