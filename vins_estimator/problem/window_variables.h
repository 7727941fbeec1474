// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>

#include "vins_estimator/equations/marginalization_prior.h"
#include "vins_estimator/equations/variable.h"
#include "vins_estimator/equations/window_problem.h"
#include "vins_estimator/map/sliding_window.h"

namespace plm_vins {

// Adds the variables of a window other than landmarks to a problem when terms first use them, and
// returns their indices in the problem.
class WindowVariables {
 public:
  using IsConstant = std::function<bool(const BlockId&)>;

  // `first_estimates` is the prior whose variables are linearized at its linearization points; if
  // null, all variables are linearized at the current values. The other arguments must outlive the
  // problem.
  WindowVariables(SlidingWindow* window, IsConstant is_constant,
                  const MarginalizationPrior* first_estimates, WindowProblem* problem);

  int Pose(int64_t t_ns) { return Add({BlockKind::kPose, t_ns}); }  // frame or anchor
  int Motion(int64_t t_ns) { return Add({BlockKind::kMotion, t_ns}); }
  int Extrinsics(int camera) { return Add({BlockKind::kExtrinsic, camera}); }
  int DepthStream() { return Add({BlockKind::kDepthStream, 0}); }
  int TimeOffset() { return Add({BlockKind::kTimeOffset, 0}); }
  int Intrinsics(int camera) { return Add({BlockKind::kIntrinsics, camera}); }
  // Adds any of these variables.
  int Add(const BlockId& id);

 private:
  double* Values(const BlockId& id);

  SlidingWindow* window_;
  IsConstant is_constant_;
  const MarginalizationPrior* first_estimates_;
  WindowProblem* problem_;
};

}  // namespace plm_vins
