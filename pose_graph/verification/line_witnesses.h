// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "common/camera/camera_model.h"
#include "pose_graph/verification/loop_refinement.h"

namespace plm_vins {

struct LineWitnessOptions {
  static constexpr double kMaxDistance_px = 6;

  explicit LineWitnessOptions(double focal_length)  // [px]
      : max_distance(kMaxDistance_px / focal_length) {}

  double max_angle = 5 * M_PI / 180;  // between a line's image and a segment [rad]
  double max_distance;                // of the segment's ends from it (normalised)
  double min_overlap = 0.3;           // of the two, share of the shorter
};

// Lines of an earlier visit that would be in view from a camera, and those that are seen there.
struct LineWitnesses {
  int visible = 0;
  std::vector<SeenSegment> seen;

  double share() const { return visible > 0 ? static_cast<double>(seen.size()) / visible : 0.0; }
};

// `lines_O` as seen by a camera at `T_O_C` with these `segments`.
LineWitnesses FindWitnesses(const LineWitnessOptions& options, const CameraModel& camera,
                            const Rigid3d& T_O_C, const std::vector<SpaceSegment>& lines_O,
                            const std::vector<TrackedSegment>& segments);

}  // namespace plm_vins
