// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace plm_vins {

// Time at which a rolling shutter reads a row, relative to the readout time of the whole image:
// -0.5 at the top, 0 in the middle, to which the image timestamp refers (as in VINS-Mono), and 0.5
// at the bottom. `height` is that of the image [px].
inline double ReadoutShare(double row_px, int height) { return row_px / height - 0.5; }

}  // namespace plm_vins
