// SPDX-License-Identifier: BSD-3-Clause
// Point tracks over a handful of views, for the steps of initialisation.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "common/measurements.h"

namespace plm_vins {

struct ViewObservation {
  int view = 0;        // index of the view, 0 the oldest
  Eigen::Vector2d xy;  // normalised, undistorted
};

// One point and the views that saw it, in ascending order.
struct Track {
  int64_t id = -1;
  std::vector<ViewObservation> observations;
};

// The same point in two views, normalised and undistorted.
struct Correspondence {
  Eigen::Vector2d xy0, xy1;
};

// All points seen in at least two of the views, by ascending id.
std::vector<Track> CollectTracks(const std::vector<const PointFrame*>& views);

// The points that both views saw, in the order of the tracks.
std::vector<Correspondence> FindCorrespondences(const std::vector<Track>& tracks, int view0,
                                                int view1);

}  // namespace plm_vins
