// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <optional>

#include "common/camera/camera_model.h"
#include "linefeature_tracker/segments/line_segment.h"

namespace plm_vins {

// A point of a line and its projection. Under distortion a straight line is curved in the raw
// image; sampling in normalized coordinates follows the curve exactly.
struct SegmentSample {
  double along = 0;  // distance from the segment's start (normalized)
  Eigen::Vector2d pixel = Eigen::Vector2d::Zero();
  Eigen::Vector2d normal_px = Eigen::Vector2d::Zero();  // unit normal of the curve
  double offset_per_pixel = 0;  // normalized distance across the line per pixel along normal_px
};

// Samples the segment (normalized) at distance `along` from its start. Returns nullopt if the point
// cannot be projected.
//
// With J = d_pixel/d_xy, u the segment's direction and n its normal, the curve's tangent is J u,
// and a step of one pixel across the curve moves the point by n . J^-1 (J u)_perp / |J u| = |J u| /
// det J.
inline std::optional<SegmentSample> SampleSegment(const CameraModel& camera,
                                                  const LineSegment& segment, double along) {
  const Eigen::Vector2d direction = segment.Direction();
  const Eigen::Vector2d xy = segment.start + along * direction;
  Eigen::Matrix<double, 2, 3> d_pixel_d_point;
  const auto pixel = camera.Project(xy.homogeneous(), &d_pixel_d_point);
  if (!pixel) return std::nullopt;
  const Eigen::Matrix2d J = d_pixel_d_point.leftCols<2>();
  const Eigen::Vector2d tangent = J * direction;
  const double norm = tangent.norm();
  return SegmentSample{along, *pixel, Eigen::Vector2d(-tangent.y(), tangent.x()) / norm,
                       norm / J.determinant()};
}

constexpr double kLineBorder_px = 4;  // least distance of lines from the border of the image

// Convert a segment from normalized coordinates to raw pixels, and back. Return nullopt if an
// endpoint cannot be converted.
inline std::optional<LineSegment> ProjectSegment(const CameraModel& camera,
                                                 const LineSegment& segment) {
  const auto start = camera.Project(segment.start.homogeneous());
  const auto end = camera.Project(segment.end.homogeneous());
  if (!start || !end) return std::nullopt;
  return LineSegment{*start, *end};
}

inline std::optional<LineSegment> UnprojectSegment(const CameraModel& camera,
                                                   const LineSegment& segment_px) {
  const auto start = camera.Unproject(segment_px.start);
  const auto end = camera.Unproject(segment_px.end);
  if (!start || !end) return std::nullopt;
  return LineSegment{*start, *end};
}

}  // namespace plm_vins
