// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "vins_estimator/bridging/uncertain_state.h"
#include "vins_estimator/state/frame_state.h"

namespace plm_vins {

// Standard deviations of a newly initialized window, relative to its own world frame.
struct FreshDeviations {
  double inclination = 0.02;  // [rad]
  double velocity = 0.1;      // [m/s]
};

// Chi-square test of whether two states of the same time differ only by their world frames, that is
// by position and heading. `known` is propagated by the IMU, `fresh` is newly initialized. It
// detects velocity differences of half a meter per second, and so IMU faults that would move the
// position by more than some decimeters within a second.
bool DifferByFrame(const UncertainState& known, const FrameState& fresh,
                   const FreshDeviations& deviations = FreshDeviations());

// Transforms states, the first of which is `fresh`, into the world frame of `known`.
class FramePlacement {
 public:
  FramePlacement(const FrameState& known, const FrameState& fresh);

  FrameState Apply(FrameState state) const;

 private:
  Rigid3d T_known_fresh_;  // rotates about z only, so that gravity stays along -z
};

}  // namespace plm_vins
