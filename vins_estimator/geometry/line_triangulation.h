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

  double noise;  // standard deviation of an end point across the line, normalized
  double max_depth_deviation = 0.2;  // relative deviation of the ends' depths in the first camera
  double max_mean_error = 2.5;       // root mean square of the residuals, in units of `noise`
};

// Reason for which a line was rejected, or kOk.
enum class LineTriangulationResult {
  kOk,
  kDegenerate,    // depth unobservable: short baseline, or motion in the viewing plane
  kBehind,        // an end is behind a camera that observed it
  kInconsistent,  // the observations do not fit one line
  kTooLong,       // the ends are farther apart than allowed
};

// The triangulated line in the frame of the first camera, and the result.
struct TriangulatedLine {
  LineTriangulationResult result = LineTriangulationResult::kDegenerate;
  OrthonormalLine line = {0, 0, 0, 1, 0};  // valid if the result is kOk
};

// Triangulates the line that fits all observations best. It is initialized from the pair of
// observations with the widest baseline relative to its noise (distance of each camera from the
// other's viewing plane, the plane through camera and segment), then refined on the end point
// distances in all images ([Bartoli2005]). Degenerate geometry (almost equal viewing planes, from a
// short baseline or motion within the plane) is detected by the standard deviation that `noise`
// causes in the depths of the ends.
TriangulatedLine TriangulateLine(const LineTriangulationOptions& options,
                                 const std::vector<PosedLineObservation>& observations);

// Points of the line that correspond to the end points of its segment, in the camera frame: the
// intersections of the line with the planes through the camera and each end point, perpendicular to
// the segment in the image.
struct LineEnds {
  Eigen::Vector3d start, end;
};
LineEnds EndsOf(const PluckerLine& line_C, const SegmentEndPoints& segment);

// Returns whether both ends are in front of the camera.
bool IsInFront(const LineEnds& ends_C);

}  // namespace plm_vins
