// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>

#include "vins_estimator/equations/window_problem.h"
#include "vins_estimator/map/sliding_window.h"
#include "vins_estimator/problem/problem_options.h"
#include "vins_estimator/problem/window_variables.h"

namespace plm_vins {

// Adds the terms between consecutive frames of a window to a problem.
class MotionTerms {
 public:
  // All arguments must outlive this object.
  MotionTerms(const ProblemOptions* options, const SlidingWindow* window,
              WindowVariables* variables, WindowProblem* problem)
      : options_(options), window_(window), variables_(variables), problem_(problem) {}

  // Adds the IMU factor between frames `index` - 1 and `index`, and the standstill factors if frame
  // `index` is stationary.
  void Add(size_t index);

 private:
  const ProblemOptions* options_;
  const SlidingWindow* window_;
  WindowVariables* variables_;
  WindowProblem* problem_;
};

}  // namespace plm_vins
