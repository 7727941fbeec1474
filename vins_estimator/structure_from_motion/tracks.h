// SPDX-License-Identifier: BSD-3-Clause
// Point tracks over a few views, for the steps of the initialization. A view is a frame, with the
// images of all cameras.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <vector>

#include "common/measurements.h"

namespace plm_vins {

// A point and its observations, by view and camera.
struct Track {
  struct Observation {
    int view = 0;  // index of the view, 0 is the oldest
    int camera = 0;
    Eigen::Vector2d xy;                // normalized, undistorted
    std::optional<double> depth = {};  // measured [m]
  };

  int64_t id = -1;
  std::vector<Observation> observations;

  // Returns the first observation in one view, or null.
  const Observation* In(int view) const;
};

// Observations of one point in two views, normalized and undistorted.
struct Correspondence {
  Eigen::Vector2d xy0, xy1;
};

// Returns all points that are observed in at least two views, by ascending id.
std::vector<Track> CollectTracks(const std::vector<const PointFrame*>& views);

// Returns the tracks of one camera alone, without measured depths.
std::vector<Track> OfCamera(int camera, const std::vector<Track>& tracks);

// Returns the points that both views observe, in the order of the tracks, which must be of one
// camera.
std::vector<Correspondence> FindCorrespondences(const std::vector<Track>& tracks, int view0,
                                                int view1);

}  // namespace plm_vins
