// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ceres/loss_function.h>

#include <cstddef>

#include "vins_estimator/map/line_map.h"
#include "vins_estimator/map/point_map.h"
#include "vins_estimator/map/sliding_window.h"
#include "vins_estimator/problem/marginalization_prior.h"
#include "vins_estimator/problem/motion_terms.h"
#include "vins_estimator/problem/problem_options.h"
#include "vins_estimator/problem/view_terms.h"
#include "vins_estimator/problem/window_problem.h"
#include "vins_estimator/problem/window_variables.h"

namespace plm_vins {

// Puts the parts of the window into a WindowProblem: one place that knows which variables and
// factors belong together, for the optimisation (all parts) and the marginalisation (the parts that
// leave the window).
class ProblemBuilder {
 public:
  // The window and the prior must outlive the problem.
  ProblemBuilder(const ProblemOptions& options, SlidingWindow* window,
                 const MarginalizationPrior* prior);

  // The whole window, with the landmarks that are optimised.
  void AddAll(PointMap* points, LineMap* lines);

  void AddPrior();
  // The IMU between frame `index` - 1 and `index`, and that they stood still where they did.
  void AddMotion(size_t index) { motion_.Add(index); }
  // All views of a triangulated landmark.
  void AddPoint(PointLandmark* landmark);
  // The same, with what anchors have seen of it, and that it runs along its Manhattan axis, if any.
  void AddLine(LineLandmark* landmark);

  const WindowProblem& problem() const { return problem_; }

 private:
  const ProblemOptions options_;
  const SlidingWindow* window_;
  const MarginalizationPrior* prior_;
  WindowProblem problem_;
  WindowVariables variables_;
  MotionTerms motion_;
  ViewTerms views_;
  ceres::TukeyLoss manhattan_loss_;
};

}  // namespace plm_vins
