// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/factors/imu_factor.h"

#include <algorithm>

#include "common/geometry/so3.h"

namespace plm_vins {
namespace {

using Index = ImuErrorIndex;
using Eigen::Matrix3d;
using Eigen::Vector3d;

// Columns in the tangents of pose and motion.
constexpr int kPosition = 0, kRotation = 3;
constexpr int kVelocity = 0, kAccelBias = 3, kGyroBias = 6;

FrameState MakeState(const double* pose, const double* motion) {
  FrameState state;
  std::copy_n(pose, state.pose.size(), state.pose.begin());
  std::copy_n(motion, state.motion.size(), state.motion.begin());
  return state;
}

// Fills the rows of position and velocity. `p_Bi` and `v_Bi` are the changes of position and
// velocity without gravity, in frame i.
void SetTranslationRows(const Preintegration& preintegration, const Matrix3d& R_Bi_W,
                        const Vector3d& p_Bi, const Vector3d& v_Bi, ImuResidualJacobians* J) {
  J->d_residual_d_pose_i.block<3, 3>(Index::kPosition, kPosition) = -R_Bi_W;
  J->d_residual_d_pose_i.block<3, 3>(Index::kPosition, kRotation) = Skew(p_Bi);
  J->d_residual_d_pose_i.block<3, 3>(Index::kVelocity, kRotation) = Skew(v_Bi);
  J->d_residual_d_pose_j.block<3, 3>(Index::kPosition, kPosition) = R_Bi_W;

  const double T = preintegration.duration();
  J->d_residual_d_motion_i.block<3, 3>(Index::kPosition, kVelocity) = -T * R_Bi_W;
  J->d_residual_d_motion_i.block<3, 3>(Index::kVelocity, kVelocity) = -R_Bi_W;
  J->d_residual_d_motion_j.block<3, 3>(Index::kVelocity, kVelocity) = R_Bi_W;
  for (const int row : {Index::kPosition, Index::kVelocity}) {
    J->d_residual_d_motion_i.block<3, 6>(row, kAccelBias) =
        -preintegration.jacobian().block<3, 6>(row, Index::kAccelBias);
  }
}

// Fills the rows of rotation. `R_Bi_Bj` is the states' relative rotation, `error` its residual.
void SetRotationRows(const Preintegration& preintegration, const ImuBias& bias,
                     const Matrix3d& R_Bi_Bj, const Vector3d& error, ImuResidualJacobians* J) {
  const Matrix3d right_inverse = SO3RightJacobianInverse(error);
  J->d_residual_d_pose_i.block<3, 3>(Index::kRotation, kRotation) =
      -right_inverse * R_Bi_Bj.transpose();
  J->d_residual_d_pose_j.block<3, 3>(Index::kRotation, kRotation) = right_inverse;

  const Matrix3d d_rotation_d_bias =
      preintegration.jacobian().block<3, 3>(Index::kRotation, Index::kGyroBias);
  const Vector3d correction =
      d_rotation_d_bias * (bias.gyro - preintegration.linearization_bias().gyro);
  J->d_residual_d_motion_i.block<3, 3>(Index::kRotation, kGyroBias) =
      -right_inverse * SO3Exp(-error).toRotationMatrix() * SO3RightJacobian(correction) *
      d_rotation_d_bias;
}

void SetBiasRows(ImuResidualJacobians* J) {
  J->d_residual_d_motion_i.block<6, 6>(Index::kAccelBias, kAccelBias).diagonal().setConstant(-1);
  J->d_residual_d_motion_j.block<6, 6>(Index::kAccelBias, kAccelBias).diagonal().setConstant(1);
}

// Stores a whitened tangent Jacobian in Ceres' layout, padded with zero columns to ambient size.
template <int kAmbient, int kTangent>
void StoreJacobian(const Matrix15d& sqrt_information,
                   const Eigen::Matrix<double, 15, kTangent>& tangent_jacobian, double* jacobian) {
  if (jacobian == nullptr) return;
  Eigen::Map<Eigen::Matrix<double, 15, kAmbient, Eigen::RowMajor>> ambient(jacobian);
  ambient.setZero();
  ambient.template leftCols<kTangent>() = sqrt_information.lazyProduct(tangent_jacobian);
}

}  // namespace

Vector15d ImuResidual(const Preintegration& preintegration, const Vector3d& gravity_W,
                      const FrameState& state_i, const FrameState& state_j,
                      ImuResidualJacobians* jacobians) {
  const double T = preintegration.duration();
  const ImuBias bias = state_i.bias();
  const Matrix3d R_Bi_W = state_i.rotation().toRotationMatrix().transpose();
  const Vector3d p_Bi = R_Bi_W * (state_j.position() - state_i.position() - state_i.velocity() * T -
                                  0.5 * gravity_W * T * T);
  const Vector3d v_Bi = R_Bi_W * (state_j.velocity() - state_i.velocity() - gravity_W * T);
  const Eigen::Quaterniond q_Bi_Bj = state_i.rotation().conjugate() * state_j.rotation();

  Vector15d residual;
  residual.segment<3>(Index::kPosition) = p_Bi - preintegration.DeltaP(bias);
  residual.segment<3>(Index::kRotation) = SO3Log(preintegration.DeltaQ(bias).conjugate() * q_Bi_Bj);
  residual.segment<3>(Index::kVelocity) = v_Bi - preintegration.DeltaV(bias);
  residual.segment<3>(Index::kAccelBias) = state_j.accel_bias() - state_i.accel_bias();
  residual.segment<3>(Index::kGyroBias) = state_j.gyro_bias() - state_i.gyro_bias();
  if (jacobians == nullptr) return residual;

  jacobians->d_residual_d_pose_i.setZero();
  jacobians->d_residual_d_pose_j.setZero();
  jacobians->d_residual_d_motion_i.setZero();
  jacobians->d_residual_d_motion_j.setZero();
  SetTranslationRows(preintegration, R_Bi_W, p_Bi, v_Bi, jacobians);
  SetRotationRows(preintegration, bias, q_Bi_Bj.toRotationMatrix(),
                  residual.segment<3>(Index::kRotation), jacobians);
  SetBiasRows(jacobians);
  return residual;
}

double ImuChiSquare(const Preintegration& preintegration, const Vector3d& gravity_W,
                    const FrameState& state_i, const FrameState& state_j) {
  const Vector15d residual = ImuResidual(preintegration, gravity_W, state_i, state_j, nullptr);
  const Vector15d whitened = preintegration.SqrtInformation().lazyProduct(residual);
  return whitened.squaredNorm();
}

bool ImuFactor::Evaluate(double const* const* parameters, double* residuals,
                         double** jacobians) const {
  const FrameState state_i = MakeState(parameters[0], parameters[1]);
  const FrameState state_j = MakeState(parameters[2], parameters[3]);
  const Matrix15d& sqrt_information = preintegration_->SqrtInformation();
  ImuResidualJacobians tangent;
  const Vector15d residual = ImuResidual(*preintegration_, gravity_W_, state_i, state_j,
                                         jacobians != nullptr ? &tangent : nullptr);
  Eigen::Map<Vector15d> whitened(residuals);
  whitened = sqrt_information.lazyProduct(residual);
  if (jacobians == nullptr) return true;

  StoreJacobian<7>(sqrt_information, tangent.d_residual_d_pose_i, jacobians[0]);
  StoreJacobian<9>(sqrt_information, tangent.d_residual_d_motion_i, jacobians[1]);
  StoreJacobian<7>(sqrt_information, tangent.d_residual_d_pose_j, jacobians[2]);
  StoreJacobian<9>(sqrt_information, tangent.d_residual_d_motion_j, jacobians[3]);
  return true;
}

}  // namespace plm_vins
