// SPDX-License-Identifier: BSD-3-Clause
#include "pose_graph/keyframes/keyframe.h"

#include <algorithm>
#include <iterator>

namespace plm_vins {

std::vector<DescribedCorner> Keyframe::CornersIn(int camera) const {
  std::vector<DescribedCorner> seen;
  std::copy_if(corners.begin(), corners.end(), std::back_inserter(seen),
               [camera](const DescribedCorner& corner) { return corner.camera == camera; });
  return seen;
}

std::vector<TrackedSegment> Keyframe::SegmentsIn(int camera) const {
  std::vector<TrackedSegment> seen;
  std::copy_if(
      segments.begin(), segments.end(), std::back_inserter(seen),
      [camera](const TrackedSegment& segment) { return segment.observation.camera == camera; });
  return seen;
}

}  // namespace plm_vins
