// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <deque>
#include <vector>

#include "common/measurements.h"

namespace plm_vins {

// Number of points that both images saw.
int CountCommonPoints(const PointFrame& first, const PointFrame& second);

// Median way of the points that both images saw, normalised; 0 without any.
double MedianFlow(const PointFrame& first, const PointFrame& second);

// At most `max_frames` indices, the oldest and the newest frame among them, spread evenly over time
// and image motion together: motion draws frames, and a still part is not left empty.
std::vector<size_t> SelectFrames(const std::deque<FrameMeasurement>& frames, size_t max_frames);

// The frames at `indices`, the IMU samples between them joined.
std::vector<FrameMeasurement> JoinFrames(const std::deque<FrameMeasurement>& frames,
                                         const std::vector<size_t>& indices);

}  // namespace plm_vins
