// SPDX-License-Identifier: BSD-3-Clause
#include "offline/results/pipeline_timings.h"

namespace plm_vins {

FrameTimings TimingsOf(const PipelineFrame& frame) {
  const EstimatorTimings& estimator = frame.output.timings;
  FrameTimings timings{};
  timings[kPointTracking] = frame.point_tracking_ms;
  timings[kLineDetection] = frame.line_tracking.detection_ms;
  timings[kLineTracking] = frame.line_tracking_ms;
  timings[kInitialization] = estimator.initialization;
  timings[kLineMerging] = estimator.line_merging;
  timings[kOptimization] = estimator.optimization;
  timings[kMarginalization] = estimator.marginalization;
  timings[kEstimator] = estimator.total;
  timings[kTotal] = frame.point_tracking_ms + frame.line_tracking_ms + estimator.total;
  return timings;
}

}  // namespace plm_vins
