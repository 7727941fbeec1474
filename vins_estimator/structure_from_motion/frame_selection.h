// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <deque>
#include <vector>

#include "common/measurements.h"

namespace plm_vins {

// Returns the number of points that both images observe.
int CountCommonPoints(const PointFrame& first, const PointFrame& second);

// Returns the median displacement of the points that both images observe, normalized; 0 if there
// are none.
double MedianFlow(const PointFrame& first, const PointFrame& second);

// Returns at most `max_frames` indices, always with the oldest and the newest frame, evenly spread
// over the mean of time and image motion: more frames where there is motion, but some at
// standstill, too.
std::vector<size_t> SelectFrames(const std::deque<FrameMeasurement>& frames, size_t max_frames);

// Returns the frames at `indices`, with the IMU samples between them joined.
std::vector<FrameMeasurement> JoinFrames(const std::deque<FrameMeasurement>& frames,
                                         const std::vector<size_t>& indices);

}  // namespace plm_vins
