// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <deque>
#include <optional>
#include <string>
#include <vector>

#include "common/imu/imu_noise.h"
#include "common/measurements.h"
#include "vins_estimator/bridging/uncertain_state.h"

namespace plm_vins {

// Carries the world frame across a loss of tracking: propagates the IMU from the last trustworthy
// estimate to the first image of the next window, so that the reinitialized estimate continues in
// the previous world frame. A window that is initialized in motion begins with images right after
// the loss, which keeps the bridge shorter than its initialization. The bridge ends when IMU
// propagation makes the position uncertain.
class FrameBridge {
 public:
  // `gravity_W` is (0, 0, -g) [m/s^2].
  FrameBridge(const ImuNoise& noise, const Eigen::Vector3d& gravity_W)
      : noise_(noise), gravity_W_(gravity_W) {}

  // Adds an image while tracking: the IMU samples since the previous image and the estimate at this
  // image, whose covariance may be unknown.
  void AddTracked(const std::vector<ImuSample>& samples, const FrameState& state,
                  const std::optional<Matrix15d>& covariance);

  // Starts the bridge after the image that was tracked last. Returns false if there is no estimate
  // from before the failure, which may have gone unnoticed for a second.
  bool Begin(const std::string& why);

  // Adds an image after the loss, with the IMU samples since the previous one.
  void AddLost(const std::vector<ImuSample>& samples, int64_t t_ns);

  // Returns whether a window that starts at `begin_ns`, or at a future image if nullopt, can still
  // be connected. Always true before a loss.
  bool CanConnect(std::optional<int64_t> begin_ns) const;

  // Returns the propagated estimate at an image after the loss, or nullopt if the bridge does not
  // reach it.
  std::optional<UncertainState> At(int64_t t_ns) const;

  void Clear();

  bool begun() const { return begun_; }
  const std::string& why() const { return why_; }  // reason for the loss

 private:
  struct Image {
    std::vector<ImuSample> samples;  // since the previous image
    FrameState state;
    std::optional<Matrix15d> covariance = std::nullopt;
  };

  static bool IsCertain(const Image& start, const Image& end);

  // Propagates with the configured IMU noise, not the noise learned meanwhile: the comparison with
  // the new window decides whether the IMU or the camera was wrong.
  void Cross(const Image& from, Image* to) const;

  ImuNoise noise_;
  Eigen::Vector3d gravity_W_;
  std::deque<Image> images_;  // after a loss: propagated from the first one
  bool begun_ = false;
  bool ended_ = false;
  std::string why_;
};

}  // namespace plm_vins
