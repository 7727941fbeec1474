// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/problem/observation_terms.h"

#include "vins_estimator/equations/chain_variables.h"
#include "vins_estimator/factors/intrinsics_factor.h"
#include "vins_estimator/factors/line_factor.h"
#include "vins_estimator/factors/point_factor.h"
#include "vins_estimator/geometry/depth_limits.h"
#include "vins_estimator/map/landmark_map.h"
#include "vins_estimator/map/line_map.h"
#include "vins_estimator/map/point_map.h"

namespace plm_vins {
namespace {

ChainKind KindOf(const ImageKey& host, const ImageKey& target) {
  return {host.t_ns == target.t_ns, host.camera == target.camera};
}

}  // namespace

ObservationTerms::ObservationTerms(const ProblemOptions* options, const SlidingWindow* window,
                                   WindowVariables* variables, WindowProblem* problem)
    : options_(options),
      window_(window),
      variables_(variables),
      problem_(problem),
      point_loss_(options->point_loss_scale),
      line_loss_(options->line_loss_scale),
      depth_loss_(options->depth_loss_scale) {
  if (!options->estimate_intrinsics) return;
  for (size_t i = 0; i < window->cameras.size(); ++i) {
    const CameraParameters& configured = options->cameras[i].parameters;
    cameras_.push_back(CameraModel::Create(configured.With(window->cameras[i].ray_intrinsics)));
  }
}

ProblemPoint ObservationTerms::AddEliminated(PointLandmark* landmark) {
  const int eliminated =
      problem_->AddLandmark({BlockKind::kPoint, landmark->id}, landmark->coordinates.data());
  problem_->ReserveLandmarkTerms(eliminated, CountMeasurements(landmark->observations));
  return WithVariables(*landmark, problem_->landmarks()[eliminated].variable, eliminated);
}

ProblemLine ObservationTerms::AddEliminated(LineLandmark* landmark) {
  constexpr size_t kOfAxis = 1;
  const int eliminated =
      problem_->AddLandmark({BlockKind::kLine, landmark->id}, landmark->coordinates.data());
  problem_->ReserveLandmarkTerms(
      eliminated, landmark->observations.size() + landmark->anchor_observations.size() + kOfAxis);
  return WithVariables(*landmark, problem_->landmarks()[eliminated].variable, eliminated);
}

ProblemPoint ObservationTerms::AddConstant(PointLandmark* landmark) {
  const int index = problem_->AddVariable({BlockKind::kPoint, landmark->id},
                                          landmark->coordinates.data(), /*constant=*/true);
  return WithVariables(*landmark, index, std::nullopt);
}

ProblemLine ObservationTerms::AddConstant(LineLandmark* landmark) {
  const int index = problem_->AddVariable({BlockKind::kLine, landmark->id},
                                          landmark->coordinates.data(), /*constant=*/true);
  return WithVariables(*landmark, index, std::nullopt);
}

template <typename Landmark>
ProblemLandmark<Landmark> ObservationTerms::WithVariables(const Landmark& landmark, int index,
                                                          std::optional<int> eliminated) {
  const int host_extrinsics = variables_->Extrinsics(landmark.host().camera);
  const int host_pose = variables_->Pose(landmark.host().t_ns);
  return {&landmark, index, eliminated, host_pose, host_extrinsics};
}

template <typename Landmark>
TermVariables ObservationTerms::VariablesOf(const ProblemLandmark<Landmark>& landmark,
                                            const ImageKey& image,
                                            std::initializer_list<int> others) {
  return ChainVariables(KindOf(landmark.landmark->host(), image),
                        {landmark.host_pose, landmark.host_extrinsics, variables_->Pose(image.t_ns),
                         variables_->Extrinsics(image.camera)},
                        others);
}

void ObservationTerms::AddObservation(const ProblemPoint& point,
                                      const PointLandmark::Observation& observation) {
  const int camera = observation.camera;
  const PointFactor factor(KindOf(point.landmark->host(), observation), observation.bearing,
                           options_->cameras[camera].point_weight);
  TermVariables variables =
      VariablesOf(point, observation, {variables_->TimeOffset(), point.variable});
  if (cameras_.empty()) {
    AddTerm(point.eliminated, factor, &point_loss_, variables);
    return;
  }
  variables.Add(variables_->Intrinsics(camera));
  const RayShift shift(*cameras_[camera], ExpectedRay(*point.landmark, observation, *window_));
  AddTerm(point.eliminated, PointIntrinsicsFactor(factor, shift), &point_loss_, variables);
}

void ObservationTerms::AddObservation(const ProblemLine& line,
                                      const LineLandmark::Observation& observation) {
  AddLine(line, observation, options_->line_weight);
}

void ObservationTerms::AddAnchorObservation(const ProblemLine& line,
                                            const LineLandmark::Observation& observation) {
  AddLine(line, observation, options_->anchor_weight);
}

void ObservationTerms::AddDepth(const ProblemPoint& point,
                                const PointLandmark::Observation& observation) {
  if (!observation.depth) return;
  const DepthFactor factor(KindOf(point.landmark->host(), observation),
                           MeasuredDepth(observation, *window_), options_->depth_weight);
  AddTerm(point.eliminated, factor, &depth_loss_,
          VariablesOf(point, observation, {variables_->DepthStream(), point.variable}));
}

void ObservationTerms::AddLine(const ProblemLine& line,
                               const LineLandmark::Observation& observation, double weight) {
  const int camera = observation.camera;
  const ProblemCamera& options = options_->cameras[camera];
  const LineFactor factor(
      KindOf(line.landmark->host(), observation), observation.segment,
      observation.Weights(weight / options.noise_ratio) / options.line_noise_factor);
  TermVariables variables = VariablesOf(line, observation, {line.variable});
  if (cameras_.empty()) {
    AddTerm(line.eliminated, factor, &line_loss_, variables);
    return;
  }
  variables.Add(variables_->Intrinsics(camera));
  const SegmentEndPoints expected = ExpectedEnds(*line.landmark, observation, *window_);
  const RayShift start(*cameras_[camera], expected.start), end(*cameras_[camera], expected.end);
  AddTerm(line.eliminated, LineIntrinsicsFactor(factor, start, end), &line_loss_, variables);
}

template <typename FactorType>
void ObservationTerms::AddTerm(std::optional<int> eliminated, const FactorType& factor,
                               const ceres::LossFunction* loss, const TermVariables& variables) {
  if (eliminated) {
    problem_->AddLandmarkTerm(*eliminated, factor, loss, variables);
  } else {
    problem_->AddTerm(factor, loss, variables);
  }
}

Eigen::Vector2d ExpectedRay(const PointLandmark& landmark,
                            const PointLandmark::Observation& observation,
                            const SlidingWindow& window) {
  const Eigen::Vector3d p_C =
      window.T_W_C(observation).Inverse() * PositionInWorld(landmark, window);
  return p_C.z() > kMinProjectedDepth ? Eigen::Vector2d(p_C.hnormalized()) : observation.bearing.xy;
}

SegmentEndPoints ExpectedEnds(const LineLandmark& landmark,
                              const LineLandmark::Observation& observation,
                              const SlidingWindow& window) {
  const SegmentEndPoints& observed = observation.segment;
  const Eigen::Vector3d moment =
      (window.T_W_C(observation).Inverse() * LineInWorld(landmark, window)).moment;
  Eigen::Vector2d distances;
  if (!EndPointDistances(observed, moment, &distances, nullptr)) return observed;
  const Eigen::Vector2d normal = moment.head<2>().normalized();
  return {observed.start - distances[0] * normal, observed.end - distances[1] * normal};
}

}  // namespace plm_vins
