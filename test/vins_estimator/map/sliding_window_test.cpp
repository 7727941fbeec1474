// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/map/sliding_window.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "common/geometry/so3.h"
#include "test/testing/message_of.h"
#include "test/testing/numeric_jacobian.h"

namespace plm_vins {
namespace {

using Eigen::Vector3d;

constexpr int64_t kInterval = 50'000'000;    // between frames [ns]
constexpr int64_t kImuInterval = 5'000'000;  // [ns]

ImuSample SampleAt(int64_t t_ns) {
  const double t = ToSeconds(t_ns);
  return {t_ns, Vector3d(std::sin(t), 0.5 * std::cos(3 * t), 0.3),
          Vector3d(1 + t, std::sin(5 * t), 9.81)};
}

std::shared_ptr<Preintegration> Integrate(int64_t from_ns, int64_t to_ns, const ImuBias& bias) {
  auto result = std::make_shared<Preintegration>(ImuNoise(), bias);
  for (int64_t t = from_ns; t <= to_ns; t += kImuInterval) result->Append(SampleAt(t));
  return result;
}

SlidingWindow MakeWindow(int frames) {
  SlidingWindow window;
  for (int i = 0; i < frames; ++i) {
    WindowFrame frame;
    frame.state.t_ns = i * kInterval;
    const ImuBias bias{{0.01 * i, 0, 0}, {0, 0.001 * i, 0}};
    if (i > 0) frame.motion_since_previous = Integrate((i - 1) * kInterval, i * kInterval, bias);
    frame.stationary = true;
    window.frames.push_back(frame);
  }
  return window;
}

TEST(SlidingWindow, ErrorNamesTheMissingFrame) {
  SlidingWindow window = MakeWindow(3);
  EXPECT_THROW(window.FrameAt(7), std::logic_error);
  EXPECT_THROW(window.AnchorAt(kInterval), std::logic_error);
  EXPECT_EQ(testing::MessageOf([&] {
              window.T_W_C({7, 0});
            }),
            "no frame with stamp 7 in the window");
}

TEST(SlidingWindow, CameraPoseIsBodyPoseTimesExtrinsics) {
  SlidingWindow window = MakeWindow(1);
  window.cameras.resize(2);
  const Rigid3d T_B_C(SO3Exp({0.1, 0.2, 0.3}), {1, 2, 3}), T_W_B(SO3Exp({0.3, -0.2, 1}), {4, 5, 6});
  window.cameras[1].SetExtrinsics(T_B_C);
  window.frames[0].state.SetPose(T_W_B);
  EXPECT_MATRIX_NEAR(window.cameras[1].T_B_C().translation, T_B_C.translation, 1e-15);
  const Vector3d p_C(0.1, 0.2, 3);
  EXPECT_MATRIX_NEAR(window.T_W_C({window.frames[0].state.t_ns, 1}) * p_C, T_W_B * (T_B_C * p_C),
                     1e-12);
}

TEST(SlidingWindow, RemovingTheSecondNewestJoinsTheImu) {
  SlidingWindow window = MakeWindow(5);
  window.RemoveSecondNewest();  // frame 3
  window.RemoveSecondNewest();  // frame 2
  ASSERT_EQ(window.frames.size(), 3u);
  EXPECT_EQ(window.newest().state.t_ns, 4 * kInterval);
  const Preintegration& joined = *window.newest().motion_since_previous;
  const auto at_once = Integrate(kInterval, 4 * kInterval, window.frames[1].state.bias());
  EXPECT_EQ(joined.samples().size(), at_once->samples().size());
  Preintegration expected = *at_once;
  expected.Repropagate(joined.linearization_bias());
  EXPECT_MATRIX_NEAR(joined.delta_p(), expected.delta_p(), 1e-12);
  EXPECT_MATRIX_NEAR(joined.delta_v(), expected.delta_v(), 1e-12);
  EXPECT_LT(joined.delta_q().angularDistance(expected.delta_q()), 1e-7);
  EXPECT_MATRIX_NEAR(joined.Covariance(), expected.Covariance(), 1e-15);
  EXPECT_MATRIX_NEAR(joined.jacobian(), expected.jacobian(), 1e-12);
  EXPECT_NEAR(joined.duration(), 0.15, 1e-12);
}

TEST(SlidingWindow, JoinedFramesAreStationaryIfBothAre) {
  for (const bool second : {false, true}) {
    for (const bool newest : {false, true}) {
      SlidingWindow window = MakeWindow(3);
      window.frames[1].stationary = second;
      window.frames[2].stationary = newest;
      window.RemoveSecondNewest();
      EXPECT_EQ(window.newest().stationary, second && newest);
    }
  }
}

TEST(SlidingWindow, NextFrameMayMarkAFrameAsStationary) {
  SlidingWindow window = MakeWindow(4);
  window.frames.pop_back();
  window.SetStillSince(std::nullopt);
  EXPECT_FALSE(window.newest().stationary);
  const SlidingWindow moving = window;
  for (const bool far_enough_back : {false, true}) {
    window = moving;
    window.frames.push_back(MakeWindow(4).newest());
    window.SetStillSince(kInterval + (far_enough_back ? 0 : 1), 0.1);
    EXPECT_TRUE(window.newest().stationary);
    EXPECT_EQ(window.newest().flow_at_rest, 0.1);
    EXPECT_EQ(window.second_newest().stationary, far_enough_back);
    EXPECT_EQ(window.second_newest().flow_at_rest, far_enough_back ? 0.1 : 0);
  }
}

TEST(SlidingWindow, JoinedFramesMoveSinceTheFirstMoved) {
  for (const bool second : {false, true}) {
    SlidingWindow window = MakeWindow(3);
    window.frames[1].stationary = second;
    window.frames[1].moving_since_ns = 7;
    window.frames[2].stationary = false;
    window.frames[2].moving_since_ns = 8;
    window.RemoveSecondNewest();
    EXPECT_EQ(window.newest().moving_since_ns, second ? 8 : 7);
  }
}

TEST(SlidingWindow, OldestFrameMayBecomeAnAnchor) {
  SlidingWindow window = MakeWindow(3);
  window.frames[0].state.SetPose({SO3Exp({0.3, -0.2, 1}), {4, 5, 6}});
  const FrameState oldest = window.frames[0].state;
  window.TurnOldestIntoAnchor();
  EXPECT_EQ(window.frames.size(), 2u);
  EXPECT_EQ(window.frames.front().motion_since_previous, nullptr);
  ASSERT_EQ(window.anchors.size(), 1u);
  EXPECT_EQ(window.anchors[0].state.t_ns, oldest.t_ns);
  EXPECT_EQ(window.anchors[0].state.pose, oldest.pose);
  EXPECT_EQ(window.anchors[0].last_use_ns, 2 * kInterval);
}

TEST(SlidingWindow, FindsAnchorsApartFromFrames) {
  SlidingWindow window = MakeWindow(3);
  window.TurnOldestIntoAnchor();
  EXPECT_EQ(&window.AnchorAt(0), &window.anchors[0]);
  EXPECT_THROW(window.FrameAt(0), std::logic_error);
  EXPECT_EQ(&window.StateAt(0), &window.anchors[0].state);
  EXPECT_EQ(&window.StateAt(kInterval), &window.frames[0].state);
}

TEST(SlidingWindow, RemovesTheAnchorWithAStamp) {
  SlidingWindow window = MakeWindow(4);
  for (int i = 0; i < 2; ++i) window.TurnOldestIntoAnchor();
  window.RemoveAnchor(0);
  window.RemoveAnchor(2 * kInterval);  // of a frame
  ASSERT_EQ(window.anchors.size(), 1u);
  EXPECT_EQ(window.anchors[0].state.t_ns, kInterval);
  EXPECT_EQ(window.frames.size(), 2u);
}

}  // namespace
}  // namespace plm_vins
