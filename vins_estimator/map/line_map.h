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

// Limits that a line must meet to be triangulated, and from then on.
struct LineLimits {
  LineLimits(double noise, double max_length) : triangulation(noise), max_length(max_length) {}

  LineTriangulationOptions triangulation;  // the mean error of all views stays as limited there
  double max_view_error = 5.0;             // of one view, root mean square in units of the noise
  double max_length;                       // between the ends [m]
};

// All line tracks with views in the window. Every view belongs to a frame of the window.
class LineMap : public LandmarkMap<LineLandmark> {
 public:
  // Adds one image's lines as views. A segment without length is left out.
  void AddFrame(const LineFrame& frame);

  // Triangulates what can be. Lines whose sightings contradict each other are removed, those with
  // too little baseline wait.
  LineTriangulationCounts Triangulate(const SlidingWindow& window, const LineLimits& limits);

  // Those that are optimised, in the world, as far as ObservedSegment() knows them.
  std::vector<MapLine> Optimized(const SlidingWindow& window) const;

  // Judges the triangulated lines by all their views: removes single views that do not fit, lines
  // behind a camera, longer than allowed or with too large a mean error. Returns how many lines and
  // views were removed.
  int RemoveOutliers(const SlidingWindow& window, const LineLimits& limits);

  // Removes what an anchor has seen.
  void RemoveAnchor(int64_t t_ns);
};

// Expresses a triangulated line in the camera of another of its views; not triangulated where it
// passes through that camera.
void MoveHost(const SlidingWindow& window, size_t view, LineLandmark* landmark);

// Leaves one view of a line, as its host.
void KeepOnlyView(const SlidingWindow& window, size_t view, LineLandmark* landmark);

// A view, and views, of a line with the cameras' poses.
LineSighting SightingOf(const LineView& view, const SlidingWindow& window);
std::vector<LineSighting> SightingsOf(const std::vector<LineView>& views,
                                      const SlidingWindow& window);

// How far the start and the end of a view are from a line in the world, across it, normalised.
// Nothing where the line has no image there.
std::optional<Eigen::Vector2d> DistancesOf(const LineView& view, const PluckerLine& line_W,
                                           const SlidingWindow& window);

// A triangulated line in the world.
PluckerLine LineInWorld(const LineLandmark& landmark, const SlidingWindow& window);

// The part of a triangulated line that its views have seen together, in the world. Nothing where
// an end is not in front of a camera that saw it.
std::optional<MapLine> ObservedSegment(const LineLandmark& landmark, const SlidingWindow& window);

}  // namespace plm_vins
