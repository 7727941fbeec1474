// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/lengths/length_likelihood.h"

#include <Eigen/SVD>
#include <algorithm>
#include <cmath>

#include "common/geometry/so3.h"
#include "common/geometry/symmetric_system.h"
#include "common/geometry/tangent_basis.h"

namespace plm_vins {
namespace {

constexpr double kBiasStep = 1e-3;  // for numeric derivatives [m/s^2], [rad/s]
// Standard deviations of start, velocity and acceleration, relative to the size of the path.
constexpr double kUnknown = 100;
constexpr double kLeastSize = 0.1;  // of a path [m]

using MatrixX = Eigen::MatrixXd;
using VectorX = Eigen::VectorXd;

// The camera's path by the IMU, from zero velocity without gravity.
struct Prediction {
  std::vector<Rigid3d> T_G_B;
  std::vector<double> seconds;
  VectorX p_G_C;
};

Prediction Predict(const MeasuredMotion& motion, const ImuBias& bias) {
  const auto count = static_cast<Eigen::Index>(motion.intervals.size() + 1);
  Prediction result{{{motion.R_G_B0, Eigen::Vector3d::Zero()}}, {0}, VectorX(3 * count)};
  Eigen::Vector3d v_G = Eigen::Vector3d::Zero();
  for (const Preintegration* imu : motion.intervals) {
    const Rigid3d& T_G_B = result.T_G_B.back();
    const Eigen::Vector3d p_G =
        T_G_B.translation + v_G * imu->duration() + T_G_B.rotation * imu->DeltaP(bias);
    v_G += T_G_B.rotation * imu->DeltaV(bias);
    result.T_G_B.push_back({(T_G_B.rotation * imu->DeltaQ(bias)).normalized(), p_G});
    result.seconds.push_back(result.seconds.back() + imu->duration());
  }
  for (Eigen::Index i = 0; i < count; ++i) {
    result.p_G_C.segment<3>(3 * i) = (result.T_G_B[i] * motion.T_B_C).translation;
  }
  return result;
}

// Derivatives of the path by the biases, times their deviations.
MatrixX BiasEffects(const MeasuredMotion& motion, const ImuBias& bias, const MotionPrior& prior,
                    const VectorX& p_G_C) {
  MatrixX effects(p_G_C.size(), 6);
  for (int k = 0; k < 6; ++k) {
    ImuBias moved = bias;
    (k < 3 ? moved.accel : moved.gyro)[k % 3] += kBiasStep;
    const double deviation = k < 3 ? prior.accel_bias_deviation : prior.gyro_bias_deviation;
    effects.col(k) = (Predict(motion, moved).p_G_C - p_G_C) * (deviation / kBiasStep);
  }
  return effects;
}

// Returns J A J^T. Lazy products take a compiler far less time, and paths are short.
MatrixX Propagated(const MatrixX& J, const MatrixX& A) {
  const MatrixX half = J.lazyProduct(A);
  return half.lazyProduct(J.transpose());
}

// Covariance of the path by the IMU's noise: that of each interval moves all later views, that of
// its rotation by the gravity that is then inclined.
MatrixX NoiseCovariance(const MeasuredMotion& motion, const Prediction& path,
                        const Eigen::Vector3d& gravity_G) {
  const auto count = static_cast<Eigen::Index>(path.seconds.size());
  MatrixX covariance = MatrixX::Zero(3 * count, 3 * count);
  for (size_t i = 0; i < motion.intervals.size(); ++i) {
    const Eigen::Matrix3d R_G_B = path.T_G_B[i].R();
    MatrixX effect = MatrixX::Zero(3 * count, 9);
    for (auto k = static_cast<Eigen::Index>(i) + 1; k < count; ++k) {
      const double dt = path.seconds[k] - path.seconds[i + 1];
      auto rows = effect.middleRows<3>(3 * k);
      rows.middleCols<3>(ImuErrorIndex::kPosition) = R_G_B;
      rows.middleCols<3>(ImuErrorIndex::kVelocity) = dt * R_G_B;
      rows.middleCols<3>(ImuErrorIndex::kRotation) =
          0.5 * dt * dt * Skew(gravity_G) * path.T_G_B[i + 1].R();
    }
    covariance += Propagated(effect, motion.intervals[i]->Covariance().topLeftCorner<9, 9>());
  }
  return covariance;
}

// Effects of start, velocity and constant acceleration on the stated path.
MatrixX UnknownEffects(const Prediction& path) {
  MatrixX effects(path.p_G_C.size(), 9);
  for (size_t i = 0; i < path.seconds.size(); ++i) {
    const double t = path.seconds[i];
    auto rows = effects.middleRows<3>(3 * static_cast<Eigen::Index>(i));
    rows.leftCols<3>().setIdentity();
    rows.middleCols<3>(3) = t * Eigen::Matrix3d::Identity();
    rows.rightCols<3>() = 0.5 * t * t * Eigen::Matrix3d::Identity();
  }
  return effects;
}

// Returns gravity, if the mean acceleration is small against it.
Eigen::Vector3d MeanGravity(const Prediction& path, const MeasuredMotion& motion, double norm) {
  Eigen::Vector3d force_G = Eigen::Vector3d::Zero();
  for (size_t i = 0; i < motion.intervals.size(); ++i) {
    force_G += path.T_G_B[i].rotation * motion.intervals[i]->delta_v();
  }
  return -norm * force_G.normalized();
}

// The Gaussian of the stated path at all ratios, in coordinates in which both covariances are
// diagonal: q ~ N(r mu, r^2 D + I).
class Spectrum {
 public:
  // Whitening by `W` makes the covariance of the stated path the identity.
  Spectrum(const MatrixX& A, const MatrixX& W, const VectorX& mu, const VectorX& q) {
    // Eigenvalues and vectors; Eigen's solver for these takes far longer to compile.
    const Eigen::JacobiSVD<MatrixX, Eigen::NoQRPreconditioner> eigen(Propagated(W, A),
                                                                     Eigen::ComputeFullV);
    d_ = eigen.singularValues();
    mu_ = eigen.matrixV().transpose() * (W * mu);
    q_ = eigen.matrixV().transpose() * (W * q);
  }

  RatioCurve Curve() const {
    RatioCurve curve;
    for (int i = 0; i < RatioCurve::kPoints; ++i) {
      const double r = std::exp(RatioCurve::LogRatio(i));
      const double half_chi_square = 0.5 * ChiSquare(r);
      const double half_log_determinant = 0.5 * (1 + r * r * d_.array()).log().sum();
      curve.Set(i, -half_chi_square - half_log_determinant, half_chi_square);
    }
    return curve;
  }

  double ChiSquare(double r) const {
    return ((q_ - r * mu_).array().square() / (1 + r * r * d_.array())).sum();
  }

 private:
  VectorX d_, mu_, q_;
};

}  // namespace

std::optional<RatioCurve> LikelihoodOfRatio(const StatedPath& path, const MeasuredMotion& motion,
                                            const MotionPrior& prior) {
  const ImuBias bias{Eigen::Vector3d::Zero(), motion.intervals.front()->linearization_bias().gyro};
  const Prediction prediction = Predict(motion, bias);
  const auto size = prediction.p_G_C.size();
  VectorX q(size);
  MatrixX stated = MatrixX::Zero(size, size);
  double length = kLeastSize;
  for (size_t i = 0; i < path.p_G_C.size(); ++i) {
    const auto row = 3 * static_cast<Eigen::Index>(i);
    q.segment<3>(row) = path.p_G_C[i];
    stated.block<3, 3>(row, row) = path.covariance[i];
    length = std::max(length, (path.p_G_C[i] - path.p_G_C[0]).norm());
  }
  const MatrixX unknown = kUnknown * length * UnknownEffects(prediction);
  const MatrixX of_biases = BiasEffects(motion, bias, prior, prediction.p_G_C);
  MatrixX predicted =
      NoiseCovariance(motion, prediction, MeanGravity(prediction, motion, prior.gravity_norm));
  predicted += of_biases.lazyProduct(of_biases.transpose());
  stated += unknown.lazyProduct(unknown.transpose());
  const auto whitening = InverseCholeskyFactor(stated);
  if (!whitening) return std::nullopt;
  const Spectrum spectrum(predicted, *whitening, prediction.p_G_C, q);
  const RatioCurve curve = spectrum.Curve();
  const double best = std::exp(curve.Estimate(0).log_ratio);
  const double excess =
      spectrum.ChiSquare(best) / std::max(1.0, static_cast<double>(size - unknown.cols()));
  RatioCurve flattened;
  flattened.Add(curve, 1 / std::max(1.0, excess));
  return flattened;
}

}  // namespace plm_vins
