// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ceres/loss_function.h>

#include <memory>
#include <optional>

#include "common/camera/camera_model.h"
#include "vins_estimator/map/line_landmark.h"
#include "vins_estimator/map/point_landmark.h"
#include "vins_estimator/map/sliding_window.h"
#include "vins_estimator/problem/problem_options.h"
#include "vins_estimator/problem/window_problem.h"
#include "vins_estimator/problem/window_variables.h"

namespace plm_vins {

// A point of a problem, and the variables that all its views depend on, by their indices.
struct ProblemPoint {
  const PointLandmark* landmark;
  int point;
  std::optional<int> eliminated;  // as this one of the problem's landmarks; none: it is a constant
  int host_pose, extrinsic, td;
};

// The same of a line.
struct ProblemLine {
  const LineLandmark* landmark;
  int line;
  std::optional<int> eliminated;
  int host_pose, extrinsic;
};

// Adds landmarks and their views to a problem. A view depends on the readout time and on the
// intrinsics, too, where these are estimated.
class ViewTerms {
 public:
  // All must outlive this, and this the problem.
  ViewTerms(const ProblemOptions* options, const SlidingWindow* window, WindowVariables* variables,
            WindowProblem* problem);

  // A landmark, without views yet: as one of those that the problem solves for, or as it is.
  ProblemPoint AddEliminated(PointLandmark* landmark);
  ProblemLine AddEliminated(LineLandmark* landmark);
  ProblemPoint AddConstant(PointLandmark* landmark);
  ProblemLine AddConstant(LineLandmark* landmark);

  // In the host frame, where a landmark is seen the same from wherever that is.
  void AddHostView(const ProblemPoint& point);
  void AddHostView(const ProblemLine& line);
  // In another frame.
  void AddView(const ProblemPoint& point, const PointView& view);
  void AddView(const ProblemLine& line, const LineView& view);
  void AddAnchorView(const ProblemLine& line, const LineView& view);

 private:
  ProblemPoint WithVariables(const PointLandmark& landmark, int index,
                             std::optional<int> eliminated);
  ProblemLine WithVariables(const LineLandmark& landmark, int index, std::optional<int> eliminated);
  template <typename ViewFactor, typename... Indices>
  void AddPointTerm(const ProblemPoint& point, const PointView& view, Indices... variables);
  // The same, with the factor as it is but for the intrinsics.
  template <typename ViewFactor, typename... Indices>
  void AddPointFactor(const ProblemPoint& point, const PointView& view, const ViewFactor& factor,
                      Indices... variables);
  template <typename ViewFactor, typename... Indices>
  void AddLineTerm(const ProblemLine& line, const LineView& view, double weight,
                   Indices... variables);
  void AddPairView(const ProblemLine& line, const LineView& view, double weight);
  template <typename FactorType, int kCount>
  void AddTerm(std::optional<int> eliminated, const FactorType& factor,
               const ceres::LossFunction* loss, const int (&variables)[kCount]);

  const ProblemOptions* options_;
  const SlidingWindow* window_;
  WindowVariables* variables_;
  WindowProblem* problem_;
  std::unique_ptr<const CameraModel> camera_;  // as it is known; null: it is not estimated
  ceres::CauchyLoss point_loss_;
  ceres::CauchyLoss line_loss_;
};

}  // namespace plm_vins
