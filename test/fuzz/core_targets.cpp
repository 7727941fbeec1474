// SPDX-License-Identifier: BSD-3-Clause
// The targets of plm_fuzz: the estimator.
#include "test/fuzz/target.h"

namespace plm_vins::fuzz {

std::vector<Target> Targets() { return {StageTarget(), DivergenceTarget()}; }

}  // namespace plm_vins::fuzz
