// SPDX-License-Identifier: BSD-3-Clause
// Pairs of images with a gyroscope, of a camera with errors of its calibration.
#pragma once

#include <Eigen/LU>
#include <vector>

#include "common/geometry/so3.h"
#include "simulator/random.h"
#include "vins_estimator/rotation_calibration/epipolar_equations.h"

namespace plm_vins::testing {

inline const Eigen::Quaterniond kR_B_C = SO3Exp({0.3, -1.2, 0.4});

struct PairOptions {
  int count = 60;
  int points = 30;
  double turn = 0.1;         // standard deviation per axis [rad]
  double translation = 0.1;  // likewise [m], with points in 2 to 6 m
  double noise = 0;          // of a coordinate
  size_t outliers_every = 1'000'000;
};

// Returns the ray that is configured where the true one is `xy`.
inline Eigen::Vector2d Configured(const Eigen::Vector2d& xy, const CalibrationError::Vector& x) {
  Eigen::Vector2d configured = xy;
  for (int k = 0; k < 50; ++k) {
    const double factor = 1 + x[CalibrationError::kFocal] +
                          x[CalibrationError::kDistortion] * configured.squaredNorm();
    configured = (xy - x.segment<2>(CalibrationError::kPrincipal)) / factor;
  }
  return configured;
}

inline RotationPair SimulatePair(const CalibrationError::Vector& x, const PairOptions& options,
                                 simulator::Random* random) {
  using Error = CalibrationError;
  RotationPair pair;
  pair.duration = 0.3;
  const Eigen::Vector3d phi = options.turn * random->NormalVector3();
  pair.rate_change = 3 * options.turn * random->NormalVector3();
  const Eigen::Matrix3d true_of_read =
      Eigen::Matrix3d::Identity() - Eigen::Map<const Eigen::Matrix3d>(x.data() + Error::kGyro);
  const Eigen::Vector3d in_time =
      phi + pair.duration * x.segment<3>(Error::kBias) - x[Error::kDelay] * pair.rate_change;
  pair.R_B0_B1 = SO3Exp(true_of_read.inverse() * in_time);
  const Eigen::Quaterniond R = kR_B_C * SO3Exp(x.segment<3>(Error::kExtrinsics));
  pair.R_then_now = R.conjugate() * SO3Exp(phi) * R;
  const Eigen::Vector3d p = options.translation * random->NormalVector3();
  const auto noise = [&]() -> Eigen::Vector2d {
    return options.noise * random->NormalVector3().head<2>();
  };
  while (static_cast<int>(pair.points.size()) < options.points) {
    const Eigen::Vector2d xy(random->Uniform(-0.8, 0.8), random->Uniform(-0.6, 0.6));
    const Eigen::Vector3d then = random->Uniform(2, 6) * xy.homogeneous();
    const Eigen::Vector2d now = (pair.R_then_now.conjugate() * (then - p)).hnormalized();
    if (now.norm() > 1) continue;  // outside the image
    pair.points.push_back({Configured(xy, x) + noise(), Configured(now, x) + noise()});
    if (pair.points.size() % options.outliers_every == 0) {
      pair.points.back().xy1 += Eigen::Vector2d(0.01, -0.01);
    }
  }
  return pair;
}

inline std::vector<RotationPair> SimulatePairs(const CalibrationError::Vector& x,
                                               const PairOptions& options = {}) {
  simulator::Random random(3);
  std::vector<RotationPair> pairs;
  pairs.reserve(options.count);
  for (int i = 0; i < options.count; ++i) pairs.push_back(SimulatePair(x, options, &random));
  return pairs;
}

}  // namespace plm_vins::testing
