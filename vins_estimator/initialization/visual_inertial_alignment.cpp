// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/initialization/visual_inertial_alignment.h"

#include <cmath>

#include "common/format.h"
#include "common/geometry/so3.h"
#include "common/geometry/symmetric_system.h"
#include "common/geometry/tangent_basis.h"

namespace plm_vins {
namespace {

using Index = ImuErrorIndex;

constexpr int kGyroIterations = 5;
constexpr double kGyroBiasPrior = 0.5;  // standard deviation [rad/s]
constexpr int kGravityIterations = 4;
constexpr double kPositionDeviation = 0.005;   // rough error of the structure's camera centers [m]
constexpr double kSignificant = 3.0;           // standard deviations
constexpr double kGravityNormTolerance = 0.2;  // relative, of the estimate with free norm

// Normal equations of the alignment. Unknowns: one velocity per view, then gravity (3 parameters,
// or 2 in the tangent plane), scale, accelerometer bias.
class AlignmentSystem {
 public:
  AlignmentSystem(const std::vector<AlignmentView>& views,
                  const std::vector<const Preintegration*>& preintegrations,
                  const AlignmentOptions& options)
      : views_(views), preintegrations_(preintegrations), options_(options) {}

  // Solves for gravity_G = fixed_gravity + gravity_basis * unknown and the other unknowns.
  bool Solve(const Eigen::Vector3d& fixed_gravity, const Eigen::MatrixXd& gravity_basis,
             Alignment* result) const;

 private:
  using Rows = Eigen::Matrix<double, 6, Eigen::Dynamic>;
  using Vector6d = Eigen::Matrix<double, 6, 1>;

  void AddInterval(size_t i, const Eigen::Vector3d& fixed_gravity,
                   const Eigen::MatrixXd& gravity_basis, Eigen::MatrixXd* H,
                   Eigen::VectorXd* b) const;

  const std::vector<AlignmentView>& views_;
  const std::vector<const Preintegration*>& preintegrations_;
  const AlignmentOptions options_;
};

// Adds the position and velocity rows of the interval from view i to view i + 1, in the body frame
// at i:
//   R_i^T (p_j - p_i - v_i T - g T^2 / 2) - J_p ba = delta_p,  p = scale q - R_G_B p_B_C
//   R_i^T (v_j - v_i - g T) - J_v ba = delta_v
void AlignmentSystem::AddInterval(size_t i, const Eigen::Vector3d& fixed_gravity,
                                  const Eigen::MatrixXd& gravity_basis, Eigen::MatrixXd* H,
                                  Eigen::VectorXd* b) const {
  const Preintegration& imu = *preintegrations_[i];
  const double T = imu.duration();
  const Eigen::Matrix3d R = views_[i].R_G_B.conjugate().toRotationMatrix();
  const int gravity = 3 * static_cast<int>(views_.size());
  const int scale = gravity + static_cast<int>(gravity_basis.cols());
  const int velocity_i = 3 * static_cast<int>(i), velocity_j = velocity_i + 3;

  Rows A = Rows::Zero(6, H->cols());
  A.block<3, 3>(0, velocity_i) = -T * R;
  A.block(0, gravity, 3, gravity_basis.cols()) = -0.5 * T * T * R * gravity_basis;
  A.block<3, 1>(0, scale) = R * (views_[i + 1].q_G_C - views_[i].q_G_C);
  A.block<3, 3>(0, scale + 1) = -imu.jacobian().block<3, 3>(Index::kPosition, Index::kAccelBias);
  A.block<3, 3>(3, velocity_i) = -R;
  A.block<3, 3>(3, velocity_j) = R;
  A.block(3, gravity, 3, gravity_basis.cols()) = -T * R * gravity_basis;
  A.block<3, 3>(3, scale + 1) = -imu.jacobian().block<3, 3>(Index::kVelocity, Index::kAccelBias);

  const Eigen::Vector3d lever = views_[i + 1].R_G_B * options_.T_B_C.translation -
                                views_[i].R_G_B * options_.T_B_C.translation;
  const ImuBias bias{Eigen::Vector3d::Zero(), imu.linearization_bias().gyro};
  Vector6d right;
  right.head<3>() = imu.DeltaP(bias) + R * (lever + 0.5 * T * T * fixed_gravity);
  right.tail<3>() = imu.DeltaV(bias) + T * R * fixed_gravity;

  Eigen::Matrix<double, 6, 6> covariance;
  const Matrix15d full = imu.Covariance();
  covariance << full.block<3, 3>(Index::kPosition, Index::kPosition),
      full.block<3, 3>(Index::kPosition, Index::kVelocity),
      full.block<3, 3>(Index::kVelocity, Index::kPosition),
      full.block<3, 3>(Index::kVelocity, Index::kVelocity);
  covariance.topLeftCorner<3, 3>().diagonal().array() +=
      2 * kPositionDeviation * kPositionDeviation;
  const Rows weighted = InverseOfSymmetric(covariance) * A;
  *H += weighted.transpose().lazyProduct(A);
  *b += weighted.transpose() * right;
}

bool AlignmentSystem::Solve(const Eigen::Vector3d& fixed_gravity,
                            const Eigen::MatrixXd& gravity_basis, Alignment* result) const {
  const int n = static_cast<int>(views_.size());
  const int gravity = 3 * n, scale = gravity + static_cast<int>(gravity_basis.cols());
  const int size = scale + 4;
  Eigen::MatrixXd H = Eigen::MatrixXd::Zero(size, size);
  Eigen::VectorXd b = Eigen::VectorXd::Zero(size);
  for (size_t i = 0; i + 1 < views_.size(); ++i) {
    AddInterval(i, fixed_gravity, gravity_basis, &H, &b);
  }
  const double scale_information = 1 / (options_.scale_deviation * options_.scale_deviation);
  H.bottomRightCorner<3, 3>().diagonal().array() +=
      1 / (options_.accel_bias_deviation * options_.accel_bias_deviation);
  H(scale, scale) += scale_information;
  b(scale) += scale_information;
  const auto inverse_factor = InverseCholeskyFactor(H);
  if (!inverse_factor) return false;
  const Eigen::VectorXd x = inverse_factor->transpose() * (*inverse_factor * b);
  if (!x.allFinite()) return false;
  result->scale = x(scale);
  result->scale_deviation = inverse_factor->col(scale).norm();
  result->gravity_G = fixed_gravity + gravity_basis * x.segment(gravity, gravity_basis.cols());
  result->accel_bias = x.tail<3>();
  result->velocity_G.resize(n);
  for (int i = 0; i < n; ++i) result->velocity_G[i] = x.segment<3>(3 * i);
  return true;
}

}  // namespace

std::optional<Eigen::Vector3d> EstimateGyroBias(
    const std::vector<RotationMeasurement>& measurements, std::string* reason) {
  Eigen::Vector3d gyro_bias = Eigen::Vector3d::Zero();
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  for (int iteration = 0; iteration < kGyroIterations; ++iteration) {
    Eigen::Matrix3d H = Eigen::Matrix3d::Identity() / (kGyroBiasPrior * kGyroBiasPrior);
    Eigen::Vector3d g = gyro_bias / (kGyroBiasPrior * kGyroBiasPrior);
    for (const RotationMeasurement& m : measurements) {
      const ImuBias bias{m.preintegration->linearization_bias().accel, gyro_bias};
      const Eigen::Vector3d error = SO3Log(m.R_B0_B1.conjugate() * m.preintegration->DeltaQ(bias));
      const Eigen::Matrix3d J =
          m.preintegration->jacobian().block<3, 3>(Index::kRotation, Index::kGyroBias);
      const double weight = 1 / (1 + error.dot(m.information * error) / 3);  // Cauchy
      H += weight * J.transpose() * m.information * J;
      g += weight * J.transpose() * m.information * error;
    }
    gyro_bias -= SolveSymmetric(H, g);
    covariance = InverseOfSymmetric(H);
  }
  if (covariance.diagonal().maxCoeff() > std::pow(0.1 * kGyroBiasPrior, 2)) {
    *reason = "the gyro bias is unobservable in these images";
    return std::nullopt;
  }
  return gyro_bias;
}

std::vector<RotationMeasurement> RotationsBetween(const StereoStructure& structure,
                                                  const std::vector<Preintegration>& intervals) {
  std::vector<RotationMeasurement> rotations;
  for (size_t i = 0; i < intervals.size(); ++i) {
    // Two errors of about equal size have half the information of one.
    const Eigen::Matrix3d information =
        0.25 * (structure.rotation_information[i] + structure.rotation_information[i + 1]);
    const Eigen::Quaterniond R_B0_B1 =
        structure.T_G_B[i].rotation.conjugate() * structure.T_G_B[i + 1].rotation;
    rotations.push_back({&intervals[i], R_B0_B1, information});
  }
  return rotations;
}

std::optional<Alignment> AlignVisualInertial(
    const std::vector<AlignmentView>& views,
    const std::vector<const Preintegration*>& preintegrations, const AlignmentOptions& options,
    std::string* reason) {
  const AlignmentSystem system(views, preintegrations, options);
  const double gravity_norm = options.gravity_norm;
  Alignment result;
  if (!system.Solve(Eigen::Vector3d::Zero(), Eigen::Matrix3d::Identity(), &result)) {
    *reason = "velocities, gravity and scale are unobservable";
    return std::nullopt;
  }
  const double norm = result.gravity_G.norm();
  if (std::abs(norm / gravity_norm - 1) > kGravityNormTolerance) {
    *reason = Format("estimated gravity is %.2f m/s^2 instead of %.2f", norm, gravity_norm);
    return std::nullopt;
  }
  for (int iteration = 0; iteration < kGravityIterations; ++iteration) {
    const Eigen::Vector3d direction = result.gravity_G.normalized();
    if (!system.Solve(gravity_norm * direction, TangentBasis(direction), &result)) {
      *reason = "velocities, gravity and scale are unobservable";
      return std::nullopt;
    }
  }
  result.gravity_G = gravity_norm * result.gravity_G.normalized();
  if (result.scale <= 0) {
    // With a constant velocity, any scale fits.
    *reason =
        -result.scale < kSignificant * result.scale_deviation
            ? "scale not observable yet: the velocity changes too little"
            : "the estimated scale is negative: check the signs of the accelerometer (it reads "
              "+g upwards at standstill), extrinsicRotation and td";
    return std::nullopt;
  }
  return result;
}

}  // namespace plm_vins
