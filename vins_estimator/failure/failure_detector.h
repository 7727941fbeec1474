// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <string>

#include "vins_estimator/state/frame_state.h"

namespace plm_vins {

constexpr int kFewFeatures = 6;  // fewer points and lines do not constrain a pose

// Returns the reason if the optimized newest state is implausible, given its prediction by the IMU;
// nullopt if it is plausible.
std::optional<std::string> DetectFailure(const FrameState& predicted, const FrameState& optimized);

// Returns the reason if the estimated time offset is implausible, given its difference from the
// configured one [s]; nullopt if it is plausible.
std::optional<std::string> DetectRunaway(double time_offset_change);

// Detects that the camera contradicts the state for a while: in consecutive images, a large share
// of the observed landmarks are outliers. A single bad IMU sample can cause this without exceeding
// any other limit. Images with too few landmarks neither continue nor end a contradiction.
class ContradictionMonitor {
 public:
  // Adds the number of landmarks, points and lines, that an image observes, and how many of them
  // are outliers after the optimization. Returns the reason once the contradiction has lasted too
  // long, otherwise nullopt.
  std::optional<std::string> Add(int64_t t_ns, int landmarks, int rejected);

  bool contradicts() const { return contradicts_; }  // according to the images so far

 private:
  bool contradicts_ = false;
  int64_t newest_ns_ = 0;         // time of the last image
  int64_t contradiction_ns_ = 0;  // duration of the contradiction
};

// Declares tracking lost once dead reckoning has made the position too uncertain. A second without
// features is bridged by the IMU; after ten seconds it has drifted by meters. The same holds for
// seconds without images or IMU samples, and if all observations are outliers.
class BlindnessMonitor {
 public:
  // Adds an image: the number of observed features, whether known landmarks or a standstill
  // constrain the position, and the state with the covariance of (p_W, rotation in B); without a
  // covariance the image is ignored. Returns the reason once tracking is lost, else nullopt.
  std::optional<std::string> Add(int features_seen, bool is_held, const FrameState& state,
                                 const std::optional<Eigen::Matrix<double, 6, 6>>& covariance);

  bool blind() const { return blind_; }  // the newest image has too few features

 private:
  struct Hold {
    int64_t t_ns;
    Eigen::Vector3d p_W;
    double variance;  // position variance, summed over the axes [m^2]
  };

  std::optional<Hold> hold_;  // at the last image that constrained the position, or the first image
  bool blind_ = false;
};

}  // namespace plm_vins
