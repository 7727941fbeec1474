// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/problem/view_terms.h"

#include "vins_estimator/factors/intrinsics_factor.h"
#include "vins_estimator/factors/line_factor.h"
#include "vins_estimator/factors/point_factor.h"
#include "vins_estimator/factors/stereo_factor.h"
#include "vins_estimator/map/landmark_map.h"
#include "vins_estimator/problem/expected_rays.h"

namespace plm_vins {

ViewTerms::ViewTerms(const ProblemOptions* options, const SlidingWindow* window,
                     WindowVariables* variables, WindowProblem* problem)
    : options_(options),
      window_(window),
      variables_(variables),
      problem_(problem),
      camera_(options->estimate_intrinsics
                  ? CameraModel::Create(options->camera.With(window->ray_intrinsics))
                  : nullptr),
      right_camera_(
          options->estimate_intrinsics && options->right_camera
              ? CameraModel::Create(options->right_camera->With(window->right_ray_intrinsics))
              : nullptr),
      point_loss_(options->point_loss_scale),
      line_loss_(options->line_loss_scale),
      right_loss_(options->right_loss_scale),
      depth_loss_(options->depth_loss_scale) {}

ProblemPoint ViewTerms::AddEliminated(PointLandmark* landmark) {
  const int eliminated =
      problem_->AddLandmark({BlockKind::kPoint, landmark->id}, landmark->coordinates.data());
  problem_->ReserveLandmarkTerms(eliminated, CountMeasurements(landmark->views));
  return WithVariables(*landmark, problem_->landmarks()[eliminated].variable, eliminated);
}

ProblemLine ViewTerms::AddEliminated(LineLandmark* landmark) {
  constexpr size_t kOfAxis = 1;
  const int eliminated =
      problem_->AddLandmark({BlockKind::kLine, landmark->id}, landmark->coordinates.data());
  problem_->ReserveLandmarkTerms(eliminated,
                                 landmark->views.size() + landmark->anchor_views.size() + kOfAxis);
  return WithVariables(*landmark, problem_->landmarks()[eliminated].variable, eliminated);
}

ProblemPoint ViewTerms::AddConstant(PointLandmark* landmark) {
  const int index = problem_->AddVariable({BlockKind::kPoint, landmark->id},
                                          landmark->coordinates.data(), /*constant=*/true);
  return WithVariables(*landmark, index, std::nullopt);
}

ProblemLine ViewTerms::AddConstant(LineLandmark* landmark) {
  const int index = problem_->AddVariable({BlockKind::kLine, landmark->id},
                                          landmark->coordinates.data(), /*constant=*/true);
  return WithVariables(*landmark, index, std::nullopt);
}

ProblemPoint ViewTerms::WithVariables(const PointLandmark& landmark, int index,
                                      std::optional<int> eliminated) {
  const int extrinsic = variables_->Extrinsic();
  const int td = variables_->TimeOffset();
  const int host_pose = variables_->Pose(landmark.host().t_ns);
  return {&landmark, index, eliminated, host_pose, extrinsic, td};
}

ProblemLine ViewTerms::WithVariables(const LineLandmark& landmark, int index,
                                     std::optional<int> eliminated) {
  const int extrinsic = variables_->Extrinsic();
  const int host_pose = variables_->Pose(landmark.host().t_ns);
  return {&landmark, index, eliminated, host_pose, extrinsic};
}

void ViewTerms::AddHostView(const ProblemPoint& point) {
  AddPointTerm<PointHostFactor>(point, point.landmark->host(), point.td, point.point);
}

void ViewTerms::AddHostView(const ProblemLine& line) {
  AddLineTerm<LineHostFactor>(line, line.landmark->host(), options_->line_weight, line.line);
}

void ViewTerms::AddView(const ProblemPoint& point, const PointView& view) {
  AddPointTerm<PointFactor>(point, view, point.host_pose, variables_->Pose(view.t_ns),
                            point.extrinsic, point.td, point.point);
}

void ViewTerms::AddView(const ProblemLine& line, const LineView& view) {
  AddPairView(line, view, options_->line_weight);
}

void ViewTerms::AddAnchorView(const ProblemLine& line, const LineView& view) {
  AddPairView(line, view, options_->anchor_weight);
}

void ViewTerms::AddDepth(const ProblemPoint& point, const PointView& view) {
  AddMeasuredDepth(point, view);
  if (!view.right) return;
  const int mounting = variables_->Mounting();
  if (view.t_ns == point.landmark->host().t_ns) {
    AddRightPointTerm<RightPointHostFactor>(point, view, mounting, point.td, point.point);
  } else {
    AddRightPointTerm<RightPointFactor>(point, view, point.host_pose, variables_->Pose(view.t_ns),
                                        point.extrinsic, mounting, point.td, point.point);
  }
}

void ViewTerms::AddMeasuredDepth(const ProblemPoint& point, const PointView& view) {
  if (!view.depth) return;
  const TimedDepth depth = window_->DepthIn(view.t_ns, *view.depth);
  const double weight = options_->depth_weight;
  const int stream = variables_->DepthStream();
  if (view.t_ns == point.landmark->host().t_ns) {
    AddTerm(point.eliminated, DepthHostFactor(depth, weight), &depth_loss_, {stream, point.point});
  } else {
    AddTerm(point.eliminated, DepthFactor(depth, weight), &depth_loss_,
            {point.host_pose, variables_->Pose(view.t_ns), point.extrinsic, stream, point.point});
  }
}

void ViewTerms::AddDepth(const ProblemLine& line, const LineView& view) {
  if (!view.right) return;
  const int mounting = variables_->Mounting();
  if (view.t_ns == line.landmark->host().t_ns) {
    AddRightLineTerm<RightLineHostFactor>(line, view, mounting, line.line);
  } else {
    AddRightLineTerm<RightLineFactor>(line, view, line.host_pose, variables_->Pose(view.t_ns),
                                      line.extrinsic, mounting, line.line);
  }
}

void ViewTerms::AddPairView(const ProblemLine& line, const LineView& view, double weight) {
  AddLineTerm<LineFactor>(line, view, weight, line.host_pose, variables_->Pose(view.t_ns),
                          line.extrinsic, line.line);
}

template <typename ViewFactor, typename... Indices>
void ViewTerms::AddPointTerm(const ProblemPoint& point, const PointView& view,
                             Indices... variables) {
  const ViewFactor factor(view.bearing, options_->point_weight);
  if (!camera_) {
    AddTerm(point.eliminated, factor, &point_loss_, {variables...});
    return;
  }
  const RayShift shift(*camera_, ExpectedRay(*point.landmark, view, *window_));
  AddTerm(point.eliminated,
          PointIntrinsicsFactor<ViewFactor>(factor, shift, options_->point_weight), &point_loss_,
          {variables..., variables_->Intrinsics()});
}

template <typename ViewFactor, typename... Indices>
void ViewTerms::AddLineTerm(const ProblemLine& line, const LineView& view, double weight,
                            Indices... variables) {
  if (!camera_) {
    AddTerm(line.eliminated, ViewFactor(view.segment, weight), &line_loss_, {variables...});
    return;
  }
  const LineSegmentView expected = ExpectedEnds(*line.landmark, view, *window_);
  const RayShift start(*camera_, expected.start), end(*camera_, expected.end);
  AddTerm(line.eliminated, LineIntrinsicsFactor<ViewFactor>(view.segment, weight, start, end),
          &line_loss_, {variables..., variables_->Intrinsics()});
}

template <typename ViewFactor, typename... Indices>
void ViewTerms::AddRightPointTerm(const ProblemPoint& point, const PointView& view,
                                  Indices... variables) {
  const double weight = options_->right_weight;
  const ViewFactor factor(view.RightBearing(), weight);
  if (!right_camera_) {
    AddTerm(point.eliminated, factor, &right_loss_, {variables...});
    return;
  }
  const RayShift shift(*right_camera_, ExpectedRightRay(*point.landmark, view, *window_));
  AddTerm(point.eliminated, PointIntrinsicsFactor<ViewFactor>(factor, shift, weight), &right_loss_,
          {variables..., variables_->RightIntrinsics()});
}

template <typename ViewFactor, typename... Indices>
void ViewTerms::AddRightLineTerm(const ProblemLine& line, const LineView& view,
                                 Indices... variables) {
  const LineSegmentView segment{view.right->start, view.right->end};
  const Eigen::Vector2d weights =
      (options_->right_line_noise_factor * view.right->deviation).cwiseInverse();
  if (!right_camera_) {
    AddTerm(line.eliminated, ViewFactor(segment, weights), &right_loss_, {variables...});
    return;
  }
  const LineSegmentView expected = ExpectedRightEnds(*line.landmark, view, *window_);
  const RayShift start(*right_camera_, expected.start), end(*right_camera_, expected.end);
  AddTerm(line.eliminated, LineIntrinsicsFactor<ViewFactor>(segment, weights, start, end),
          &right_loss_, {variables..., variables_->RightIntrinsics()});
}

template <typename FactorType, int kCount>
void ViewTerms::AddTerm(std::optional<int> eliminated, const FactorType& factor,
                        const ceres::LossFunction* loss, const int (&variables)[kCount]) {
  if (eliminated) {
    problem_->AddLandmarkTerm(*eliminated, factor, loss, variables);
  } else {
    problem_->AddTerm(factor, loss, variables);
  }
}

}  // namespace plm_vins
