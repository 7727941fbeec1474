// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <optional>

#include "common/config/estimator_config.h"
#include "vins_estimator/manhattan/manhattan_frame.h"
#include "vins_estimator/map/line_map.h"
#include "vins_estimator/map/sliding_window.h"
#include "vins_estimator/merging/line_aliases.h"
#include "vins_estimator/recall/line_memory.h"

namespace plm_vins {

struct LineMergingOptions {
  // `focal_length` [px] turns pixels into normalised coordinates.
  LineMergingOptions(const EstimatorConfig& config, double focal_length)
      : distance(config.line_merge_distance),
        image_distance(config.line_merge_image_distance / focal_length),
        angle(config.line_merge_angle * M_PI / 180),
        noise(config.line_noise / focal_length) {}

  double distance;        // between the lines in space, and between their ends [m]
  double image_distance;  // between line and segment in an image, normalised
  double angle;           // between the directions [rad]
  double noise;           // deviation of an end point across the line, normalised
};

// What became of the pairs of lines that are near each other, in one frame.
struct LineMergingCounts {
  int candidates = 0;  // pairs looked at
  int merged = 0;      // landmarks absorbed
  int recognised = 0;  // landmarks that turned out to be a line which had left the window
  int other_direction = 0;
  int distant = 0;  // beside each other in space
  int apart = 0;    // one behind the other, with a gap
  int distant_in_image = 0;
  int seen_side_by_side = 0;  // in one image
  int inconsistent = 0;       // the views do not fit one line: undone
};

// Deletes redundant line landmarks after triangulation ([Paper], section III.C): when the track of
// a line breaks, it comes back under a new id and would be one more landmark. A line is absorbed by
// an older one where, in the Manhattan frame, they are less than `distance` apart, and where in the
// images, too, each lies on the other. Beyond the paper, they must have the same direction, and
// overlap or touch along it; no image may show them side by side; and the views of both must fit
// one line. Where the views tell direction or place less well than the limits, three standard
// deviations take their place, and the fit decides. The views of the newer go to the older, and
// later ones follow by way of its alias.
//
// The older line may have left the window before. Then the newer becomes that line, and what
// anchors have seen of it counts as well: this ties the window to where the line was seen first.
class LineMerging {
 public:
  explicit LineMerging(const LineMergingOptions& options) : options_(options) {}

  // One image's lines under the ids of the landmarks that they belong to: what LineMap::AddFrame
  // takes.
  LineFrame Redirect(const LineFrame& frame) { return aliases_.Redirect(frame); }

  // Merges triangulated lines of the map. Pairs are found by boxes along the axes of M, or of W
  // where there is no Manhattan frame. The merged lines lose their vote on the frame.
  LineMergingCounts Merge(const SlidingWindow& window, LineMap* lines, ManhattanFrame* manhattan);

  // Takes note of the lines that go into the prior with the oldest frame and, where it stays as an
  // anchor, of what it has seen of them.
  void Remember(const SlidingWindow& window, const LineMap& lines, bool oldest_stays);

  // An anchor is no more.
  void RemoveAnchor(int64_t t_ns) { memory_.RemoveAnchor(t_ns); }

  const LineAliases& aliases() const { return aliases_; }
  const LineMemory& memory() const { return memory_; }
  void Clear();

 private:
  std::optional<int64_t> Recognise(const SlidingWindow& window, const Eigen::Quaterniond& R_F_W,
                                   const LineLandmark& landmark, const SeenLine& seen_F,
                                   const LineMap& lines) const;
  void Revive(int64_t newer, int64_t older, LineMap* lines, ManhattanFrame* manhattan);
  void Absorb(int64_t newer, int64_t older, LineMap* lines, ManhattanFrame* manhattan);

  LineMergingOptions options_;
  LineAliases aliases_;
  LineMemory memory_;
};

}  // namespace plm_vins
