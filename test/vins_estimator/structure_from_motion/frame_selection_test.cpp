// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/structure_from_motion/frame_selection.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace plm_vins {
namespace {

constexpr int64_t kFrame_ns = 50'000'000;

// Images of 20 points with total displacements `shifts[i]`, each with three IMU samples.
std::deque<FrameMeasurement> MakeFrames(const std::vector<double>& shifts) {
  std::deque<FrameMeasurement> frames;
  for (size_t i = 0; i < shifts.size(); ++i) {
    FrameMeasurement frame;
    frame.t_ns = static_cast<int64_t>(i) * kFrame_ns;
    for (int id = 0; id < 20; ++id) {
      PointObservation point;
      point.id = id;
      point.xy = {0.05 * id + shifts[i], 0.1};
      frame.points.points.push_back(point);
    }
    for (int k = 2; k >= 0; --k) {
      frame.imu.emplace_back();
      frame.imu.back().t_ns = frame.t_ns - k * kFrame_ns / 2;
    }
    frames.push_back(frame);
  }
  return frames;
}

TEST(FrameSelectionTest, SpreadsSteadyMotionEvenly) {
  std::vector<double> shifts;
  for (int i = 0; i <= 50; ++i) shifts.push_back(0.01 * i);
  const auto selected = SelectFrames(MakeFrames(shifts), 11);
  ASSERT_EQ(selected.size(), 11u);
  for (size_t k = 0; k < selected.size(); ++k) EXPECT_EQ(selected[k], 5 * k);
}

TEST(FrameSelectionTest, MotionDrawsFramesFromTheStillPart) {
  std::vector<double> shifts(41, 0.0);
  for (int i = 1; i <= 20; ++i) shifts.push_back(0.01 * i);
  const auto selected = SelectFrames(MakeFrames(shifts), 11);
  ASSERT_EQ(selected.size(), 11u);
  EXPECT_EQ(selected.front(), 0u);
  EXPECT_EQ(selected.back(), 60u);
  const auto moving =
      std::count_if(selected.begin(), selected.end(), [](size_t i) { return i > 40; });
  EXPECT_GE(moving, 6);  // two thirds of the displacement in a third of the time
  EXPECT_LE(moving, 8);
}

TEST(FrameSelectionTest, TakesAllOfFewFrames) {
  const auto selected = SelectFrames(MakeFrames({0, 0.01, 0.02, 0.03}), 11);
  EXPECT_EQ(selected, (std::vector<size_t>{0, 1, 2, 3}));
}

TEST(FrameSelectionTest, JoinsTheImuSamplesBetween) {
  const auto frames = MakeFrames({0, 0.1, 0.2, 0.3, 0.4, 0.5});
  const auto joined = JoinFrames(frames, {0, 2, 5});
  ASSERT_EQ(joined.size(), 3u);
  EXPECT_EQ(joined[0].imu.size(), 3u);
  EXPECT_EQ(joined[1].imu.size(), 5u);
  EXPECT_EQ(joined[2].imu.size(), 7u);
  for (size_t k = 1; k < joined.size(); ++k) {
    const auto& imu = joined[k].imu;
    EXPECT_EQ(imu.front().t_ns, joined[k - 1].t_ns);
    EXPECT_EQ(imu.back().t_ns, joined[k].t_ns);
    for (size_t i = 1; i < imu.size(); ++i) EXPECT_EQ(imu[i].t_ns - imu[i - 1].t_ns, kFrame_ns / 2);
  }
}

TEST(FrameSelectionTest, FlowIsTheMedianOfCommonPoints) {
  auto frames = MakeFrames({0, 0.02});
  for (int i = 0; i < 5; ++i) frames[1].points.points[i].xy.x() += 1;  // five wrong tracks
  frames[1].points.points.resize(18);
  EXPECT_EQ(CountCommonPoints(frames[0].points, frames[1].points), 18);
  EXPECT_NEAR(MedianFlow(frames[0].points, frames[1].points), 0.02, 1e-12);
  EXPECT_EQ(MedianFlow(frames[0].points, PointFrame()), 0);
}

}  // namespace
}  // namespace plm_vins
