// SPDX-License-Identifier: BSD-3-Clause
#include "map_bundle/bundle_noise.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "common/statistics.h"

namespace plm_vins {
namespace {

constexpr size_t kMinFollowed = 4;  // observations per landmark, to estimate a variance
constexpr size_t kMinSamples = 30;
constexpr double kMaxChange = 8;  // largest factor on the configured deviation, up or down

double SquaredError(const BundleState& bundle, const LandmarkTrack& landmark,
                    const LandmarkTrack::Observation& observation) {
  const Eigen::Vector3d p_C =
      bundle.T_M_C(observation.keyframe, observation.camera).Inverse() * landmark.p_M;
  if (p_C.z() <= 0) return std::numeric_limits<double>::infinity();
  return (p_C.hnormalized() - observation.xy).squaredNorm();
}

double Deviation(const std::vector<double>& variances, double configured) {
  if (variances.size() < kMinSamples) return configured;
  const double deviation = std::sqrt(Median(variances));
  return std::clamp(deviation, configured / kMaxChange, configured * kMaxChange);
}

}  // namespace

ObservationNoise EstimateNoise(const BundleState& bundle, const ObservationNoise& configured) {
  std::vector<double> followed, matched, again;
  for (const LandmarkTrack& landmark : bundle.landmarks) {
    double sum = 0;
    size_t count = 0;
    for (const LandmarkTrack::Observation& observation : landmark.observations) {
      constexpr double kMedian = 2 * M_LN2;  // of chi-square with 2 dof
      const double squared_error = SquaredError(bundle, landmark, observation);
      if (observation.again) {
        again.push_back(squared_error / kMedian);
      } else if (observation.camera != landmark.observations.front().camera) {
        matched.push_back(squared_error / kMedian);
      } else {
        sum += squared_error;
        ++count;
      }
    }
    constexpr double kUnknowns = 3;  // degrees of freedom of the landmark
    if (count >= kMinFollowed)
      followed.push_back(sum / (2.0 * static_cast<double>(count) - kUnknowns));
  }
  return {Deviation(followed, configured.followed), Deviation(matched, configured.matched),
          Deviation(again, configured.again)};
}

}  // namespace plm_vins
