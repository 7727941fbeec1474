// SPDX-License-Identifier: BSD-3-Clause
// The targets of plm_fuzz: all except those for ROS input.
#include "test/fuzz/target.h"

namespace plm_vins::fuzz {

std::vector<Target> Targets() {
  return {ConfigTarget(),     AslTarget(),          MapTarget(),        StageTarget(),
          DivergenceTarget(), PointTrackerTarget(), LineTrackerTarget()};
}

}  // namespace plm_vins::fuzz
