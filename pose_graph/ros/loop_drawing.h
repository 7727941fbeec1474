// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <opencv2/core.hpp>

#include "common/camera/camera_model.h"
#include "pose_graph/verification/loop_refinement.h"

namespace plm_vins {

// Draws both visits of a place side by side, the earlier one on the left, as CV_8UC3 at half
// resolution: each landmark in the earlier image joined with its corner in the later one (green),
// and the lines observed in both (orange). The images are CV_8UC1 of any size; the left half is
// black if `earlier` is empty.
cv::Mat DrawLoop(const CameraModels& cameras, const LoopObservations& observations,
                 const cv::Mat& earlier, const cv::Mat& later);

}  // namespace plm_vins
