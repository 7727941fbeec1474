// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/bridging/frame_placement.h"

#include "common/geometry/so3.h"
#include "common/geometry/symmetric_system.h"

namespace plm_vins {
namespace {

using Index = ImuErrorIndex;

constexpr double kMaxChiSquare = 20.5;  // 1 - 1e-3 quantile with five degrees of freedom

}  // namespace

FramePlacement::FramePlacement(const FrameState& known, const FrameState& fresh) {
  const double heading = Yaw(known.rotation() * fresh.rotation().conjugate());
  const Eigen::Quaterniond R(Eigen::AngleAxisd(heading, Eigen::Vector3d::UnitZ()));
  T_known_fresh_ = Rigid3d(R, known.position() - R * fresh.position());
}

FrameState FramePlacement::Apply(FrameState state) const {
  state.SetPose(T_known_fresh_ * state.T_W_B());
  state.velocity() = T_known_fresh_.rotation * state.velocity().eval();
  return state;
}

bool DifferByFrame(const UncertainState& known, const FrameState& fresh,
                   const FreshDeviations& deviations) {
  const FrameState placed = FramePlacement(known.state, fresh).Apply(fresh);
  const Eigen::Matrix3d R_W_B = known.state.rotation().toRotationMatrix();
  Eigen::Matrix<double, 5, 1> difference;  // inclination about x and y, velocity
  difference << SO3Log(placed.rotation() * known.state.rotation().conjugate()).head<2>(),
      placed.velocity() - known.state.velocity();

  // Velocities are compared at equal headings, so an error of the known heading rotates the
  // velocity difference.
  Eigen::Matrix<double, 5, 15> d_difference_d_known = Eigen::Matrix<double, 5, 15>::Zero();
  d_difference_d_known.block<2, 3>(0, Index::kRotation) = R_W_B.topRows<2>();
  d_difference_d_known.block<3, 3>(2, Index::kRotation) =
      Skew(known.state.velocity()) * Eigen::Vector3d::UnitZ() * R_W_B.row(2);
  d_difference_d_known.block<3, 3>(2, Index::kVelocity).setIdentity();

  Eigen::Matrix<double, 5, 1> deviation;
  deviation << Eigen::Vector2d::Constant(deviations.inclination),
      Eigen::Vector3d::Constant(deviations.velocity);
  Eigen::Matrix<double, 5, 5> covariance =
      d_difference_d_known * known.covariance * d_difference_d_known.transpose();
  covariance.diagonal() += deviation.cwiseAbs2();
  return difference.dot(SolveSymmetric(covariance, difference)) < kMaxChiSquare;
}

}  // namespace plm_vins
