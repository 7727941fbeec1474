// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/uncertainty/imu_noise_learning.h"

#include <cmath>

#include "vins_estimator/uncertainty/motion_evidence.h"

namespace plm_vins {
namespace {

// Greatest shift of corners along their velocity [s]. Beyond it their motion is not linear, which
// adds residuals that are not IMU noise; so noise is learned only after the time offset.
constexpr double kMaxShift = 0.002;

bool ShiftsCorners(const WindowFrame& frame, double td) {
  return std::abs(td - frame.cut_time_offset) > kMaxShift;
}

// Returns whether the interval's residuals are due to something else than noise of one density.
bool IsNoEvidence(const WindowFrame& end) {
  const Preintegration& motion = *end.motion_since_previous;
  return end.stationary || motion.HasGap() || motion.HasBiasStep() || !motion.HasOneNoise();
}

}  // namespace

void ImuNoiseLearning::Learn(const SlidingWindow& window, bool is_first,
                             NormalEquations* equations) {
  const size_t intervals = window.frames.size() - 1;
  for (size_t i = 0; i < (is_first ? intervals : intervals / 2); ++i) {
    const WindowFrame &begin = window.frames[i], &end = window.frames[i + 1];
    if (known_ns_ && begin.state.t_ns <= *known_ns_) continue;
    known_ns_ = begin.state.t_ns;
    if (IsNoEvidence(end) || ShiftsCorners(begin, window.td) || ShiftsCorners(end, window.td)) {
      continue;
    }
    const auto evidence = EvidenceOfMotion(*end.motion_since_previous, window.gravity_W,
                                           begin.state, end.state, equations);
    if (evidence) estimate_.Add(*evidence);
  }
}

bool ImuNoiseLearning::Reweigh(SlidingWindow* window) const {
  const ImuNoise noise = estimate_.noise();
  bool any = false;
  for (WindowFrame& frame : window->frames) {
    if (!frame.motion_since_previous) continue;
    Preintegration& motion = *frame.motion_since_previous;
    // Re-integration would remove the bias step, and a doubted interval joined into this one would
    // be trusted again.
    if (motion.HasBiasStep()) continue;
    const ImuNoise& before = motion.noise();
    if (!AreFarNoisier(noise, before)) continue;
    motion.Reweigh(Greater(noise, before));
    any = true;
  }
  return any;
}

}  // namespace plm_vins
