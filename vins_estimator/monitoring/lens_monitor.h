// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "common/camera/camera_model.h"
#include "vins_estimator/map/pixel_residuals.h"
#include "vins_estimator/state/estimator_output.h"

namespace plm_vins {

// Detects a distortion model that does not fit the lens. Noise, blur, a rolling shutter and wrong
// poses push residuals inwards as often as outwards; a wrong model always pushes them the same way
// at the same distance from the principal point. So the medians of the radial components are
// compared with zero, ring by ring. Structure, poses and refined intrinsics absorb most of the
// model's error: on real images an error of 0.5 px leaves medians of 0.05 to 0.1 px, the right
// model less than 0.01 px.
class LensMonitor {
 public:
  explicit LensMonitor(const CameraParameters& camera);

  // Adds the residuals of one frame, which must be passed once only.
  void Add(const std::vector<PixelResidual>& residuals);

  // Returns the rings, innermost first.
  std::vector<ResidualRing> Rings() const;

  // Describes a model that does not fit, and what to do; empty if it fits or data are too few.
  const std::string& warning() const { return warning_; }

 private:
  static constexpr int kRings = 8;
  static constexpr int kBins = 201;  // bins of the radial components

  struct Histogram {
    std::array<int64_t, kBins> counts = {};
    int64_t total = 0;

    double Quantile(double share) const;  // [px]
  };

  std::string Judge() const;

  const bool is_equidistant_;
  const Eigen::Vector2d center_px_;  // principal point
  double width_px_ = 0;              // width of a ring
  std::array<Histogram, kRings> rings_;
  std::string warning_;
};

}  // namespace plm_vins
