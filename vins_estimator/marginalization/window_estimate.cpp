// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/marginalization/window_estimate.h"

#include "vins_estimator/marginalization/window_marginalizer.h"

namespace plm_vins {

void WindowEstimate::DropSecondNewest() {
  prior = prior.Marginalize(IsOfFrame(map.window.second_newest().state.t_ns));
  map.DropSecondNewest();
}

DepartedLandmarks WindowEstimate::SlideOldest(const ProblemOptions& options, bool stays_as_anchor) {
  prior = MarginalizeOldest(options, prior, &map, stays_as_anchor);
  return map.SlideOldest(stays_as_anchor);
}

void WindowEstimate::RemoveAnchor(int64_t t_ns) {
  prior = prior.Marginalize(IsOfFrame(t_ns));
  map.RemoveAnchor(t_ns);
}

}  // namespace plm_vins
