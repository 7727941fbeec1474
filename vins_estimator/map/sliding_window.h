// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "common/camera/camera_model.h"
#include "common/geometry/rigid3.h"
#include "vins_estimator/geometry/timed_bearing.h"
#include "vins_estimator/imu/preintegration.h"
#include "vins_estimator/state/frame_state.h"

namespace plm_vins {

// One image's place in the window.
struct WindowFrame {
  FrameState state;
  ImageTiming timing;
  // Motion since the frame before in the window; null in the first frame.
  std::shared_ptr<Preintegration> motion_since_previous;
  bool stationary = false;      // stood still ever since the frame before
  int64_t moving_since_ns = 0;  // else: stamp of the last image before it seemed to move
};

// A frame that has left the window while its pose stays in the estimate, for what it has seen of
// lines that may come back.
struct AnchorFrame {
  FrameState state;         // its pose; the motion is what it was then
  int64_t last_use_ns = 0;  // the newest frame with a line that this one has seen
};

// The variables of the estimator other than landmarks. Frames: keyframes, oldest first, then the
// newest image.
struct SlidingWindow {
  std::vector<WindowFrame> frames;
  std::vector<AnchorFrame> anchors;
  std::array<double, 7> extrinsic = {0, 0, 0, 0, 0, 0, 1};  // T_B_C, laid out like FrameState::pose
  double td = 0;                                            // t_imu = t_image + td [s]
  double readout = 0;  // time of a rolling shutter, from the first row to the last [s]
  Intrinsics intrinsics = Intrinsics::Zero();      // of the camera
  Intrinsics ray_intrinsics = Intrinsics::Zero();  // that all rays were computed with: near those
  Eigen::Vector3d gravity_W = Eigen::Vector3d(0, 0, -9.81);  // [m/s^2]

  WindowFrame& newest() { return frames.back(); }
  const WindowFrame& newest() const { return frames.back(); }
  WindowFrame& second_newest() { return frames[frames.size() - 2]; }
  const WindowFrame& second_newest() const { return frames[frames.size() - 2]; }

  Rigid3d T_B_C() const {
    return {Eigen::Quaterniond(Eigen::Map<const Eigen::Quaterniond>(extrinsic.data() + 3)),
            Eigen::Map<const Eigen::Vector3d>(extrinsic.data())};
  }
  void SetExtrinsic(const Rigid3d& T_B_C);

  // By stamp; std::logic_error where there is none: whatever refers to a frame must be removed
  // before the frame.
  WindowFrame& FrameAt(int64_t t_ns);
  AnchorFrame& AnchorAt(int64_t t_ns);
  // The state of a frame or an anchor.
  FrameState& StateAt(int64_t t_ns);
  const FrameState& StateAt(int64_t t_ns) const;

  // Where a corner is at the time of its frame's state.
  Eigen::Vector2d AtState(const TimedBearing& bearing) const {
    return bearing.At(td + bearing.Delay(readout));
  }

  // Camera pose of a frame or an anchor.
  Rigid3d T_W_C(const FrameState& state) const { return state.T_W_B() * T_B_C(); }
  Rigid3d T_W_C(const WindowFrame& frame) const { return T_W_C(frame.state); }
  Rigid3d T_W_C(int64_t t_ns) const { return T_W_C(StateAt(t_ns)); }

  // Says since which image the body has stood still up to the newest frame, which has just come;
  // nothing: it has not. The frame before may have seemed to move only.
  void SetStillSince(std::optional<int64_t> still_since_ns);

  // Whether any of the frames is stationary.
  bool HasStationary() const;

  // Takes out the frame before the newest; the newest frame's motion then starts one frame earlier.
  void RemoveSecondNewest();
  void RemoveOldest();

  // The oldest frame leaves the window and becomes an anchor.
  void TurnOldestIntoAnchor();
  void RemoveAnchor(int64_t t_ns);
};

}  // namespace plm_vins
