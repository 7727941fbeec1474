// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/rotation_calibration/rotation_fit.h"

#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <vector>

#include "common/geometry/so3.h"
#include "common/geometry/symmetric_system.h"
#include "vins_estimator/rotation_calibration/epipolar_equations.h"

namespace plm_vins {
namespace {

using Cause = RotationFit::Cause;
using Error = CalibrationError;

constexpr size_t kMinPairs = 20, kMostPairs = 60;
constexpr double kLeastTurn = 0.03;     // of a pair [rad]
constexpr double kAgreement = 1.4;      // largest mean cost of a point that fits
constexpr double kMinExplained = 0.04;  // share of the cost
// By this the criterion of a cause must be less than that without any: very strong evidence (Kass
// and Raftery, Bayes factors, 1995). The gyroscope's errors, as many as nine, fit moving objects
// best, so they need more: 12 was seen with propellers in the view, and at least 50 after 15 s with
// a gyroscope that is 5 % off.
constexpr double kLeastEvidence = 10, kLeastGyroEvidence = 25;
// Points per independent one: pairs of 0.3 s may begin every 0.1 s, and errors of a track last.
constexpr double kOverlap = 4;
constexpr int kIterations = 6;
constexpr double kLeastDecrease = 0.002;  // share of the cost by which a step is worth its time
constexpr double kPromising = 0.02;       // likewise, the first step of a cause
constexpr double kFocalStarts[] = {-0.5, -0.3, -0.15, 0.2, 0.5, 1};
constexpr double kDeviation = 0.3;          // of all relative errors and angles, before
constexpr double kGyroBiasDeviation = 0.1;  // [rad/s]
constexpr double kLeastFactor = 0.4;        // configured focal length over the true one

struct Bounds {
  double min, max;
};

// Returns the smallest amount that matters, and the largest that a fit is trusted with.
Bounds Limits(Cause cause) {
  switch (cause) {
    case Cause::kTimeOffset:
      return {0.005, 0.1};
    case Cause::kFocalLength:
    case Cause::kDistortion:
      return {0.02, 1.5};
    default:
      return {0.02, 0.3};
  }
}

// A cause with its errors, as columns.
struct Model {
  Cause cause;
  Eigen::MatrixXd errors;
};

Eigen::MatrixXd Columns(int first, int count) {
  return Eigen::MatrixXd::Identity(Error::kSize, Error::kSize).middleCols(first, count);
}

// A gyroscope has errors of all scales and axes, of the scales alone, or of one scale: the fewest
// that suffice are the most likely.
std::vector<Model> Models() {
  const Eigen::MatrixXd gyro = Columns(Error::kGyro, 9);
  Eigen::MatrixXd scales(Error::kSize, 3);
  scales << gyro.col(0), gyro.col(4), gyro.col(8);
  return {{Cause::kTimeOffset, Columns(Error::kDelay, 1)},
          {Cause::kFocalLength, Columns(Error::kFocal, 1)},
          {Cause::kDistortion, Columns(Error::kDistortion, 1)},
          {Cause::kPrincipalPoint, Columns(Error::kPrincipal, 2)},
          {Cause::kExtrinsics, Columns(Error::kExtrinsics, 3)},
          {Cause::kGyro, gyro},
          {Cause::kGyro, scales},
          {Cause::kGyro, scales.rowwise().sum()}};
}

// The newest pairs that turn enough, with the configuration that is tested.
class Fitter {
 public:
  Fitter(const std::vector<RotationPair>& pairs, const Eigen::Quaterniond& R_B_C, double noise)
      : R_B_C_(R_B_C), noise_(noise) {
    for (size_t i = pairs.size(); i-- > 0 && pairs_.size() < kMostPairs;) {
      const bool turns = SO3Log(pairs[i].R_B0_B1).norm() > kLeastTurn;
      if (turns && !pairs[i].points.empty()) pairs_.push_back(pairs[i]);
    }
    information_.setConstant(1 / (kDeviation * kDeviation));
    information_.segment<3>(Error::kBias)
        .setConstant(1 / (kGyroBiasDeviation * kGyroBiasDeviation));
  }

  size_t pairs() const { return pairs_.size(); }

  // The cost, with that of the errors themselves, and its derivatives.
  EpipolarEquations Linearize(const Error::Vector& x) const {
    EpipolarEquations equations = LinearizeEpipolar(pairs_, R_B_C_, noise_, x);
    equations.cost += 0.5 * x.dot(information_.cwiseProduct(x));
    equations.g += information_.cwiseProduct(x);
    equations.H.diagonal() += information_;
    return equations;
  }

  struct Fit {
    Error::Vector x;
    EpipolarEquations equations;
  };

  struct Step {
    Error::Vector x;
    double decrease = 0;  // expected, of the cost
  };

  // A step of Gauss-Newton over the columns of `errors` and the bias.
  static Step StepFrom(const EpipolarEquations& equations, const Eigen::MatrixXd& errors) {
    Eigen::MatrixXd basis(static_cast<int>(Error::kSize), 3 + errors.cols());
    basis << Columns(Error::kBias, 3), errors;
    const Eigen::MatrixXd H = basis.transpose() * equations.H * basis;
    const Eigen::VectorXd g = basis.transpose() * equations.g;
    const Eigen::VectorXd step = SolveSmallSymmetric(H, g);
    return {-basis * step, 0.5 * g.dot(step)};
  }

  // Takes steps until they gain nothing, shorter ones where the cost would not decrease.
  Fit Minimize(const Eigen::MatrixXd& errors, Fit fit) const {
    double length = 1;
    for (int k = 0; k < kIterations; ++k) {
      const Step step = StepFrom(fit.equations, errors);
      if (step.decrease < kLeastDecrease * fit.equations.cost) break;
      const Error::Vector x = fit.x + length * step.x;
      const EpipolarEquations equations = Linearize(x);
      const bool decreases = equations.cost < fit.equations.cost;
      if (decreases) fit = {x, equations};
      length = decreases ? 1 : 0.3 * length;
    }
    return fit;
  }

  // Steps from the right focal length to a grossly wrong one would get stuck.
  Fit StartOf(Cause cause, const Fit& without) const {
    Fit best = without;
    if (cause != Cause::kFocalLength) return best;
    for (const double focal : kFocalStarts) {
      Error::Vector x = without.x;
      x[Error::kFocal] = focal;
      const EpipolarEquations equations = Linearize(x);
      if (equations.cost < best.equations.cost) best = {x, equations};
    }
    return best;
  }

  double Amount(Cause cause, const Error::Vector& x) const {
    switch (cause) {
      case Cause::kTimeOffset:
        return x[Error::kDelay];
      case Cause::kFocalLength:
        return x[Error::kFocal];
      case Cause::kDistortion:
        return x[Error::kDistortion] * LargestSquaredRadius();
      case Cause::kPrincipalPoint:
        return x.segment<2>(Error::kPrincipal).norm();
      case Cause::kExtrinsics:
        return x.segment<3>(Error::kExtrinsics).norm();
      default:
        return Eigen::Map<const Eigen::Matrix3d>(x.data() + Error::kGyro)
            .jacobiSvd()
            .singularValues()[0];
    }
  }

 private:
  double LargestSquaredRadius() const {
    double largest = 0;
    for (const RotationPair& pair : pairs_) {
      for (const Correspondence& c : pair.points) largest = std::max(largest, c.xy1.squaredNorm());
    }
    return largest;
  }

  std::vector<RotationPair> pairs_;
  Eigen::Quaterniond R_B_C_;
  double noise_;
  Error::Vector information_;  // of the errors, before
};

}  // namespace

double LeastAmount(Cause cause) { return Limits(cause).min; }

RotationFit ExplainRotations(const std::vector<RotationPair>& pairs,
                             const Eigen::Quaterniond& R_B_C, double noise) {
  const Fitter fitter(pairs, R_B_C, noise);
  if (fitter.pairs() < kMinPairs) return {};
  const Error::Vector zero = Error::Vector::Zero();
  const Fitter::Fit without = fitter.Minimize(Columns(0, 0), {zero, fitter.Linearize(zero)});
  const double points = without.equations.points, count = points / kOverlap;
  const double most = kAgreement * points;
  const RotationFit none{without.equations.cost < most ? Cause::kNone : Cause::kUnknown};
  RotationFit best = none;
  double best_criterion = count * std::log(without.equations.cost);
  for (const Model& model : Models()) {
    // A step promises little where errors are so large that they count as outliers, or where it is
    // far to the right focal length.
    const bool step_tells = none.cause == Cause::kNone && model.cause != Cause::kFocalLength;
    const double promising = kPromising * without.equations.cost;
    if (step_tells && Fitter::StepFrom(without.equations, model.errors).decrease < promising) {
      continue;
    }
    const Fitter::Fit fit = fitter.Minimize(model.errors, fitter.StartOf(model.cause, without));
    const double cost = fit.equations.cost;
    const double criterion = count * std::log(cost) +
                             std::log(count) * static_cast<double>(model.errors.cols()) +
                             (model.cause == Cause::kGyro ? kLeastGyroEvidence : kLeastEvidence);
    if (criterion >= best_criterion) continue;
    best_criterion = criterion;
    const double amount = fitter.Amount(model.cause, fit.x);
    const Bounds limits = Limits(model.cause);
    const bool matters = std::abs(amount) >= limits.min && std::abs(amount) <= limits.max &&
                         1 + amount >= kLeastFactor;
    const bool explains = cost < most && cost < (1 - kMinExplained) * without.equations.cost;
    best = matters && explains ? RotationFit{model.cause, amount} : none;
  }
  return best;
}

}  // namespace plm_vins
