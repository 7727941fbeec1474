// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ceres/loss_function.h>

#include <Eigen/Core>
#include <initializer_list>
#include <memory>
#include <optional>
#include <vector>

#include "common/camera/camera_model.h"
#include "vins_estimator/equations/window_problem.h"
#include "vins_estimator/map/line_landmark.h"
#include "vins_estimator/map/point_landmark.h"
#include "vins_estimator/map/sliding_window.h"
#include "vins_estimator/problem/problem_options.h"
#include "vins_estimator/problem/window_variables.h"

namespace plm_vins {

// A landmark of a problem, with the indices of the variables that all its observations depend on.
template <typename Landmark>
struct ProblemLandmark {
  const Landmark* landmark;
  int variable;
  std::optional<int> eliminated;  // index among the problem's landmarks; nullopt if constant
  int host_pose, host_extrinsics;
};
using ProblemPoint = ProblemLandmark<PointLandmark>;
using ProblemLine = ProblemLandmark<LineLandmark>;

// Adds landmarks and their observations to a problem. Observations also depend on the intrinsics
// of the camera if these are estimated.
class ObservationTerms {
 public:
  // All arguments must outlive this object. The problem refers to its losses, so the problem must
  // not be evaluated after its destruction.
  ObservationTerms(const ProblemOptions* options, const SlidingWindow* window,
                   WindowVariables* variables, WindowProblem* problem);

  // Adds a landmark without observations: as a variable to be eliminated, or as a constant.
  ProblemPoint AddEliminated(PointLandmark* landmark);
  ProblemLine AddEliminated(LineLandmark* landmark);
  ProblemPoint AddConstant(PointLandmark* landmark);
  ProblemLine AddConstant(LineLandmark* landmark);

  // Adds an observation; those in anchors have lower weight.
  void AddObservation(const ProblemPoint& point, const PointLandmark::Observation& observation);
  void AddObservation(const ProblemLine& line, const LineLandmark::Observation& observation);
  void AddAnchorObservation(const ProblemLine& line, const LineLandmark::Observation& observation);
  // Adds the depth that an observation measured, if it did.
  void AddDepth(const ProblemPoint& point, const PointLandmark::Observation& observation);
  void AddDepth(const ProblemLine&, const LineLandmark::Observation&) {}

 private:
  template <typename Landmark>
  ProblemLandmark<Landmark> WithVariables(const Landmark& landmark, int index,
                                          std::optional<int> eliminated);
  // Returns the variables that an observation depends on: those of its chain, and others.
  template <typename Landmark>
  TermVariables VariablesOf(const ProblemLandmark<Landmark>& landmark, const ImageKey& image,
                            std::initializer_list<int> others);
  void AddLine(const ProblemLine& line, const LineLandmark::Observation& observation,
               double weight);
  template <typename FactorType>
  void AddTerm(std::optional<int> eliminated, const FactorType& factor,
               const ceres::LossFunction* loss, const TermVariables& variables);

  const ProblemOptions* options_;
  const SlidingWindow* window_;
  WindowVariables* variables_;
  WindowProblem* problem_;
  // By camera, with the intrinsics of the rays; empty if intrinsics are not estimated.
  std::vector<std::unique_ptr<const CameraModel>> cameras_;
  ceres::CauchyLoss point_loss_;
  ceres::CauchyLoss line_loss_;
  ceres::CauchyLoss depth_loss_;
};

// Expected observations of landmarks in the state of the window are the linearization points for
// the intrinsics. Derivatives at the observed rays would be correlated with the noise of the
// residuals and would bias the focal length to be too short.

// Returns the predicted ray; the observed one if the landmark is behind the camera.
Eigen::Vector2d ExpectedRay(const PointLandmark& landmark,
                            const PointLandmark::Observation& observation,
                            const SlidingWindow& window);

// Returns the points of the projected line nearest to the observed end points; these themselves if
// the line has no projection.
SegmentEndPoints ExpectedEnds(const LineLandmark& landmark,
                              const LineLandmark::Observation& observation,
                              const SlidingWindow& window);

}  // namespace plm_vins
