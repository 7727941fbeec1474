// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/initialization/visual_inertial_bundle.h"

#include <ceres/loss_function.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>

#include "vins_estimator/equations/chain_variables.h"
#include "vins_estimator/equations/normal_equations.h"
#include "vins_estimator/equations/term_evaluation.h"
#include "vins_estimator/equations/window_problem.h"
#include "vins_estimator/factors/imu_factor.h"
#include "vins_estimator/factors/manifolds.h"
#include "vins_estimator/factors/point_factor.h"
#include "vins_estimator/factors/priors.h"
#include "vins_estimator/geometry/depth_limits.h"
#include "vins_estimator/geometry/point_in_host.h"
#include "vins_estimator/solver/levenberg_marquardt.h"
#include "vins_estimator/uncertainty/motion_evidence.h"

namespace plm_vins {
namespace {

constexpr SolverOptions kSolution = {12, 0.01};  // coarse: the window is optimized again
constexpr double kOverstated = 0.4;              // smaller shares are not due to chance
constexpr double kLeastShare = 0.05;             // lower bound of the estimated share
constexpr double kLeastRedundancy = 5;           // sum over all intervals, to estimate the noise
constexpr double kGaugeDeviation = 1e-3;  // [m] and [rad]; any small value has the same effect

// The bundle adjustment as a problem for the window's solver, over the given states.
class Bundle {
 public:
  Bundle(const std::vector<Track>& tracks, const std::vector<std::optional<Eigen::Vector3d>>& p_W,
         const std::vector<Preintegration>& preintegrations,
         const VisualInertialBundleOptions& options, std::vector<FrameState>* states);

  const WindowProblem& problem() const { return problem_; }
  double ReprojectionRms() const;
  double OutlierShare() const;
  double ImuRms() const;
  std::optional<double> RelativeScaleDeviation(NormalEquations* equations) const;
  double ShareOfAccelNoise(NormalEquations* equations) const;

 private:
  void AddVariables();
  void AddImu();
  void AddPriors();
  Eigen::Vector3d InCamera(const Track::Observation& image, const Eigen::Vector3d& p_W) const;
  void AddTrack(const Track& track, const Eigen::Vector3d& p_W);
  Eigen::VectorXd ScaleDirection() const;

  const VisualInertialBundleOptions options_;
  const Eigen::Vector3d gravity_W_;
  const std::vector<Preintegration>& preintegrations_;
  std::vector<FrameState>& states_;
  std::vector<FrameState> extrinsics_;  // as poses, by camera
  std::array<double, kDepthStreamSize> depth_stream_ = {};
  double time_offset_ = 0;
  std::vector<std::array<double, kPointSize>> points_;  // image point and inverse depth in the host
  ceres::CauchyLoss loss_{1.0};
  std::vector<int> poses_, motions_;       // variable indices, by view
  std::vector<int> extrinsics_variables_;  // by camera
  int depth_stream_variable_ = -1, td_variable_ = -1;
  WindowProblem problem_;
};

Bundle::Bundle(const std::vector<Track>& tracks,
               const std::vector<std::optional<Eigen::Vector3d>>& p_W,
               const std::vector<Preintegration>& preintegrations,
               const VisualInertialBundleOptions& options, std::vector<FrameState>* states)
    : options_(options),
      gravity_W_(0, 0, -options.gravity_norm),
      preintegrations_(preintegrations),
      states_(*states),
      extrinsics_(options.T_B_C.size()) {
  points_.reserve(tracks.size());  // the problem stores pointers to the elements
  AddVariables();
  AddImu();
  AddPriors();
  for (size_t i = 0; i < tracks.size(); ++i) {
    if (p_W[i]) AddTrack(tracks[i], *p_W[i]);
  }
}

void Bundle::AddVariables() {
  for (FrameState& state : states_) {
    poses_.push_back(problem_.AddVariable({BlockKind::kPose, state.t_ns}, state.pose.data()));
    motions_.push_back(problem_.AddVariable({BlockKind::kMotion, state.t_ns}, state.motion.data()));
  }
  constexpr bool kConstant = true;
  for (size_t i = 0; i < extrinsics_.size(); ++i) {
    extrinsics_[i].SetPose(options_.T_B_C[i]);
    extrinsics_variables_.push_back(problem_.AddVariable(
        {BlockKind::kExtrinsic, static_cast<int64_t>(i)}, extrinsics_[i].pose.data(), kConstant));
  }
  depth_stream_variable_ =
      problem_.AddVariable({BlockKind::kDepthStream, 0}, depth_stream_.data(), kConstant);
  td_variable_ = problem_.AddVariable({BlockKind::kTimeOffset, 0}, &time_offset_, kConstant);
}

void Bundle::AddImu() {
  for (size_t i = 0; i < preintegrations_.size(); ++i) {
    problem_.AddTerm(ImuFactor(&preintegrations_[i], gravity_W_), nullptr,
                     {poses_[i], motions_[i], poses_[i + 1], motions_[i + 1]});
  }
}

void Bundle::AddPriors() {
  const FrameState& first = states_.front();
  problem_.AddTerm(GaugePrior(first, kGaugeDeviation), nullptr, {poses_.front()});
  const ImuBias mean{Eigen::Vector3d::Zero(), first.gyro_bias()};
  problem_.AddTerm(BiasPrior(mean, options_.accel_bias_deviation, options_.gyro_bias_deviation),
                   nullptr, {motions_.front()});
}

Eigen::Vector3d Bundle::InCamera(const Track::Observation& image,
                                 const Eigen::Vector3d& p_W) const {
  return (states_[image.view].T_W_B() * options_.T_B_C[image.camera]).Inverse() * p_W;
}

// Adds a point, hosted by the first observation of its track, with a factor for each observation
// and for each measured depth.
void Bundle::AddTrack(const Track& track, const Eigen::Vector3d& p_W) {
  const Track::Observation& host = track.observations.front();
  for (const Track::Observation& o : track.observations) {
    if (InCamera(o, p_W).z() < kMinLandmarkDepth) return;
  }
  const Eigen::Vector3d p_C = InCamera(host, p_W);
  points_.push_back({p_C.x() / p_C.z(), p_C.y() / p_C.z(), 1 / p_C.z()});
  const BlockId id{BlockKind::kPoint, track.id};
  const int index = problem_.AddLandmark(id, points_.back().data());
  const int point = problem_.Find(id);
  for (const Track::Observation& target : track.observations) {
    const ChainKind kind{target.view == host.view, target.camera == host.camera};
    const ChainEnds ends{poses_[host.view], extrinsics_variables_[host.camera], poses_[target.view],
                         extrinsics_variables_[target.camera]};
    const TimedBearing bearing{target.xy, Eigen::Vector2d::Zero(), 0};
    problem_.AddLandmarkTerm(index, PointFactor(kind, bearing, 1 / options_.noise), &loss_,
                             ChainVariables(kind, ends, {td_variable_, point}));
    if (!target.depth) continue;
    problem_.AddLandmarkTerm(index, DepthFactor(kind, {*target.depth}, 1 / options_.depth_noise),
                             &loss_, ChainVariables(kind, ends, {depth_stream_variable_, point}));
  }
}

// Returns the root mean square of the whitened and weighted residuals, with the degrees of freedom
// reduced by the points' parameters.
double Bundle::ReprojectionRms() const {
  double squared_sum = 0;
  int freedom = 0;
  TermEvaluation evaluation;
  for (const LandmarkTerms& landmark : problem_.landmarks()) {
    freedom -= kPointSize;
    for (const ResidualTerm& term : landmark.terms) {
      if (!EvaluateTerm(term, problem_.variables(), &evaluation)) continue;
      squared_sum += Eigen::Map<const Eigen::VectorXd>(evaluation.residual.data(), evaluation.rows)
                         .squaredNorm();
      freedom += evaluation.rows;
    }
  }
  return std::sqrt(squared_sum / std::max(1, freedom));
}

// Returns the share of the observations that are off by more than five standard deviations.
double Bundle::OutlierShare() const {
  constexpr double kMaxSquaredError = 25;
  double rho[3];
  loss_.Evaluate(kMaxSquaredError, rho);
  int outliers = 0, count = 0;
  for (const LandmarkTerms& landmark : problem_.landmarks()) {
    for (const ResidualTerm& term : landmark.terms) {
      outliers += EvaluateTermCost(term, problem_.variables()) > 0.5 * rho[0];
      ++count;
    }
  }
  return static_cast<double>(outliers) / std::max(1, count);
}

double Bundle::ImuRms() const {
  double squared_sum = 0;
  for (size_t i = 0; i < preintegrations_.size(); ++i) {
    squared_sum += ImuChiSquare(preintegrations_[i], gravity_W_, states_[i], states_[i + 1]);
  }
  return std::sqrt(squared_sum / (Vector15d::SizeAtCompileTime * preintegrations_.size()));
}

// Returns the derivative of the logarithm of the trajectory's size with respect to each pose:
// positions relative to their mean, projected onto themselves.
Eigen::VectorXd Bundle::ScaleDirection() const {
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (const FrameState& state : states_) mean += state.position() / states_.size();
  Eigen::VectorXd direction = Eigen::VectorXd::Zero(kPoseTangentSize * states_.size());
  double squared_size = 0;
  for (size_t i = 0; i < states_.size(); ++i) {
    direction.segment<3>(kPoseTangentSize * i) = states_[i].position() - mean;
    squared_size += (states_[i].position() - mean).squaredNorm();
  }
  return direction / squared_size;
}

std::optional<double> Bundle::RelativeScaleDeviation(NormalEquations* equations) const {
  std::vector<BlockId> poses;
  for (const int pose : poses_) poses.push_back(problem_.variables()[pose].id);
  const auto covariance = equations->Covariance(poses);
  if (!covariance) return std::nullopt;
  const Eigen::VectorXd direction = ScaleDirection();
  const double variance = direction.dot(*covariance * direction);
  if (!(variance > 0)) return std::nullopt;
  return std::sqrt(variance);
}

// Returns the ratio of the accelerometer's noise in the residuals to the assumed noise; 1 if the
// residuals have too little redundancy.
double Bundle::ShareOfAccelNoise(NormalEquations* equations) const {
  double squared = 0, expected = 0, slope = 0;
  for (size_t i = 0; i < preintegrations_.size(); ++i) {
    const auto evidence =
        EvidenceOfMotion(preintegrations_[i], gravity_W_, states_[i], states_[i + 1], equations);
    if (!evidence) return 1;
    squared += evidence->accel.squared;
    expected += evidence->accel.expected;
    slope += evidence->accel.slope;
  }
  if (!(expected > kLeastRedundancy)) return 1;
  const double variance = 1 + (squared - expected) / slope;
  return std::sqrt(std::max(variance, kLeastShare * kLeastShare));
}

std::vector<Preintegration> WithAccelNoise(double share,
                                           std::vector<Preintegration> preintegrations) {
  for (Preintegration& motion : preintegrations) {
    ImuNoise noise = motion.noise();
    noise.accel_density *= share;
    motion.Reweigh(noise);
  }
  return preintegrations;
}

// Result of one solution, with the share of the assumed accelerometer noise that it shows if the
// scale is too uncertain.
struct Solution {
  VisualInertialBundle bundle;
  double share_of_accel_noise = 1;
};

std::optional<Solution> SolveBundle(const std::vector<Track>& tracks,
                                    const std::vector<std::optional<Eigen::Vector3d>>& p_W,
                                    const std::vector<Preintegration>& preintegrations,
                                    const VisualInertialBundleOptions& options,
                                    std::vector<FrameState>* states, std::string* reason) {
  Bundle bundle(tracks, p_W, preintegrations, options, states);
  NormalEquations equations(bundle.problem());
  // Without points, the IMU leaves the velocity unobservable, which rounding may hide.
  const bool solved = !bundle.problem().landmarks().empty() &&
                      Solve(kSolution, bundle.problem(), &equations).solved;
  equations.Linearize();
  const std::optional<double> scale_deviation = bundle.RelativeScaleDeviation(&equations);
  if (!solved || !scale_deviation) {
    *reason = "the visual-inertial bundle adjustment is degenerate";
    return std::nullopt;
  }
  return Solution{
      {bundle.ReprojectionRms(), bundle.ImuRms(), bundle.OutlierShare(), *scale_deviation},
      *scale_deviation > options.max_scale_deviation ? bundle.ShareOfAccelNoise(&equations) : 1};
}

}  // namespace

std::optional<VisualInertialBundle> AdjustVisualInertialBundle(
    const std::vector<Track>& tracks, const std::vector<std::optional<Eigen::Vector3d>>& p_W,
    const std::vector<Preintegration>& preintegrations, const VisualInertialBundleOptions& options,
    std::vector<FrameState>* states, std::string* reason) {
  const std::vector<FrameState> initial = *states;
  auto solution = SolveBundle(tracks, p_W, preintegrations, options, states, reason);
  // Configurations may overstate the noise by an order of magnitude. The scale would then stay too
  // uncertain for a start, although the accelerometer determines it.
  if (solution && solution->share_of_accel_noise < kOverstated) {
    *states = initial;
    solution =
        SolveBundle(tracks, p_W, WithAccelNoise(solution->share_of_accel_noise, preintegrations),
                    options, states, reason);
  }
  if (!solution) return std::nullopt;
  return solution->bundle;
}

}  // namespace plm_vins
