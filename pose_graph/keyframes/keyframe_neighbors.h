// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <vector>

#include "pose_graph/keyframes/keyframe.h"

namespace plm_vins {

// Returns the numbers of the keyframes at most `radius` before and after `number` in the same
// world, including itself.
inline std::vector<int> NumbersAround(const std::vector<Keyframe>& keyframes, int number,
                                      int radius) {
  std::vector<int> numbers;
  const int end = std::min(number + radius + 1, static_cast<int>(keyframes.size()));
  for (int i = std::max(0, number - radius); i < end; ++i) {
    if (keyframes[i].world == keyframes[number].world) numbers.push_back(i);
  }
  return numbers;
}

}  // namespace plm_vins
