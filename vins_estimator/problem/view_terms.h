// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ceres/loss_function.h>

#include <memory>
#include <optional>

#include "common/camera/camera_model.h"
#include "vins_estimator/least_squares/window_problem.h"
#include "vins_estimator/map/line_landmark.h"
#include "vins_estimator/map/point_landmark.h"
#include "vins_estimator/map/sliding_window.h"
#include "vins_estimator/problem/problem_options.h"
#include "vins_estimator/problem/window_variables.h"

namespace plm_vins {

// A point of a problem, with the indices of the variables that all its observations depend on.
struct ProblemPoint {
  const PointLandmark* landmark;
  int point;
  std::optional<int> eliminated;  // index among the problem's landmarks; nullopt if constant
  int host_pose, extrinsic, td;
};

// A line of a problem; see ProblemPoint.
struct ProblemLine {
  const LineLandmark* landmark;
  int line;
  std::optional<int> eliminated;
  int host_pose, extrinsic;
};

// Adds landmarks and their observations to a problem. Observations also depend on the intrinsics
// if these are estimated.
class ViewTerms {
 public:
  // All arguments must outlive this object. The problem refers to its losses, so the problem must
  // not be evaluated after its destruction.
  ViewTerms(const ProblemOptions* options, const SlidingWindow* window, WindowVariables* variables,
            WindowProblem* problem);

  // Adds a landmark without observations: as a variable to be eliminated, or as a constant.
  ProblemPoint AddEliminated(PointLandmark* landmark);
  ProblemLine AddEliminated(LineLandmark* landmark);
  ProblemPoint AddConstant(PointLandmark* landmark);
  ProblemLine AddConstant(LineLandmark* landmark);

  // Adds the observation in the host frame, which does not depend on the pose.
  void AddHostView(const ProblemPoint& point);
  void AddHostView(const ProblemLine& line);
  // Adds an observation in another frame; those in anchors have lower weight.
  void AddView(const ProblemPoint& point, const PointView& view);
  void AddView(const ProblemLine& line, const LineView& view);
  void AddAnchorView(const ProblemLine& line, const LineView& view);
  // Adds the measurements of depth in one image: the observation in the second camera, and the
  // measured depth, if the host or another frame has them.
  void AddDepth(const ProblemPoint& point, const PointView& view);
  void AddDepth(const ProblemLine& line, const LineView& view);

 private:
  ProblemPoint WithVariables(const PointLandmark& landmark, int index,
                             std::optional<int> eliminated);
  ProblemLine WithVariables(const LineLandmark& landmark, int index, std::optional<int> eliminated);
  // Adds an observation, with the intrinsics if these are estimated.
  template <typename ViewFactor, typename... Indices>
  void AddPointTerm(const ProblemPoint& point, const PointView& view, Indices... variables);
  template <typename ViewFactor, typename... Indices>
  void AddLineTerm(const ProblemLine& line, const LineView& view, double weight,
                   Indices... variables);
  // Adds an observation in the second camera likewise.
  template <typename ViewFactor, typename... Indices>
  void AddRightPointTerm(const ProblemPoint& point, const PointView& view, Indices... variables);
  template <typename ViewFactor, typename... Indices>
  void AddRightLineTerm(const ProblemLine& line, const LineView& view, Indices... variables);
  void AddMeasuredDepth(const ProblemPoint& point, const PointView& view);
  void AddPairView(const ProblemLine& line, const LineView& view, double weight);
  template <typename FactorType, int kCount>
  void AddTerm(std::optional<int> eliminated, const FactorType& factor,
               const ceres::LossFunction* loss, const int (&variables)[kCount]);

  const ProblemOptions* options_;
  const SlidingWindow* window_;
  WindowVariables* variables_;
  WindowProblem* problem_;
  // Null if the intrinsics are not estimated.
  std::unique_ptr<const CameraModel> camera_, right_camera_;
  ceres::CauchyLoss point_loss_;
  ceres::CauchyLoss line_loss_;
  ceres::CauchyLoss right_loss_;
  ceres::CauchyLoss depth_loss_;
};

}  // namespace plm_vins
