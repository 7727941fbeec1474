// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/rotation_calibration/rotation_fit.h"

#include <Eigen/Cholesky>
#include <Eigen/SVD>
#include <algorithm>
#include <cmath>

#include "common/geometry/robust_weight.h"
#include "common/geometry/so3.h"
#include "common/statistics.h"

namespace plm_vins {
namespace {

using Cause = RotationFit::Cause;

constexpr size_t kMinPairs = 40;           // in doubt, ten per second
constexpr double kMinMeanTurn = 0.03;      // root mean square of the rotations [rad]
constexpr double kMinExplained = 0.2;      // share of the squared differences
constexpr double kAgreement = 0.005;       // root mean square of the differences [rad]
constexpr double kAgreementByTurn = 0.03;  // relative to that of the rotations
constexpr double kOverlap = 3;             // pairs of 0.3 s may begin every 0.1 s: a third is new
constexpr int kReweighings = 5;
constexpr double kRobustSigmas = 3;

// Columns of the Jacobian with respect to all parameters.
constexpr int kBias = 0, kDelay = 3, kFocal = 4, kExtrinsics = 5, kGyro = 8, kScales = 17,
              kScale = 20, kColumns = 21;

struct Bounds {
  double min, max;
};

// Returns the smallest amount that matters, and the largest that linear equations cover.
Bounds Limits(Cause cause) {
  switch (cause) {
    case Cause::kTimeOffset:
      return {0.005, 0.1};
    case Cause::kFocalLength:
    case Cause::kExtrinsics:
      return {0.02, 0.3};
    default:
      return {0.015, 0.3};
  }
}

// A cause with the columns of its parameters. Those of a gyroscope are all of its scales and axes,
// the scales alone, or one scale, of which the fewest that suffice are the most likely.
struct Model {
  Cause cause;
  int first, count;
};

constexpr Model kNoError{Cause::kNone, kBias, 0}, kWholeGyro{Cause::kGyro, kGyro, 9};
constexpr Model kModels[] = {{Cause::kTimeOffset, kDelay, 1},      {Cause::kFocalLength, kFocal, 1},
                             {Cause::kExtrinsics, kExtrinsics, 3}, kWholeGyro,
                             {Cause::kGyro, kScales, 3},           {Cause::kGyro, kScale, 1}};

// Differences phi_C - phi_G of the rotations in B, three rows per pair, and their Jacobian.
struct Equations {
  Eigen::VectorXd differences;
  Eigen::MatrixXd J;
  double mean_squared_turn = 0;
};

// With phi the true rotation: phi_G = (I + E) phi + bias T, with the interval `delay` too early;
// phi_C = (I + [theta]x) phi without the share `focal` of what lies across the optical axis.
Equations Linearize(const std::vector<RotationPair>& pairs, const Eigen::Quaterniond& R_B_C) {
  const auto count = static_cast<Eigen::Index>(pairs.size());
  const Eigen::Vector3d axis_B = R_B_C * Eigen::Vector3d::UnitZ();
  const Eigen::Matrix3d across = Eigen::Matrix3d::Identity() - axis_B * axis_B.transpose();
  Equations equations{Eigen::VectorXd(3 * count), Eigen::MatrixXd::Zero(3 * count, kColumns)};
  for (Eigen::Index i = 0; i < count; ++i) {
    const Eigen::Vector3d turn = SO3Log(pairs[i].R_B0_B1);
    equations.differences.segment<3>(3 * i) = R_B_C * SO3Log(pairs[i].R_then_now) - turn;
    auto rows = equations.J.middleRows<3>(3 * i);
    rows.middleCols<3>(kBias).diagonal().setConstant(-pairs[i].duration);
    rows.col(kDelay) = pairs[i].rate_change;
    rows.col(kFocal) = -across * turn;
    rows.middleCols<3>(kExtrinsics) = -Skew(turn);
    for (int k = 0; k < 3; ++k) rows.middleCols<3>(kGyro + 3 * k).diagonal().setConstant(-turn[k]);
    rows.middleCols<3>(kScales).diagonal() = -turn;
    rows.col(kScale) = -turn;
    equations.mean_squared_turn += turn.squaredNorm() / static_cast<double>(count);
  }
  return equations;
}

// Least squares for a bias and the parameters of one cause.
struct Fit {
  Eigen::VectorXd parameters;  // of the cause
  Eigen::VectorXd residuals;
  double squares = 0;  // weighted sum
};

Fit Solve(const Equations& equations, const Eigen::VectorXd& weights, const Model& model) {
  Eigen::MatrixXd J(equations.J.rows(), 3 + model.count);
  J << equations.J.middleCols(kBias, 3), equations.J.middleCols(model.first, model.count);
  Eigen::MatrixXd H = J.transpose() * weights.asDiagonal() * J;
  H.diagonal().array() += 1e-9 * H.diagonal().maxCoeff();  // turns may be about one axis
  const Eigen::VectorXd x =
      H.ldlt().solve(J.transpose() * weights.cwiseProduct(equations.differences));
  Fit fit{x.tail(model.count), equations.differences - J * x};
  fit.squares = weights.dot(fit.residuals.cwiseAbs2());
  return fit;
}

// Lowers the weights of pairs with wrong tracks, which no error of the gyroscope explains.
Eigen::VectorXd Weights(const Equations& equations) {
  Eigen::VectorXd weights = Eigen::VectorXd::Ones(equations.differences.size());
  for (int k = 0; k < kReweighings; ++k) {
    const Eigen::VectorXd residuals = Solve(equations, weights, kWholeGyro).residuals;
    std::vector<double> sizes(residuals.data(), residuals.data() + residuals.size());
    for (double& size : sizes) size = std::abs(size);
    const double scale = kRobustSigmas * std::max(1e-6, 1.48 * Median(sizes));
    for (Eigen::Index i = 0; i < weights.size(); ++i) {
      weights[i] = GemanMcClureWeight(residuals[i], scale);
    }
  }
  return weights;
}

double Amount(Cause cause, const Eigen::VectorXd& parameters) {
  if (cause == Cause::kTimeOffset || cause == Cause::kFocalLength) return parameters[0];
  if (cause == Cause::kExtrinsics) return parameters.norm();
  if (parameters.size() < 9) return parameters.cwiseAbs().maxCoeff();
  return Eigen::Map<const Eigen::Matrix3d>(parameters.data()).jacobiSvd().singularValues()[0];
}

}  // namespace

double LeastAmount(Cause cause) { return Limits(cause).min; }

RotationFit ExplainRotations(const std::vector<RotationPair>& pairs,
                             const Eigen::Quaterniond& R_B_C) {
  if (pairs.size() < kMinPairs) return {};
  const Equations equations = Linearize(pairs, R_B_C);
  if (equations.mean_squared_turn < kMinMeanTurn * kMinMeanTurn) return {};
  const Eigen::VectorXd weights = Weights(equations);
  const double squares = Solve(equations, weights, kNoError).squares;
  const double count = weights.sum() / kOverlap;
  const double most =
      std::min(kAgreement, kAgreementByTurn * std::sqrt(equations.mean_squared_turn));
  const bool agree = squares < most * most * weights.sum();
  const RotationFit without{agree ? Cause::kNone : Cause::kUnknown};
  RotationFit best = without;
  double best_criterion = count * std::log(squares);
  for (const Model& model : kModels) {
    const Cause cause = model.cause;
    const Fit fit = Solve(equations, weights, model);
    const double criterion = count * std::log(fit.squares) + std::log(count) * model.count;
    if (criterion >= best_criterion) continue;
    best_criterion = criterion;
    const double amount = Amount(cause, fit.parameters);
    const Bounds limits = Limits(cause);
    const bool matters = std::abs(amount) >= limits.min && std::abs(amount) <= limits.max;
    const bool explains = fit.squares < (1 - kMinExplained) * squares;
    best = matters && explains ? RotationFit{cause, amount} : without;
  }
  return best;
}

}  // namespace plm_vins
