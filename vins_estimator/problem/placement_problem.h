// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "vins_estimator/equations/window_problem.h"
#include "vins_estimator/map/local_map.h"
#include "vins_estimator/problem/motion_terms.h"
#include "vins_estimator/problem/observation_terms.h"
#include "vins_estimator/problem/problem_options.h"
#include "vins_estimator/problem/window_variables.h"

namespace plm_vins {

// The problem that estimates only the newest frames of a window: their states are constrained by
// the IMU and by observations of landmarks that were already optimized. Everything else is held
// fixed. Jacobians are evaluated at the current values.
class PlacementProblem {
 public:
  // Estimates the frames after `known_until_ns`. The map must outlive the problem.
  PlacementProblem(const ProblemOptions& options, LocalMap* map, int64_t known_until_ns);

  const WindowProblem& problem() const { return problem_; }

 private:
  template <typename Landmark>
  void AddNewObservations(Landmark* landmark);

  const ProblemOptions options_;
  const int64_t known_until_ns_;
  WindowProblem problem_;
  WindowVariables variables_;
  MotionTerms motion_;
  ObservationTerms observations_;
};

}  // namespace plm_vins
