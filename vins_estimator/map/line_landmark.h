// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "vins_estimator/geometry/plucker.h"
#include "vins_estimator/geometry/segment_end_points.h"
#include "vins_estimator/map/image_key.h"
#include "vins_estimator/state/map_elements.h"

namespace plm_vins {

// A line track over the frames of the window, and the line in space. The first observation is the
// host, in whose camera frame the coordinates are.
struct LineLandmark {
  struct Observation : ImageKey {
    SegmentEndPoints segment;
    // Standard deviations of start and end across the line, normalized; zero for the noise of
    // lines.
    Eigen::Vector2d deviation = Eigen::Vector2d::Zero();

    // Returns one over the deviations; `weight` if none are stated.
    Eigen::Vector2d Weights(double weight) const {
      if (deviation.isZero(0)) return Eigen::Vector2d::Constant(weight);
      return deviation.cwiseInverse();
    }
    int CountMeasurements() const { return 1; }
    void ForgetDepth() {}
    double Length() const { return (segment.end - segment.start).norm(); }
  };

  int64_t id = -1;
  std::vector<Observation> observations;  // by time and camera
  // Observations in anchors, in the same order, of a recognized line; optimized together with
  // `observations`.
  std::vector<Observation> anchor_observations;
  OrthonormalLine coordinates = {0, 0, 0, 1, 0};
  bool triangulated = false;
  LineAxis axis = LineAxis::kFree;  // parallel axis, according to the observations so far

  const Observation& host() const { return observations.front(); }
};

constexpr size_t kMaxAnchorObservations = 4;  // per line: the first and the newest

// Adds an anchor's observation in its place. Of two observations in one image the longer is kept.
inline void AddAnchorObservation(const LineLandmark::Observation& observation,
                                 std::vector<LineLandmark::Observation>* observations) {
  const auto place = std::lower_bound(observations->begin(), observations->end(), observation);
  if (place != observations->end() && *place == observation) {
    if (observation.Length() > place->Length()) *place = observation;
    return;
  }
  observations->insert(place, observation);
  if (observations->size() > kMaxAnchorObservations) observations->erase(observations->begin() + 1);
}

}  // namespace plm_vins
