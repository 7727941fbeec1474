// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/rotation_calibration/extrinsic_rotation.h"

#include <Eigen/Eigenvalues>
#include <Eigen/SVD>
#include <algorithm>
#include <cmath>

#include "common/format.h"
#include "common/geometry/robust_weight.h"
#include "common/geometry/so3.h"
#include "common/geometry/symmetric_system.h"

namespace plm_vins {
namespace {

// Tolerance for the residual of a pair while the gyroscope bias is unknown [rad].
constexpr double kLinearTolerance = 0.03;
constexpr int kLinearIterations = 10;
constexpr int kRotationRefinements = 8;
constexpr double kRotationInlierSigmas = 4.0;
constexpr double kMinInlierShare = 0.6;

using Matrix6d = Eigen::Matrix<double, 6, 6>;
using Vector6d = Eigen::Matrix<double, 6, 1>;

double Angle(const Eigen::Quaterniond& q) { return SO3Log(q).norm(); }

// Returns the matrix M with M q = R_B0_B1 q - q R_then_now, quaternions as (x, y, z, w).
Eigen::Matrix4d Constraint(const RotationPair& pair) {
  // Chooses w >= 0 for both, since rotations are below 180 deg; otherwise they could have opposite
  // signs.
  const auto positive = [](Eigen::Quaterniond q) {
    if (q.w() < 0) q.coeffs() = -q.coeffs();
    return q;
  };
  const Eigen::Quaterniond b = positive(pair.R_B0_B1), c = positive(pair.R_then_now);
  const Eigen::Vector3d sum = b.vec() + c.vec(), difference = b.vec() - c.vec();
  Eigen::Matrix4d M = (b.w() - c.w()) * Eigen::Matrix4d::Identity();
  M.topLeftCorner<3, 3>() += Skew(sum);
  M.topRightCorner<3, 1>() = difference;
  M.bottomLeftCorner<1, 3>() = -difference.transpose();
  return M;
}

struct LinearSolution {
  Eigen::Quaterniond R_B_C;
  // Second smallest singular value over the root of the weights. With the true R_B_C, M^T M of a
  // pair that rotates by alpha about a is 4 sin^2(alpha / 2) (I - a a^T) across q and 0 along q:
  // the value is the rms rotation about axes other than the main one [rad].
  double second_turn = 0;
};

LinearSolution SolveLinear(const std::vector<RotationPair>& pairs,
                           const std::vector<double>& weights) {
  Eigen::Matrix4d squares = Eigen::Matrix4d::Zero();
  double sum = 0;
  for (size_t i = 0; i < pairs.size(); ++i) {
    const Eigen::Matrix4d M = Constraint(pairs[i]);
    squares += weights[i] * M.transpose() * M;
    sum += weights[i];
  }
  // Eigenvalues and vectors of the symmetric matrix; Eigen's solver for these takes far longer to
  // compile.
  const Eigen::JacobiSVD<Eigen::Matrix4d> svd(squares, Eigen::ComputeFullV);
  LinearSolution solution;
  solution.R_B_C = Eigen::Quaterniond(Eigen::Vector4d(svd.matrixV().col(3)));
  solution.second_turn = std::sqrt(svd.singularValues()(2) / sum);
  return solution;
}

LinearSolution SolveLinear(const std::vector<RotationPair>& pairs) {
  // Both rotation angles are equal for any R_B_C, which reveals most outliers at once.
  std::vector<double> weights;
  weights.reserve(pairs.size());
  for (const RotationPair& pair : pairs) {
    weights.push_back(
        GemanMcClureWeight(Angle(pair.R_B0_B1) - Angle(pair.R_then_now), kLinearTolerance));
  }
  LinearSolution solution = SolveLinear(pairs, weights);
  for (int k = 0; k < kLinearIterations; ++k) {
    for (size_t i = 0; i < pairs.size(); ++i) {
      const Eigen::Quaterniond seen =
          solution.R_B_C * pairs[i].R_then_now * solution.R_B_C.conjugate();
      weights[i] = GemanMcClureWeight(Angle(pairs[i].R_B0_B1.conjugate() * seen), kLinearTolerance);
    }
    solution = SolveLinear(pairs, weights);
  }
  return solution;
}

// Estimates R_B_C and the gyroscope bias together by Gauss-Newton.
class Refiner {
 public:
  Refiner(const std::vector<RotationPair>& pairs, const Eigen::Quaterniond& R_B_C,
          double bias_deviation)
      : pairs_(pairs), R_B_C_(R_B_C), bias_deviation_(bias_deviation) {}

  // Runs with a wide tolerance at first, while the bias is unknown.
  void Run() {
    for (int k = 0; k < kRotationRefinements; ++k) Step(kLinearTolerance);
    for (int k = 0; k < kRotationRefinements; ++k) Step(0);
  }
  const Eigen::Quaterniond& R_B_C() const { return R_B_C_; }
  double inlier_share() const { return inlier_share_; }
  double Deviation() const;

 private:
  void Step(double tolerance);

  const std::vector<RotationPair>& pairs_;
  Eigen::Quaterniond R_B_C_;
  Eigen::Vector3d bias_ = Eigen::Vector3d::Zero();
  double bias_deviation_;
  Matrix6d information_ = Matrix6d::Zero();
  double inlier_share_ = 0;
};

// Takes one step over R_B_C <- Exp(theta) R_B_C and the bias. A bias b changes R_B0_B1 to R_B0_B1
// Exp(-Jr(phi) b duration), where phi is its logarithm, if the rate was constant. `tolerance` is
// the least scale of the robust loss [rad].
void Refiner::Step(double tolerance) {
  information_.setZero();
  Vector6d gradient = Vector6d::Zero();
  information_.bottomRightCorner<3, 3>().diagonal().setConstant(
      1 / (bias_deviation_ * bias_deviation_));
  gradient.tail<3>() = bias_ / (bias_deviation_ * bias_deviation_);
  int inliers = 0;
  for (const RotationPair& pair : pairs_) {
    const Eigen::Matrix3d d_turn_d_bias = pair.duration * SO3RightJacobian(SO3Log(pair.R_B0_B1));
    const Eigen::Quaterniond R_B0_B1 = pair.R_B0_B1 * SO3Exp(-d_turn_d_bias * bias_);
    const Eigen::Quaterniond seen = R_B_C_ * pair.R_then_now * R_B_C_.conjugate();
    const Eigen::Vector3d residual = SO3Log(R_B0_B1.conjugate() * seen) / pair.deviation;
    Eigen::Matrix<double, 3, 6> J;
    J << seen.toRotationMatrix().transpose() - Eigen::Matrix3d::Identity(), d_turn_d_bias;
    J /= pair.deviation;
    const double weight = GemanMcClureWeight(
        residual.norm(), std::max(kRotationInlierSigmas, tolerance / pair.deviation));
    information_ += weight * J.transpose() * J;
    gradient += weight * J.transpose() * residual;
    inliers += residual.norm() < kRotationInlierSigmas;
  }
  inlier_share_ = static_cast<double>(inliers) / static_cast<double>(pairs_.size());
  // Rotations about one axis leave theta unobservable along it; a prior of ten radians keeps the
  // equations solvable.
  information_.topLeftCorner<3, 3>().diagonal().array() += 0.01;
  const Vector6d step = -SolveSymmetric(information_, gradient);
  R_B_C_ = (SO3Exp(step.head<3>()) * R_B_C_).normalized();
  bias_ += step.tail<3>();
}

// Returns the standard deviation of R_B_C about its least certain axis, with the bias marginalized
// [rad].
double Refiner::Deviation() const {
  const Eigen::Matrix3d covariance = InverseOfSymmetric(information_).topLeftCorner<3, 3>();
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen;
  eigen.computeDirect(covariance, Eigen::EigenvaluesOnly);
  return std::sqrt(eigen.eigenvalues().maxCoeff());
}

}  // namespace

std::optional<Eigen::Quaterniond> CalibrateExtrinsicRotation(
    const std::vector<RotationPair>& pairs, const ExtrinsicRotationOptions& options,
    std::string* reason) {
  if (pairs.empty() || pairs.size() < options.min_pairs) {
    *reason = "turn the camera about all axes: " + std::to_string(pairs.size()) + " of " +
              std::to_string(options.min_pairs) + " image pairs";
    return std::nullopt;
  }
  const LinearSolution linear = SolveLinear(pairs);
  if (linear.second_turn < options.min_second_turn) {
    *reason = Format("turn about a second axis: %.1f deg of %.1f deg per image pair",
                     ToDegrees(linear.second_turn), ToDegrees(options.min_second_turn));
    return std::nullopt;
  }
  Refiner refiner(pairs, linear.R_B_C, options.gyro_bias_deviation);
  refiner.Run();
  if (refiner.inlier_share() < kMinInlierShare) {
    *reason = Format("camera and gyro disagree: %.0f %% of %.0f %% of the image pairs fit",
                     100 * refiner.inlier_share(), 100 * kMinInlierShare);
    return std::nullopt;
  }
  if (refiner.Deviation() > options.max_deviation) {
    *reason = Format("turn more: uncertain by %.1f deg of at most %.1f deg",
                     ToDegrees(refiner.Deviation()), ToDegrees(options.max_deviation));
    return std::nullopt;
  }
  return refiner.R_B_C();
}

}  // namespace plm_vins
