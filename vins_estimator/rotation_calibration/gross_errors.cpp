// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/rotation_calibration/gross_errors.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "common/geometry/robust_weight.h"
#include "common/geometry/so3.h"
#include "common/statistics.h"

namespace plm_vins {
namespace {

constexpr size_t kMinPairsOfMounting = 20;
constexpr double kMinMedianTurn = 0.03;  // of the pairs [rad]
constexpr double kFitting = 0.25;    // residual of the right mounting, relative to the rotations
constexpr double kMuchBetter = 0.4;  // residual relative to that as configured
constexpr double kWidth = 0.05;      // of the robust loss [rad]
constexpr int kBiasIterations = 5;
constexpr double kBiasDeviation = 0.1;  // of the gyro about 0 [rad/s]

// Returns the median difference of the rotations, after a bias of the gyro was fitted [rad].
double MedianResidual(const std::vector<RotationPair>& pairs, const Eigen::Quaterniond& R_B_C) {
  Eigen::Vector3d bias = Eigen::Vector3d::Zero();
  std::vector<double> sizes(pairs.size());
  for (int k = 0; k <= kBiasIterations; ++k) {
    double weights = std::pow(kWidth / kBiasDeviation, 2);
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (size_t i = 0; i < pairs.size(); ++i) {
      const RotationPair& pair = pairs[i];
      const Eigen::Vector3d difference = SO3Log(pair.R_B0_B1) - R_B_C * SO3Log(pair.R_then_now);
      sizes[i] = (difference - pair.duration * bias).norm();
      const double weight = GemanMcClureWeight(sizes[i], kWidth);
      weights += weight * pair.duration * pair.duration;
      sum += weight * pair.duration * difference;
    }
    bias = sum / weights;
  }
  return Median(std::move(sizes));
}

double MedianTurn(const std::vector<RotationPair>& pairs) {
  std::vector<double> turns;
  turns.reserve(pairs.size());
  for (const RotationPair& pair : pairs) turns.push_back(SO3Log(pair.R_then_now).norm());
  return Median(std::move(turns));
}

}  // namespace

std::optional<MountingError> ExplainByMounting(const std::vector<RotationPair>& pairs,
                                               const Eigen::Quaterniond& R_B_C) {
  if (pairs.size() < kMinPairsOfMounting) return std::nullopt;
  const double turn = MedianTurn(pairs);
  if (turn < kMinMedianTurn) return std::nullopt;
  double least = std::min(kMuchBetter * MedianResidual(pairs, R_B_C), kFitting * turn);
  std::optional<MountingError> best;
  const auto consider = [&](const Eigen::Quaterniond& R, const MountingError& error) {
    const double residual = MedianResidual(pairs, R);
    if (residual >= least) return;
    least = residual;
    best = error;
  };
  consider(R_B_C.conjugate(),
           {MountingError::Kind::kInverse, R_B_C.angularDistance(R_B_C.conjugate())});
  for (const double angle : {M_PI, M_PI / 2, -M_PI / 2}) {
    const Eigen::Quaterniond about_axis(Eigen::AngleAxisd(angle, Eigen::Vector3d::UnitZ()));
    consider(R_B_C * about_axis, {MountingError::Kind::kTurned, angle});
  }
  // In a mirror, rotations appear as those of a camera that is turned about the axis across it.
  for (const int axis : {0, 1}) {
    consider(R_B_C * SO3Exp(M_PI * Eigen::Vector3d::Unit(axis)),
             {MountingError::Kind::kMirrored, M_PI});
  }
  return best;
}

}  // namespace plm_vins
