// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "offline/pipeline/odometry_pipeline.h"
#include "vins_estimator/output/frame_timings.h"

namespace plm_vins {

// Processing time of each stage for one image [ms].
FrameTimings TimingsOf(const PipelineFrame& frame);

}  // namespace plm_vins
