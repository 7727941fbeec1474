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

// Carries the world frame over a loss of the estimate: the IMU leads from the last estimate that
// can be believed to the first image of the next window. A window that starts in motion looks back
// to the images right after the loss, so that the bridge need not last for as long as its
// initialisation takes. It ends where the IMU leaves the position uncertain.
class FrameBridge {
 public:
  // `gravity_W` is (0, 0, -g) [m/s^2].
  FrameBridge(const ImuNoise& noise, const Eigen::Vector3d& gravity_W)
      : noise_(noise), gravity_W_(gravity_W) {}

  // An image that is tracked: the samples from the image before to it, and what is known of it; a
  // covariance of zero: nothing.
  void AddTracked(const std::vector<ImuSample>& samples, const UncertainState& estimate);

  // The estimate is lost with the image that was tracked last. False, and nothing begins, where
  // there is no estimate from before the trouble, which may have gone unnoticed for a second.
  bool Begin(const std::string& why);

  // The samples from the image before to the next one after the loss.
  void AddLost(const std::vector<ImuSample>& samples, int64_t t_ns);

  // True until a loss, and as long after it as a window that begins at `begin_ns`, or with an image
  // to come where that is nothing, can be connected.
  bool CanConnect(std::optional<int64_t> begin_ns) const;

  // What is known of an image after the loss; null where the bridge does not reach it.
  const UncertainState* At(int64_t t_ns) const;

  void Clear();

  bool begun() const { return begun_; }
  const std::string& why() const { return why_; }  // the estimate was lost

 private:
  struct Image {
    std::vector<ImuSample> samples;  // from the image before
    UncertainState estimate;
  };

  // By the motion as it was measured, whatever the camera has made of the noise of the IMU
  // meanwhile: which of the two was wrong shows where the new window does or does not fit.
  void Cross(const Image& from, Image* to) const;

  ImuNoise noise_;
  Eigen::Vector3d gravity_W_;
  std::deque<Image> images_;  // after the loss: as the IMU leads on from the first one
  bool begun_ = false;
  bool ended_ = false;
  std::string why_;
};

}  // namespace plm_vins
