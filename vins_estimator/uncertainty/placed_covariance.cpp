// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/uncertainty/placed_covariance.h"

#include <Eigen/Geometry>
#include <vector>

#include "common/geometry/so3.h"
#include "vins_estimator/factors/imu_factor.h"

namespace plm_vins {
namespace {

constexpr int kStateSize = 15;

// Returns the derivative of a state if the frame `base` and all landmarks move as one rigid body.
// Velocity and biases do not change.
Matrix15d RigidMove(const FrameState& base, const FrameState& state) {
  const Eigen::Matrix3d R_W_B0 = base.rotation().toRotationMatrix();
  Matrix15d move = Matrix15d::Zero();
  move.block<3, 3>(0, 0).setIdentity();
  move.block<3, 3>(0, 3) = -Skew(state.position() - base.position()) * R_W_B0;
  move.block<3, 3>(3, 3) = state.rotation().toRotationMatrix().transpose() * R_W_B0;
  return move;
}

}  // namespace

// Let x_0 be the error of the keyframe, P the covariance of the states after it given x_0 = 0, J_0
// and J the IMU Jacobians with respect to x_0 and to those states, and T their rigid motion. The
// minimum is at
//   S x_0,   S = T - P J^T (J T + J_0),
// because the landmark terms are invariant along T.
std::optional<Matrix15d> PlacedCovariance(const SlidingWindow& window, int64_t keyframe_ns,
                                          const Matrix15d& keyframe_covariance,
                                          NormalEquations* equations) {
  size_t base = window.frames.size() - 1;
  while (window.frames[base].state.t_ns > keyframe_ns) --base;
  const auto states = static_cast<int>(window.frames.size() - 1 - base);
  const FrameState& keyframe = window.frames[base].state;

  std::vector<BlockId> ids;
  Matrix15d move = Matrix15d::Identity();  // T of the previous state
  Eigen::MatrixXd pull = Eigen::MatrixXd::Zero(kStateSize * (states + 1), kStateSize);
  for (int i = 0; i < states; ++i) {
    const FrameState& from = window.frames[base + i].state;
    const WindowFrame& to = window.frames[base + i + 1];
    ids.insert(ids.end(), {{BlockKind::kPose, to.state.t_ns}, {BlockKind::kMotion, to.state.t_ns}});
    ImuResidualJacobians jacobians;
    ImuResidual(*to.motion_since_previous, window.gravity_W, from, to.state, &jacobians);
    const Matrix15d& whiten = to.motion_since_previous->SqrtInformation();
    const Matrix15d J_from = whiten * jacobians.ByFirst(), J_to = whiten * jacobians.BySecond();
    const Matrix15d next_move = RigidMove(keyframe, to.state);
    const Matrix15d residual = J_from * move + J_to * next_move;
    pull.middleRows<kStateSize>(kStateSize * i) += J_from.transpose() * residual;
    pull.middleRows<kStateSize>(kStateSize * (i + 1)) += J_to.transpose() * residual;
    move = next_move;
  }
  const auto P = equations->Covariance(ids);
  if (!P) return std::nullopt;
  const Matrix15d S = move - P->bottomRows<kStateSize>() * pull.bottomRows(kStateSize * states);
  return P->bottomRightCorner<kStateSize, kStateSize>() + S * keyframe_covariance * S.transpose();
}

}  // namespace plm_vins
