// SPDX-License-Identifier: BSD-3-Clause
// The least-squares problem of a simulated window and how it slides, for the tests of solving and
// marginalising.
#pragma once

#include "test/vins_estimator/simulated_window.h"
#include "vins_estimator/marginalization/window_marginalizer.h"
#include "vins_estimator/problem/problem_builder.h"

namespace plm_vins::testing {

// All that is in the window, and the prior.
inline void AddAll(SimulatedWindow* simulated, ProblemBuilder* builder) {
  builder->AddPrior();
  for (size_t i = 1; i < simulated->window.frames.size(); ++i) builder->AddMotion(i);
  for (auto& [id, landmark] : simulated->points.landmarks()) {
    if (landmark.triangulated && landmark.views.size() > 1) builder->AddPoint(&landmark);
  }
  for (auto& [id, landmark] : simulated->lines.landmarks()) {
    if (landmark.triangulated && landmark.views.size() > 1) builder->AddLine(&landmark);
  }
}

// Folds the oldest frame into the prior and takes out what was folded in.
inline void Slide(const ProblemOptions& options, SimulatedWindow* simulated,
                  MarginalizationPrior* prior, bool keep_pose = false) {
  const int64_t oldest_ns = simulated->window.frames.front().state.t_ns;
  *prior = MarginalizeOldest(options, *prior, &simulated->window, &simulated->points,
                             &simulated->lines, keep_pose);
  simulated->points.RemoveIf([oldest_ns](const PointLandmark& landmark) {
    return landmark.triangulated && landmark.host().t_ns == oldest_ns;
  });
  simulated->lines.RemoveIf([oldest_ns](const LineLandmark& landmark) {
    return landmark.triangulated && landmark.host().t_ns == oldest_ns;
  });
  simulated->points.RemoveFrame(simulated->window, oldest_ns);
  simulated->lines.RemoveFrame(simulated->window, oldest_ns);
  if (keep_pose) {
    simulated->window.TurnOldestIntoAnchor();
  } else {
    simulated->window.RemoveOldest();
  }
}

}  // namespace plm_vins::testing
