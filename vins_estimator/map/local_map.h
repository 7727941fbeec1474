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

  double line_noise;    // deviation of an end point across the line, normalised
  bool remember_lines;  // that leave, for when they come back
};

// The landmarks that left the map with a frame and had a place in the world.
struct DepartedLandmarks {
  std::vector<MapPoint> points;
  std::vector<MapLine> lines;  // all that was seen of each; where none is remembered, in its views
};

// The frames of the window and the landmarks that they see. Values are anybody's to change, but
// frames and anchors come and go through here only, because several things must move in step:
// every view of a landmark, and every anchor's view in the memory, is of a frame that is there.
struct LocalMap {
  explicit LocalMap(const LocalMapOptions& map_options) : options(map_options) {}

  // Adds the newest image. Its lines go to the landmarks that their tracks were found to be.
  void AddFrame(WindowFrame frame, const PointFrame& point_frame,
                const std::optional<LineFrame>& line_frame);

  // Takes out the frame before the newest; its IMU samples go to the newest.
  void DropSecondNewest();

  // Takes out the oldest frame once the prior has it. Its pose stays as an anchor where that is
  // asked for, with what it has seen of the lines that are remembered.
  DepartedLandmarks SlideOldest(bool stays_as_anchor);

  void RemoveAnchor(int64_t t_ns);

  // The tracks of two lines are one: `joint`, under the older id, takes over from `newer`.
  void AbsorbLine(int64_t newer, const LineLandmark& joint);

  // A line is one that had left: it goes on under that one's id, with what anchors saw of it.
  void ReviveLine(int64_t newer, int64_t older);

  // How many landmarks that are optimised, points and lines, the newest image shows.
  int CountInNewest() const { return points.CountInNewest(window) + lines.CountInNewest(window); }

  // Forgets which tracks belong to lines that are no more.
  void ForgetIdleAliases();

  LocalMapOptions options;
  SlidingWindow window;
  PointMap points;
  LineMap lines;
  LineMemory memory;  // of lines that have been in the window
  LineAliases aliases;

 private:
  void RememberDeparting(int64_t frame_ns, bool stays_as_anchor);
  std::optional<MapLine> DepartingSegment(const LineLandmark& line) const;
};

// What the estimator says of its map: the states of the window and the landmarks in use.
void DescribeMap(const LocalMap& map, EstimatorOutput* output);

}  // namespace plm_vins
