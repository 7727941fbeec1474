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

// Residual of an observation after optimization.
struct LineResidual {
  int64_t id;  // of the landmark
  ImageKey image;
  bool is_in_host_camera;
  double error;  // both ends together, in standard deviations; infinite without projection
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

  // Judges lines by their observations in the host's camera: removes outlier observations, and
  // lines that are behind it, too long or have too large a mean error. Returns the number of
  // removed lines and observations.
  int RemoveOutliers(const SlidingWindow& window, const LineLimits& limits);

  // Returns the residuals of the optimized lines in the images of a camera. `noise` is the standard
  // deviation of an end point that states none.
  std::vector<LineResidual> ResidualsIn(int camera, double noise,
                                        const SlidingWindow& window) const;

  // Removes the observations in an anchor.
  void RemoveAnchor(int64_t t_ns);
};

// Transforms a triangulated line to the camera of another of its observations; marks it as not
// triangulated if it passes through that camera.
void MoveHost(const SlidingWindow& window, size_t observation, LineLandmark* landmark);

// Keeps the observations in the newest frame only, the first of which becomes the host.
void KeepNewestFrame(const SlidingWindow& window, LineLandmark* landmark);

// Returns the observations by the host's camera together with its poses.
std::vector<PosedLineObservation> PosedOfHostCamera(const LineLandmark& landmark,
                                                    const SlidingWindow& window);

// Returns the distances of the start and end of an observation from the projection of a line,
// normalized; nullopt if there is no projection.
std::optional<Eigen::Vector2d> DistancesOf(const LineLandmark::Observation& observation,
                                           const PluckerLine& line_W, const SlidingWindow& window);

// Returns a triangulated line in the world.
PluckerLine LineInWorld(const LineLandmark& landmark, const SlidingWindow& window);

// Returns the segment of a triangulated line that the observations by the host's camera cover
// together, in the world; nullopt if an end is behind it.
std::optional<MapLine> ObservedSegment(const LineLandmark& landmark, const SlidingWindow& window);

}  // namespace plm_vins
