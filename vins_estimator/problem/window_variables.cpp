// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/problem/window_variables.h"

#include <stdexcept>
#include <utility>

namespace plm_vins {

WindowVariables::WindowVariables(SlidingWindow* window, IsConstant is_constant,
                                 const MarginalizationPrior* first_estimates,
                                 WindowProblem* problem)
    : window_(window),
      is_constant_(std::move(is_constant)),
      first_estimates_(first_estimates),
      problem_(problem) {}

int WindowVariables::Add(const BlockId& id) {
  const int known = problem_->Find(id);
  if (known >= 0) return known;
  return problem_->AddVariable(id, Values(id), is_constant_(id),
                               first_estimates_ ? first_estimates_->Linearization(id) : nullptr);
}

double* WindowVariables::Values(const BlockId& id) {
  switch (id.kind) {
    case BlockKind::kExtrinsic:
      return window_->cameras[id.key].extrinsics.data();
    case BlockKind::kDepthStream:
      return window_->depth_stream.data();
    case BlockKind::kTimeOffset:
      return &window_->td;
    case BlockKind::kIntrinsics:
      return window_->cameras[id.key].intrinsics.data();
    case BlockKind::kPose:
      return window_->StateAt(id.key).pose.data();
    case BlockKind::kMotion:
      return window_->FrameAt(id.key).state.motion.data();
    default:
      throw std::logic_error("landmarks are added with their terms");
  }
}

}  // namespace plm_vins
