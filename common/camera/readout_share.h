// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace plm_vins {

// When a rolling shutter reads a row, as a share of the read-out time of the whole image: -0.5 at
// the top, 0 in the middle, which the image's stamp belongs to (as in VINS-Mono), 0.5 at the
// bottom. `height` is that of the image [px].
inline double ReadoutShare(double row_px, int height) { return row_px / height - 0.5; }

}  // namespace plm_vins
