// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ceres/loss_function.h>

#include <cstddef>

#include "common/measurements.h"
#include "vins_estimator/equations/marginalization_prior.h"
#include "vins_estimator/equations/window_problem.h"
#include "vins_estimator/map/line_map.h"
#include "vins_estimator/map/point_map.h"
#include "vins_estimator/map/sliding_window.h"
#include "vins_estimator/problem/motion_terms.h"
#include "vins_estimator/problem/observation_terms.h"
#include "vins_estimator/problem/problem_options.h"
#include "vins_estimator/problem/window_variables.h"

namespace plm_vins {

// Assembles a WindowProblem from parts of the window. It alone defines which variables and factors
// belong together, for optimization (all parts) and marginalization (the parts that leave).
class ProblemBuilder {
 public:
  // The window and the prior must outlive the problem.
  ProblemBuilder(const ProblemOptions& options, SlidingWindow* window,
                 const MarginalizationPrior* prior);

  // Adds the whole window with the optimized landmarks.
  void AddAll(PointMap* points, LineMap* lines);

  void AddPrior();
  // Adds the IMU factor between frames `index` - 1 and `index`, and standstill factors if
  // stationary.
  void AddMotion(size_t index) { motion_.Add(index); }
  // Adds the priors between the extrinsics of cameras.
  void AddExtrinsicsPriors();
  // Adds a triangulated landmark with its observations before `until_ns`, and with the first one of
  // the newest frame in any case.
  void AddPoint(PointLandmark* landmark, int64_t until_ns = kEndOfTime_ns);
  // Adds a line in the same way, with its observations in anchors and its Manhattan axis, if any.
  void AddLine(LineLandmark* landmark, int64_t until_ns = kEndOfTime_ns);

  const WindowProblem& problem() const { return problem_; }

 private:
  template <typename Landmark>
  void AddObservations(const ProblemLandmark<Landmark>& landmark, int64_t until_ns);

  const ProblemOptions options_;
  const SlidingWindow* window_;
  const MarginalizationPrior* prior_;
  WindowProblem problem_;
  WindowVariables variables_;
  MotionTerms motion_;
  ObservationTerms observations_;
  ceres::TukeyLoss manhattan_loss_;
};

}  // namespace plm_vins
