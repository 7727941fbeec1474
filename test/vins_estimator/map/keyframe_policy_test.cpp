// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/map/keyframe_policy.h"

#include <gtest/gtest.h>

namespace plm_vins {
namespace {

constexpr double kFocalLength = 400;  // [px]

// Two frames. The newest has `tracked` corners of the first, displaced by `parallax`, and `fresh`
// new ones.
struct Case {
  double interval = 0.1;  // [s]
  int tracked = 100;
  int fresh = 0;
  double parallax = 0.0;  // normalized
  size_t at_rest = 0;     // number of newest frames at standstill
};

void AddPoints(int64_t first_id, int count, double x, PointFrame* frame) {
  for (int i = 0; i < count; ++i) {
    frame->points.emplace_back();
    frame->points.back().id = first_id + i;
    frame->points.back().xy.x() = x;
  }
}

bool Keyframe(const Case& c, size_t frame_count = 2) {
  SlidingWindow window;
  PointMap points;
  for (size_t i = 0; i < frame_count; ++i) {
    WindowFrame frame;
    frame.state.t_ns = ToNanoseconds(static_cast<double>(i) * c.interval);
    window.frames.push_back(frame);
  }
  for (size_t i = frame_count - c.at_rest; i < frame_count; ++i) window.frames[i].stationary = true;
  PointFrame before, newest;
  newest.t_ns = window.newest().state.t_ns;
  if (frame_count > 1) before.t_ns = window.second_newest().state.t_ns;
  AddPoints(0, 150, 0.1, &before);
  AddPoints(0, c.tracked, 0.1 + c.parallax, &newest);
  AddPoints(1000, c.fresh, 0, &newest);
  if (frame_count > 1) points.AddFrame(before, {});
  points.AddFrame(newest, {});
  return IsKeyframe(KeyframePolicyOptions(EstimatorConfig(), kFocalLength), window, points);
}

TEST(KeyframePolicy, FirstFrameIsAKeyframe) { EXPECT_TRUE(Keyframe({}, 1)); }

TEST(KeyframePolicy, ParallaxMakesAKeyframe) {
  EXPECT_FALSE(Keyframe({}));
  const double limit = EstimatorConfig().keyframe_parallax / kFocalLength;
  EXPECT_FALSE(Keyframe({0.1, 100, 0, 0.9 * limit}));
  EXPECT_TRUE(Keyframe({0.1, 100, 0, 1.1 * limit}));
}

TEST(KeyframePolicy, LostTracksMakeAKeyframe) {
  EXPECT_FALSE(Keyframe({0.1, 20}));
  EXPECT_TRUE(Keyframe({0.1, 19}));
  EXPECT_FALSE(Keyframe({0.1, 60, 60}));
  EXPECT_TRUE(Keyframe({0.1, 60, 61}));
}

// The second newest frame is the last keyframe: a full window has `window_size` frames.
TEST(KeyframePolicy, KeyframesOfAFullWindowAreApart) {
  const size_t full = EstimatorConfig().window_size;
  const double far = 1.1 * EstimatorConfig().keyframe_parallax / kFocalLength;
  EXPECT_TRUE(Keyframe({0.05, 100, 0, far}, full - 1));
  EXPECT_FALSE(Keyframe({0.05, 100, 0, far}, full));
  EXPECT_TRUE(Keyframe({0.1, 100, 0, far}, full));
  EXPECT_TRUE(Keyframe({0.05, 60, 61}, full)) << "most corners are new";
  EXPECT_TRUE(Keyframe({0.05, 19}, full)) << "few corners are left";
}

TEST(KeyframePolicy, TimeMakesAKeyframe) {
  EXPECT_FALSE(Keyframe({0.95}));
  EXPECT_TRUE(Keyframe({1.05}));
}

// Landmarks outlast a standstill once keyframes have provided its information on the IMU.
TEST(KeyframePolicy, StandstillNeedsMoreTime) {
  EXPECT_FALSE(Keyframe({9.5, 100, 0, 0, 4}, 4));
  EXPECT_TRUE(Keyframe({10.5, 100, 0, 0, 4}, 4));
  EXPECT_TRUE(Keyframe({1.05, 100, 0, 0, 3}, 4));
  EXPECT_TRUE(Keyframe({1.05, 100, 0, 0, 3}, 3));
  EXPECT_TRUE(Keyframe({1.05, 19, 0, 0, 4}, 4)) << "lost tracks";
}

TEST(KeyframePolicy, ImagesWithoutFeaturesAreNoKeyframes) {
  EXPECT_FALSE(Keyframe({0.1, 0}));
  EXPECT_FALSE(Keyframe({1.05, 0}));
  EXPECT_FALSE(Keyframe({1.05, 9}));
  EXPECT_TRUE(Keyframe({1.05, 10}));
  EXPECT_TRUE(Keyframe({3.1, 0}));  // limits the interval of integration without images
}

// A keyframe and two images after it, the second of which is the newest one.
bool EndsAStandstill(double since_keyframe, bool is_stationary, bool stays_stationary) {
  SlidingWindow window;
  for (const double t : {0.0, since_keyframe, since_keyframe + 0.05}) {
    WindowFrame frame;
    frame.state.t_ns = ToNanoseconds(t);
    window.frames.push_back(frame);
  }
  window.second_newest().stationary = is_stationary;
  window.newest().stationary = stays_stationary;
  return EndsStandstill(KeyframePolicyOptions(EstimatorConfig(), kFocalLength), window);
}

TEST(KeyframePolicy, EndOfALongStandstillIsAKeyframe) {
  EXPECT_TRUE(EndsAStandstill(1.05, true, false));
  EXPECT_FALSE(EndsAStandstill(0.95, true, false)) << "no keyframe was put off";
  EXPECT_FALSE(EndsAStandstill(1.05, true, true));
  EXPECT_FALSE(EndsAStandstill(1.05, false, false));
}

}  // namespace
}  // namespace plm_vins
