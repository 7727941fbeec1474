// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "common/geometry/rigid3.h"
#include "vins_estimator/geometry/line_fit.h"
#include "vins_estimator/geometry/plucker.h"

namespace plm_vins {

struct LineTriangulationOptions {
  explicit LineTriangulationOptions(double noise) : noise(noise) {}

  double noise;                      // deviation of an end point across the line, normalised
  double max_depth_deviation = 0.2;  // of the ends' depths in the first camera, relative to them
  double max_mean_error = 2.5;       // root mean square of the residuals, in units of `noise`
};

// Why a line was refused, or kOk.
enum class LineTriangulationResult {
  kOk,
  kDegenerate,    // the geometry leaves the depth open: little baseline, or along the line
  kBehind,        // an end is not in front of a camera that sees it
  kInconsistent,  // the sightings disagree: not one line
  kTooLong,       // its ends are farther apart than allowed
};

// The line in the frame of the first camera, and how well it is known.
struct TriangulatedLine {
  LineTriangulationResult result = LineTriangulationResult::kDegenerate;
  OrthonormalLine line = {0, 0, 0, 1, 0};  // valid where the result is kOk
};

// The line that all sightings agree on best: from the pair of views whose cameras are farthest off
// each other's plane (through camera and segment) in terms of its noise, refined on the end points'
// distances in all images ([Bartoli2005]). Degenerate geometry (planes nearly alike: no baseline,
// or a motion in the plane, such as along the line) is recognised by the deviation that `noise`
// causes in the depths of the ends.
TriangulatedLine TriangulateLine(const LineTriangulationOptions& options,
                                 const std::vector<LineSighting>& sightings);

// Where the line, given in a camera's frame, passes the end points of its segment in that camera:
// for each, the point of the line in the plane through camera and end point, across the segment.
struct LineEnds {
  Eigen::Vector3d start, end;
};
LineEnds EndsOf(const PluckerLine& line_C, const LineSegmentView& segment);

// Both ends are in front of the camera.
bool IsInFront(const LineEnds& ends_C);

}  // namespace plm_vins
