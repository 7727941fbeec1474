// SPDX-License-Identifier: BSD-3-Clause
// Point tracks over a few views, for the steps of the initialization.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <vector>

#include "common/measurements.h"

namespace plm_vins {

struct ViewObservation {
  int view = 0;                               // index of the view, 0 is the oldest
  Eigen::Vector2d xy;                         // normalized, undistorted
  std::optional<Eigen::Vector2d> right = {};  // in the second camera
  std::optional<double> depth = {};           // measured [m]
};

// A point and its observations, in ascending order of views.
struct Track {
  int64_t id = -1;
  std::vector<ViewObservation> observations;

  // Returns the observation in one view, or null.
  const ViewObservation* In(int view) const;
};

// Observations of one point in two views, normalized and undistorted.
struct Correspondence {
  Eigen::Vector2d xy0, xy1;
};

// Returns all points that are observed in at least two views, by ascending id.
std::vector<Track> CollectTracks(const std::vector<const PointFrame*>& views);

// Returns the points that both views observe, in the order of the tracks.
std::vector<Correspondence> FindCorrespondences(const std::vector<Track>& tracks, int view0,
                                                int view1);

}  // namespace plm_vins
