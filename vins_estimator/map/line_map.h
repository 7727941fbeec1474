// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "common/measurements.h"
#include "vins_estimator/geometry/line_triangulation.h"
#include "vins_estimator/map/landmark_map.h"
#include "vins_estimator/map/line_landmark.h"
#include "vins_estimator/map/sliding_window.h"
#include "vins_estimator/state/estimate_counts.h"
#include "vins_estimator/state/map_elements.h"

namespace plm_vins {

// Limits of a triangulated line, checked at triangulation and after each optimization.
struct LineLimits {
  LineLimits(double noise, double max_length) : triangulation(noise), max_length(max_length) {}

  LineTriangulationOptions triangulation;  // its mean error limit holds later, too
  double max_view_error = 5.0;             // rms of one observation, in units of the noise
  double max_length;                       // between the ends [m]
};

// Residual of an observation in the second camera.
struct RightLineResidual {
  LineView* view;
  double error;  // both ends together, in standard deviations
};

// All line tracks with observations in the window. Every observation belongs to a frame of it.
class LineMap : public LandmarkMap<LineLandmark> {
 public:
  // Adds one image's lines as observations. Segments of zero length are ignored.
  void AddFrame(const LineFrame& frame);

  // Triangulates the lines with enough observations. Lines with inconsistent observations are
  // removed; degenerate ones are kept until there is more baseline.
  LineTriangulationCounts Triangulate(const SlidingWindow& window, const LineLimits& limits);

  // Returns the optimized lines in the world, except those without an ObservedSegment().
  std::vector<MapLine> Optimized(const SlidingWindow& window) const;

  // Checks all observations of the triangulated lines: removes outlier observations, and lines that
  // are behind a camera, too long or have too large a mean error. Returns the number of removed
  // lines and observations.
  int RemoveOutliers(const SlidingWindow& window, const LineLimits& limits);

  // Returns the residuals of the optimized lines in the second camera; drops its observations of
  // lines that have no image in it.
  std::vector<RightLineResidual> RightResiduals(const SlidingWindow& window);

  // Removes the observations in an anchor.
  void RemoveAnchor(int64_t t_ns);
};

// Transforms a triangulated line to the camera of another of its observations; marks it as not
// triangulated if it passes through that camera.
void MoveHost(const SlidingWindow& window, size_t view, LineLandmark* landmark);

// Keeps a single observation of a line, which becomes its host.
void KeepOnlyView(const SlidingWindow& window, size_t view, LineLandmark* landmark);

// Returns observations of a line together with their cameras' poses.
PosedLineObservation ObservationOf(const LineView& view, const SlidingWindow& window);
std::vector<PosedLineObservation> ObservationsOf(const std::vector<LineView>& views,
                                                 const SlidingWindow& window);

// Returns the distances of the start and end of an observation from the projection of a line,
// normalized; nullopt if there is no projection.
std::optional<Eigen::Vector2d> DistancesOf(const LineView& view, const PluckerLine& line_W,
                                           const SlidingWindow& window);

// Returns a triangulated line in the world.
PluckerLine LineInWorld(const LineLandmark& landmark, const SlidingWindow& window);

// Returns the segment of a triangulated line that its observations cover together, in the world;
// nullopt if an end is behind a camera that observed it.
std::optional<MapLine> ObservedSegment(const LineLandmark& landmark, const SlidingWindow& window);

}  // namespace plm_vins
