// SPDX-License-Identifier: BSD-3-Clause
#include "common/process_setup.h"

#if __has_include(<malloc.h>)
#include <malloc.h>
#endif

#include <opencv2/core/utility.hpp>

namespace plm_vins {

void SetUpProcess() {
  cv::setNumThreads(1);
#ifdef M_MMAP_THRESHOLD
  constexpr int kMegabyte = 1 << 20;
  mallopt(M_MMAP_THRESHOLD, 32 * kMegabyte);   // the largest accepted value
  mallopt(M_TRIM_THRESHOLD, 256 * kMegabyte);  // more free memory is returned to the system
#endif
}

}  // namespace plm_vins
