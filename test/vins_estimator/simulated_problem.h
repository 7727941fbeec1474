// SPDX-License-Identifier: BSD-3-Clause
// The least-squares problem of a simulated window, for tests of solving and marginalization.
#pragma once

#include <algorithm>
#include <vector>

#include "test/vins_estimator/simulated_window.h"
#include "vins_estimator/problem/problem_builder.h"

namespace plm_vins::testing {

// Adds the prior, motion and all landmarks of the window.
inline void AddAll(SimulatedWindow* simulated, ProblemBuilder* builder) {
  builder->AddPrior();
  for (size_t i = 1; i < simulated->window.frames.size(); ++i) builder->AddMotion(i);
  for (auto& [id, landmark] : simulated->points.landmarks()) {
    if (landmark.triangulated && landmark.observations.size() > 1) builder->AddPoint(&landmark);
  }
  for (auto& [id, landmark] : simulated->lines.landmarks()) {
    if (landmark.triangulated && landmark.observations.size() > 1) builder->AddLine(&landmark);
  }
}

// Copies the values of all variables, in their order.
inline std::vector<double> CopyValues(const WindowProblem& problem) {
  std::vector<double> values;
  for (const Variable& variable : problem.variables()) {
    values.insert(values.end(), variable.values, variable.values + variable.type().ambient_size);
  }
  return values;
}

inline void RestoreValues(const std::vector<double>& values, const WindowProblem& problem) {
  const double* next = values.data();
  for (const Variable& variable : problem.variables()) {
    std::copy(next, next + variable.type().ambient_size, variable.values);
    next += variable.type().ambient_size;
  }
}

}  // namespace plm_vins::testing
