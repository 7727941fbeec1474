// SPDX-License-Identifier: BSD-3-Clause
// Messages with the estimator's keyframes, for mapping.
#pragma once

#include <sensor_msgs/PointCloud.h>

#include <cstdint>
#include <string>
#include <vector>

#include "common/features/placed_features.h"

namespace plm_vins {

// ~keyframe_point has VINS-Mono's format: the positions of the triangulated corners, and one
// channel for each, with x, y (normalized), u, v [px], the id (modulo kTransportableIds) and,
// unless it is 0, the number of the camera. Reading throws std::invalid_argument if a channel is
// missing or too short, or an id is invalid. It drops, and counts, implausible observations
// (common/features/feature_checks.h), positions that are not finite, and repeated ids.
sensor_msgs::PointCloud ToKeyframePoints(const std::vector<TrackedCorner>& corners, int64_t t_ns,
                                         const std::string& frame_id);
std::vector<TrackedCorner> ToCorners(const sensor_msgs::PointCloud& message, int64_t* left_out);

// ~keyframe_line has both 3-D endpoints of each line, NaN without a position, and one channel for
// each line, with the endpoints x, y, x, y (normalized), the id and, unless it is 0, the number of
// the camera. Lines without a position matter as well: they confirm lines of an earlier visit.
// Reading checks lines as it checks points.
sensor_msgs::PointCloud ToKeyframeLines(const std::vector<TrackedSegment>& segments, int64_t t_ns,
                                        const std::string& frame_id);
std::vector<TrackedSegment> ToSegments(const sensor_msgs::PointCloud& message, int64_t* left_out);

}  // namespace plm_vins
