// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/monitoring/imu_agreement.h"

#include "vins_estimator/factors/imu_factor.h"

namespace plm_vins {
namespace {

// Limit for the residual of an interval: five times its mean in flights with correct noise.
constexpr double kUndoubtedChiSquare = 4;

// Standard deviations of bias steps that a shock, warm-up or sensor failure may cause.
constexpr BiasStep kBiasStep = {0.1, 0.2};  // [rad/s], [m/s^2]

}  // namespace

void DoubtInterval(const ImuNoise& noise, Preintegration* motion) {
  motion->Reweigh(noise);
  motion->AllowBiasStep(kBiasStep);
}

std::optional<double> ImuAgreement::Add(const SlidingWindow& window, const PointMap::Fit& fit) {
  const WindowFrame& newest = window.newest();
  const FrameState& before = window.second_newest().state;
  const Preintegration& motion = *newest.motion_since_previous;
  const Eigen::Vector3d turn_residual =
      ImuResidual(motion, window.gravity_W, before, newest.state, nullptr)
          .segment<3>(ImuErrorIndex::kRotation);
  AddTurn(motion, turn_residual);

  ImuMonitor::Evidence evidence{newest.state.t_ns};
  evidence.chi_square = ImuChiSquare(motion, window.gravity_W, before, newest.state);
  evidence.points = fit.seen;
  evidence.contradicted = fit.contradicted;
  evidence.turn_residual = turn_residual;
  return imu_monitor_.Add(evidence);
}

bool ImuAgreement::IsUndoubted(const SlidingWindow& window, int64_t t_ns) const {
  for (size_t i = window.frames.size() - 1; window.frames[i].state.t_ns > t_ns; --i) {
    const WindowFrame& to = window.frames[i];
    const FrameState& from = window.frames[i - 1].state;
    const double chi_square =
        ImuChiSquare(*to.motion_since_previous, window.gravity_W, from, to.state);
    if (chi_square > kUndoubtedChiSquare) return false;
  }
  return noise_scale() == 1;
}

void ImuAgreement::AddTurn(const Preintegration& motion, const Eigen::Vector3d& residual) {
  if (motion.HasGap()) {  // the rotation in a gap is unknown
    stamp_jitter_.Skip();
    return;
  }
  stamp_jitter_.Add(residual, motion.samples().back().gyro);
}

}  // namespace plm_vins
