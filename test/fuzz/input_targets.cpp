// SPDX-License-Identifier: BSD-3-Clause
// The targets of plm_fuzz_input: files and images.
#include "test/fuzz/target.h"

namespace plm_vins::fuzz {

std::vector<Target> Targets() {
  return {ConfigTarget(), AslTarget(), PointTrackerTarget(), LineTrackerTarget()};
}

}  // namespace plm_vins::fuzz
