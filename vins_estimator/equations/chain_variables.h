// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <initializer_list>

#include "vins_estimator/equations/window_problem.h"
#include "vins_estimator/factors/camera_chain.h"

namespace plm_vins {

// Variables at both ends of a CameraChain, as indices in a problem.
struct ChainEnds {
  int host_pose, host_extrinsics;
  int target_pose, target_extrinsics;
};

// Returns the variables that do not cancel in an observation of this kind, in the order of its
// factor's blocks, and after them `others`.
inline TermVariables ChainVariables(const ChainKind& kind, const ChainEnds& ends,
                                    std::initializer_list<int> others) {
  TermVariables variables{};
  if (!kind.is_host()) variables.Add(ends.host_extrinsics);
  if (!kind.same_frame) {
    variables.Add(ends.host_pose);
    variables.Add(ends.target_pose);
  }
  if (!kind.same_camera) variables.Add(ends.target_extrinsics);
  for (const int other : others) variables.Add(other);
  return variables;
}

}  // namespace plm_vins
