// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "vins_estimator/bridging/uncertain_state.h"
#include "vins_estimator/state/frame_state.h"

namespace plm_vins {

// What a new window knows by itself, apart from the world frame that it is put into.
struct FreshDeviations {
  double inclination = 0.02;  // [rad]
  double velocity = 0.1;      // [m/s]
};

// True where two states of one time differ in nothing but their world frames, that is in position
// and heading: a test of chi-square. `known` is what the IMU says, `fresh` a new initialisation.
// Half a metre per second between the two is found, and with it the faults of an IMU that would
// move the position by more than some decimetres within a second.
bool DifferByFrame(const UncertainState& known, const FrameState& fresh,
                   const FreshDeviations& deviations = FreshDeviations());

// Takes states, the first of which is `fresh`, to the world frame of `known`.
class FramePlacement {
 public:
  FramePlacement(const FrameState& known, const FrameState& fresh);

  FrameState Apply(FrameState state) const;

 private:
  Rigid3d T_known_fresh_;  // keeps gravity along -z
};

}  // namespace plm_vins
