// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/uncertainty/motion_evidence.h"

#include "common/geometry/small_cholesky.h"
#include "vins_estimator/factors/imu_factor.h"

namespace plm_vins {
namespace {

// Returns the covariance of the same samples if `noise` were the only noise, without doubts.
Matrix15d CovarianceFrom(const ImuNoise& noise, const Preintegration& motion) {
  Preintegration alone(noise, motion.linearization_bias());
  for (ImuSample sample : motion.samples()) {
    sample.gyro_doubt = sample.accel_doubt = 0;
    alone.Append(sample);
  }
  return alone.Covariance();
}

// Returns the covariance of the IMU residual, propagated from the covariance of both states.
std::optional<Matrix15d> SolutionCovariance(int64_t begin_ns, int64_t end_ns,
                                            const ImuResidualJacobians& jacobians,
                                            NormalEquations* equations) {
  const auto states = equations->Covariance({{BlockKind::kPose, begin_ns},
                                             {BlockKind::kMotion, begin_ns},
                                             {BlockKind::kPose, end_ns},
                                             {BlockKind::kMotion, end_ns}});
  if (!states) return std::nullopt;
  Eigen::MatrixXd J(15, 30);
  J << jacobians.ByFirst(), jacobians.BySecond();
  return J * *states * J.transpose();
}

}  // namespace

std::optional<ImuNoiseEvidence> EvidenceOfMotion(const Preintegration& motion,
                                                 const Eigen::Vector3d& gravity_W,
                                                 const FrameState& begin, const FrameState& end,
                                                 NormalEquations* equations) {
  ImuResidualJacobians jacobians;
  const Vector15d residual = ImuResidual(motion, gravity_W, begin, end, &jacobians);
  const auto known = SolutionCovariance(begin.t_ns, end.t_ns, jacobians, equations);
  if (!known) return std::nullopt;
  Matrix15d L = motion.Covariance();
  FactorizeCholesky(&L);
  const Vector15d weighted = SolveByCholesky(L, residual);
  const Matrix15d rest = Matrix15d::Identity() - SolveByCholesky(L, *known).transpose();
  const Matrix15d P = SolveByCholesky(L, rest);
  const auto evidence = [&](double density, const ImuNoise& source) {
    const Matrix15d S_k = CovarianceFrom(source, motion);
    const Matrix15d P_S_k = P * S_k;
    return DensityEvidence{density, weighted.dot(S_k * weighted), P_S_k.trace(),
                           P_S_k.cwiseProduct(P_S_k.transpose()).sum()};
  };
  const ImuNoise noise = motion.noise();
  return ImuNoiseEvidence{evidence(noise.accel_density, {0, noise.accel_density, 0, 0}),
                          evidence(noise.gyro_density, {noise.gyro_density, 0, 0, 0})};
}

}  // namespace plm_vins
