// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "offline/pipeline/odometry_pipeline.h"
#include "vins_estimator/output/frame_columns.h"

namespace plm_vins {

// Returns the processing times and feature counts of one frame.
FrameColumns ColumnsOf(const PipelineFrame& frame);

}  // namespace plm_vins
