// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "common/measurements.h"
#include "vins_estimator/map/line_aliases.h"
#include "vins_estimator/map/line_map.h"
#include "vins_estimator/map/line_memory.h"
#include "vins_estimator/map/point_map.h"
#include "vins_estimator/map/sliding_window.h"
#include "vins_estimator/state/estimator_output.h"
#include "vins_estimator/state/map_elements.h"

namespace plm_vins {

struct LocalMapOptions {
  LocalMapOptions(double line_noise, bool remember_lines)
      : line_noise(line_noise), remember_lines(remember_lines) {}

  double line_noise;    // standard deviation of an end point across the line, normalized
  bool remember_lines;  // keep lines that leave the window, to recognize them later
};

// Triangulated landmarks that left the map with a frame.
struct DepartedLandmarks {
  std::vector<MapPoint> points;
  std::vector<MapLine> lines;  // whole observed extent if remembered, else the extent in the window
};

// The frames of the window and the landmarks that they observe. Values may be changed from outside,
// but frames and anchors are added and removed only by these methods, which keep an invariant:
// every observation of a landmark, and every anchor observation in the memory, belongs to an
// existing frame.
struct LocalMap {
  explicit LocalMap(const LocalMapOptions& map_options) : options(map_options) {}

  // Adds the newest image. Aliases redirect its lines to the landmarks of their tracks.
  void AddFrame(WindowFrame frame, const PointFrame& point_frame,
                const std::optional<LineFrame>& line_frame);

  // Removes the second newest frame; its IMU samples are joined to the newest frame's.
  void DropSecondNewest();

  // Removes the oldest frame, which must be marginalized already. If `stays_as_anchor`, it becomes
  // an anchor and keeps its observations of remembered lines.
  DepartedLandmarks SlideOldest(bool stays_as_anchor);

  void RemoveAnchor(int64_t t_ns);

  // Replaces the line `newer` by `joint`, the merged line under the older id.
  void AbsorbLine(int64_t newer, const LineLandmark& joint);

  // Replaces the id of a recognized line by the id that it had before it left the window, and
  // restores its anchor observations.
  void ReviveLine(int64_t newer, int64_t older);

  // Counts the optimized landmarks, points and lines, that the newest image observes.
  int CountInNewest() const { return points.CountInNewest(window) + lines.CountInNewest(window); }

  // Drops the aliases of lines that no longer exist.
  void ForgetIdleAliases();

  LocalMapOptions options;
  SlidingWindow window;
  PointMap points;
  LineMap lines;
  LineMemory memory;  // lines that have left the window
  LineAliases aliases;

 private:
  void RememberDeparting(int64_t frame_ns, bool stays_as_anchor);
  std::optional<MapLine> DepartingSegment(const LineLandmark& line) const;
};

// Writes the states of the window and the optimized landmarks to `output`.
void DescribeMap(const LocalMap& map, EstimatorOutput* output);

}  // namespace plm_vins
