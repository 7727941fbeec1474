// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/rotation_calibration/gross_errors.h"

#include <algorithm>
#include <cmath>
#include <string>
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
double MedianResidual(const std::vector<RotationPair>& pairs, const Eigen::Matrix3d& R_B_C) {
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

// Returns the errors of a gyro's axes that turn right-handed rates into left-handed ones, which no
// rotation does: how to call them, and the matrix by which the readings are multiplied.
std::vector<std::pair<std::string, Eigen::Matrix3d>> GyroErrors() {
  constexpr const char* kAxes[] = {"x", "y", "z"};
  std::vector<std::pair<std::string, Eigen::Matrix3d>> errors = {
      {"the signs are wrong", -Eigen::Matrix3d::Identity()}};
  for (int axis = 0; axis < 3; ++axis) {
    Eigen::Matrix3d mirror = Eigen::Matrix3d::Identity(), swap = mirror;
    mirror(axis, axis) = -1;
    errors.emplace_back(std::string("the sign of ") + kAxes[axis] + " is wrong", mirror);
    const int a = (axis + 1) % 3, b = (axis + 2) % 3;
    swap.row(a).swap(swap.row(b));
    errors.emplace_back(std::string(kAxes[a]) + " and " + kAxes[b] + " are swapped", swap);
  }
  return errors;
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
  const Eigen::Matrix3d R_stated = R_B_C.toRotationMatrix();
  double least = std::min(kMuchBetter * MedianResidual(pairs, R_stated), kFitting * turn);
  std::optional<MountingError> best;
  const auto consider = [&](const auto& R, const MountingError& error) {
    const double residual = MedianResidual(pairs, Eigen::Matrix3d(R));
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
  // A turn about one axis may look like one in a mirror, which occurs more often.
  if (best) least *= kMuchBetter;
  for (const auto& [text, matrix] : GyroErrors()) {
    consider(matrix * R_stated, {MountingError::Kind::kGyro, M_PI, text});
  }
  return best;
}

}  // namespace plm_vins
