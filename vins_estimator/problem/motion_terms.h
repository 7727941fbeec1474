// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>

#include "vins_estimator/map/sliding_window.h"
#include "vins_estimator/problem/problem_options.h"
#include "vins_estimator/problem/window_problem.h"
#include "vins_estimator/problem/window_variables.h"

namespace plm_vins {

// Adds what joins the frames of a window to a problem.
class MotionTerms {
 public:
  // All must outlive this.
  MotionTerms(const ProblemOptions* options, const SlidingWindow* window,
              WindowVariables* variables, WindowProblem* problem)
      : options_(options), window_(window), variables_(variables), problem_(problem) {}

  // The IMU between frame `index` - 1 and `index`, and that they stood still where they did.
  void Add(size_t index);

 private:
  const ProblemOptions* options_;
  const SlidingWindow* window_;
  WindowVariables* variables_;
  WindowProblem* problem_;
};

}  // namespace plm_vins
