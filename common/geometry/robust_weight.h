// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace plm_vins {

// Weight of the Geman-McClure loss in iteratively reweighted least squares ([Zhang1997]): one at
// zero error, and nearly zero for errors of several times `scale`.
inline double GemanMcClureWeight(double error, double scale) {
  const double ratio = error / scale;
  return 1 / ((1 + ratio * ratio) * (1 + ratio * ratio));
}

}  // namespace plm_vins
