// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace plm_vins {

// Weight of the Geman-McClure loss in iteratively reweighted least squares ([Zhang1997]): one for
// no error, and next to nothing for errors of several times `scale`, so that an outlier has no say.
inline double GemanMcClureWeight(double error, double scale) {
  const double ratio = error / scale;
  return 1 / ((1 + ratio * ratio) * (1 + ratio * ratio));
}

}  // namespace plm_vins
