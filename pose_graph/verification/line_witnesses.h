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

  double max_angle = 5 * M_PI / 180;  // between the projected line and a segment [rad]
  double max_distance;                // distance of endpoints from the projected line (normalized)
  double min_overlap = 0.3;           // overlap relative to the shorter of the two
};

// Lines of an earlier visit that should be visible, and those found in the image.
struct LineWitnesses {
  int visible = 0;
  std::vector<SeenSegment> seen;

  double share() const { return visible > 0 ? static_cast<double>(seen.size()) / visible : 0.0; }
};

// Projects `lines_O` into a camera at `T_O_C` and compares them with the detected `segments`.
LineWitnesses FindWitnesses(const LineWitnessOptions& options, const CameraModel& camera,
                            const Rigid3d& T_O_C, const std::vector<SpaceSegment>& lines_O,
                            const std::vector<TrackedSegment>& segments);

}  // namespace plm_vins
