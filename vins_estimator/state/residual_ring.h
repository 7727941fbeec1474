// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

namespace plm_vins {

// Statistics of the residuals of points in a ring of the image around the principal point.
struct ResidualRing {
  double inner_px = 0, outer_px = 0;  // radii
  int64_t count = 0;                  // number of residuals
  double radial_px = 0;               // median of the radial components, positive outwards
  double deviation_px = 0;            // standard deviation of these, from the quartiles
};

}  // namespace plm_vins
