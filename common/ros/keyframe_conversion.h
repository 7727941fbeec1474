// SPDX-License-Identifier: BSD-3-Clause
// Keyframes of the estimator for those who build maps, as messages.
#pragma once

#include <sensor_msgs/PointCloud.h>

#include <Eigen/Geometry>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "common/features/placed_features.h"

namespace plm_vins {

// ~keyframe_point as in VINS-Mono: the places of the corners that have one, and one channel for
// each, with x, y (normalised), u, v [px] and the id, which travels as that of features does.
// Reading throws std::invalid_argument where a channel is missing or too short, or an id is none
// that travels. It leaves out, and counts, what cannot be true (common/features/feature_checks.h),
// a place that is not finite, and the second of an id.
sensor_msgs::PointCloud ToKeyframePoints(const std::vector<TrackedCorner>& corners, int64_t t_ns,
                                         const std::string& frame_id);
std::vector<TrackedCorner> ToCorners(const sensor_msgs::PointCloud& message, int64_t* left_out);

// ~keyframe_line: both ends in space of each line, not a number where it has no place, and one
// channel for each line, with the ends x, y, x, y (normalised) and the id. Lines without a place
// count as well: they show that what was there at an earlier visit still is. Where the scene has a
// Manhattan frame, a last channel of that name has R_O_Manhattan as w, x, y, z. Reading is as
// above, and throws where that is no rotation.
sensor_msgs::PointCloud ToKeyframeLines(const std::vector<TrackedSegment>& segments,
                                        const std::optional<Eigen::Quaterniond>& R_O_Manhattan,
                                        int64_t t_ns, const std::string& frame_id);
std::vector<TrackedSegment> ToSegments(const sensor_msgs::PointCloud& message, int64_t* left_out);
std::optional<Eigen::Quaterniond> ToManhattanFrame(const sensor_msgs::PointCloud& message);

}  // namespace plm_vins
