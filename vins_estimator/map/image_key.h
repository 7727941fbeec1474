// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

namespace plm_vins {

// Identifies an image: the time of its frame, and the number of its camera. Observations of a
// landmark are ordered by it.
struct ImageKey {
  int64_t t_ns = 0;
  int camera = 0;

  friend bool operator==(const ImageKey& a, const ImageKey& b) {
    return a.t_ns == b.t_ns && a.camera == b.camera;
  }
  friend bool operator<(const ImageKey& a, const ImageKey& b) {
    return a.t_ns != b.t_ns ? a.t_ns < b.t_ns : a.camera < b.camera;
  }
};

}  // namespace plm_vins
