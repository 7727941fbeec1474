// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <opencv2/core.hpp>

#include "common/camera/camera_model.h"
#include "pose_graph/verification/loop_refinement.h"

namespace plm_vins {

// Both visits of a place side by side, the earlier one on the left, as CV_8UC3 at half resolution:
// each landmark where the earlier camera saw it, joined with the corner where the later one sees it
// (green), and the lines that both see (orange). The images are CV_8UC1 of any size; the left half
// stays black where `earlier` is empty.
cv::Mat DrawLoop(const CameraModel& camera, const LoopSightings& sightings, const cv::Mat& earlier,
                 const cv::Mat& later);

}  // namespace plm_vins
