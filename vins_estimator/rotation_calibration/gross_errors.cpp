// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/rotation_calibration/gross_errors.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
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

constexpr size_t kMinFocalPairs = 20, kMaxFocalPairs = 40;
constexpr double kLeastTurn = 0.04;  // of a pair [rad]
constexpr int kSteps = 22;           // of the focal length, to either side
constexpr double kStep = 0.025;      // of its logarithm
constexpr double kLeastError = 0.03;
constexpr double kImproved = 0.6;   // cost relative to that as configured
constexpr double kExplained = 0.7;  // largest mean cost of a point that fits
constexpr double kTolerance = 2;    // scale of the robust cost, in standard deviations
constexpr int kDirectionIterations = 3;

// Mean robust cost of the points, with the translation that fits best. Rays are `factor` times as
// long across the axis as configured.
double EpipolarCost(const RotationPair& pair, const Eigen::Quaterniond& R_now_then, double factor,
                    double noise) {
  const auto count = pair.points.size();
  std::vector<Eigen::Vector3d> rotated(count), normals(count);
  for (size_t i = 0; i < count; ++i) {
    rotated[i] = R_now_then * (factor * pair.points[i].xy0).eval().homogeneous();
    normals[i] = rotated[i].cross((factor * pair.points[i].xy1).eval().homogeneous());
  }
  std::vector<double> weights(count, 1);
  double cost = 0;
  for (int k = 0; k < kDirectionIterations; ++k) {
    Eigen::Matrix3d squares = Eigen::Matrix3d::Zero();
    for (size_t i = 0; i < count; ++i) squares += weights[i] * normals[i] * normals[i].transpose();
    Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen;
    eigen.computeDirect(squares);
    const Eigen::Vector3d t = eigen.eigenvectors().col(0);
    cost = 0;
    for (size_t i = 0; i < count; ++i) {
      const double line = std::max(t.cross(rotated[i]).head<2>().norm(), 1e-6);
      const double error = t.dot(normals[i]) / (line * M_SQRT2 * factor * noise * kTolerance);
      weights[i] = 1 / ((1 + error * error) * line * line);
      cost += std::log1p(error * error) / static_cast<double>(count);
    }
  }
  return cost;
}

// Bias of the gyro by which the rotations agree best [rad/s].
Eigen::Vector3d MeanBias(const std::vector<RotationPair>& pairs, const Eigen::Quaterniond& R_B_C) {
  std::array<std::vector<double>, 3> rates;
  for (const RotationPair& pair : pairs) {
    const Eigen::Vector3d rate =
        (SO3Log(pair.R_B0_B1) - R_B_C * SO3Log(pair.R_then_now)) / pair.duration;
    for (int k = 0; k < 3; ++k) rates[k].push_back(rate[k]);
  }
  return {Median(rates[0]), Median(rates[1]), Median(rates[2])};
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

std::optional<double> ErrorOfFocalLength(const std::vector<RotationPair>& pairs,
                                         const Eigen::Quaterniond& R_B_C, double noise) {
  const Eigen::Vector3d bias = MeanBias(pairs, R_B_C);
  std::array<double, 2 * kSteps + 1> costs = {};
  size_t used = 0;
  for (size_t i = pairs.size(); i-- > 0 && used < kMaxFocalPairs;) {
    const RotationPair& pair = pairs[i];
    const Eigen::Vector3d turn = SO3Log(pair.R_B0_B1) - pair.duration * bias;
    if (turn.norm() < kLeastTurn || pair.points.empty()) continue;
    ++used;
    const Eigen::Quaterniond R_now_then = R_B_C.conjugate() * SO3Exp(-turn) * R_B_C;
    for (int k = -kSteps; k <= kSteps; ++k) {
      costs[k + kSteps] += EpipolarCost(pair, R_now_then, std::exp(kStep * k), noise);
    }
  }
  if (used < kMinFocalPairs) return std::nullopt;
  const auto best = std::min_element(costs.begin(), costs.end());
  if (best == costs.begin() || best + 1 == costs.end()) return std::nullopt;
  const double error = std::exp(kStep * static_cast<double>(best - costs.begin() - kSteps)) - 1;
  const bool is_explained = *best < kExplained * static_cast<double>(used);
  const bool is_better = *best < kImproved * costs[kSteps];
  if (!is_explained || !is_better || std::abs(error) < kLeastError) return std::nullopt;
  return error;
}

}  // namespace plm_vins
