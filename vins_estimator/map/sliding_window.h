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
#include "vins_estimator/geometry/depth_stream.h"
#include "vins_estimator/geometry/timed_bearing.h"
#include "vins_estimator/imu/preintegration.h"
#include "vins_estimator/map/image_key.h"
#include "vins_estimator/state/frame_state.h"

namespace plm_vins {

// A frame of the window.
struct WindowFrame {
  FrameState state;
  double cut_time_offset = 0;  // see TimedBearing
  // Preintegrated IMU since the previous frame in the window; null in the first frame.
  std::shared_ptr<Preintegration> motion_since_previous;
  bool stationary = false;      // at standstill since the previous frame
  double flow_at_rest = 0;      // of the corners, if they move together all the same [1/s]
  int64_t moving_since_ns = 0;  // if moving: time of the last image before the motion
};

// A frame that has left the window while its pose stays in the estimate, because of its
// observations of lines that may be recognized.
struct AnchorFrame {
  FrameState state;         // only its pose is a variable; the motion is the last estimate
  int64_t last_use_ns = 0;  // time of the newest frame with a line that this one observes
};

// The calibration of a camera.
struct WindowCamera {
  std::array<double, 7> extrinsics = {0, 0, 0, 0,
                                      0, 0, 1};  // T_B_C, laid out like FrameState::pose
  Intrinsics intrinsics = Intrinsics::Zero();
  Intrinsics ray_intrinsics = Intrinsics::Zero();  // with which all rays were computed

  Rigid3d T_B_C() const;
  void SetExtrinsics(const Rigid3d& T_B_C);
};

// The variables of the estimator other than landmarks. `frames` are the keyframes, oldest first,
// then the newest image.
struct SlidingWindow {
  std::vector<WindowFrame> frames;
  std::vector<AnchorFrame> anchors;
  std::vector<WindowCamera> cameras{WindowCamera()};         // by number; at least one
  std::array<double, kDepthStreamSize> depth_stream = {};    // see geometry/depth_stream.h
  double td = 0;                                             // t_imu = t_image + td [s]
  Eigen::Vector3d gravity_W = Eigen::Vector3d(0, 0, -9.81);  // [m/s^2]

  WindowFrame& newest() { return frames.back(); }
  const WindowFrame& newest() const { return frames.back(); }
  WindowFrame& second_newest() { return frames[frames.size() - 2]; }
  const WindowFrame& second_newest() const { return frames[frames.size() - 2]; }

  // Returns a frame by its time; throws std::logic_error if there is none: observations in a frame
  // must be removed before the frame.
  WindowFrame& FrameAt(int64_t t_ns);
  AnchorFrame& AnchorAt(int64_t t_ns);
  // Returns the state of a frame or an anchor.
  FrameState& StateAt(int64_t t_ns);
  const FrameState& StateAt(int64_t t_ns) const;

  // Returns the position of a corner at the time of its frame's state.
  Eigen::Vector2d AtState(const TimedBearing& bearing) const { return bearing.At(td); }

  // Returns the pose of the camera that took an image of a frame or an anchor.
  Rigid3d T_W_C(const ImageKey& image) const {
    return StateAt(image.t_ns).T_W_B() * cameras[image.camera].T_B_C();
  }

  // Sets when standstill began, up to the newest frame, which was just added; nullopt if moving.
  // May reclassify the previous frame as stationary. `flow` is that of all corners since then,
  // which limits the certainty of the standstill.
  void SetStillSince(std::optional<int64_t> still_since_ns, double flow = 0);

  // Ignores the accelerometer after a time: it feels a motion, of a lift, that the camera does not
  // see.
  void IgnoreAccelerationSince(int64_t t_ns);

  // Returns whether any frame is stationary.
  bool HasStationary() const;

  // Returns the longest interval between IMU samples in the window [s].
  double LongestImuInterval() const;

  // Removes the second newest frame and joins its preintegrated measurement to the newest frame's.
  void RemoveSecondNewest();
  void RemoveOldest();

  // Removes the oldest frame from the window and keeps its pose as an anchor.
  void TurnOldestIntoAnchor();
  void RemoveAnchor(int64_t t_ns);
};

}  // namespace plm_vins
