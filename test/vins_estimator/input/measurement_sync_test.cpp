// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/input/measurement_sync.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <vector>

#include "test/vins_estimator/input/sync_input.h"
#include "vins_estimator/imu/preintegration.h"

namespace plm_vins {
namespace {

using testing::AddImu;
using testing::kMs;
using testing::Lines;
using testing::Points;
using testing::PopAll;
using testing::Sample;
using testing::WithLines;

void ExpectOnTheLine(const ImuSample& sample) {
  EXPECT_TRUE(sample.gyro.isApprox(Sample(sample.t_ns).gyro, 1e-9));
  EXPECT_TRUE(sample.accel.isApprox(Sample(sample.t_ns).accel, 1e-9));
}

bool SameSample(const ImuSample& a, const ImuSample& b) {
  return a.t_ns == b.t_ns && a.gyro == b.gyro && a.accel == b.accel;
}

// Expects that the IMU samples of the frames join without gap or overlap: timestamps increase, and
// each frame starts with the last sample of the previous one and ends at t + td.
void ExpectSeamless(const std::vector<FrameMeasurement>& frames) {
  for (size_t i = 0; i < frames.size(); ++i) {
    const std::vector<ImuSample>& imu = frames[i].imu;
    ASSERT_FALSE(imu.empty());
    EXPECT_EQ(imu.back().t_ns, frames[i].t_ns + ToNanoseconds(frames[i].time_offset));
    for (size_t k = 1; k < imu.size(); ++k) EXPECT_GT(imu[k].t_ns, imu[k - 1].t_ns);
    if (i > 0) {
      EXPECT_TRUE(SameSample(imu.front(), frames[i - 1].imu.back()));
    }
  }
}

TEST(MeasurementSync, CutsTheImuAtTheImageTimes) {
  MeasurementSync sync({});
  AddImu(&sync, 0, 200);
  for (int64_t t : {22, 75, 123}) sync.AddPoints(Points(t * kMs));
  const auto frames = PopAll(&sync);
  ASSERT_EQ(frames.size(), 3u);
  ExpectSeamless(frames);
  EXPECT_EQ(frames[0].imu.front().t_ns, 0);
  EXPECT_EQ(frames[0].imu.size(), 6u);   // 0 ... 20, 22
  EXPECT_EQ(frames[1].imu.size(), 12u);  // 22, 25 ... 75: no duplicate at the image time
  EXPECT_EQ(frames[2].imu.size(), 11u);  // 75, 80 ... 120, 123
  for (const auto& frame : frames) {
    for (const ImuSample& sample : frame.imu) ExpectOnTheLine(sample);
    EXPECT_EQ(frame.points.t_ns, frame.t_ns);
    EXPECT_EQ(frame.points.points.size(), 3u);
    EXPECT_FALSE(frame.lines.has_value());
  }
}

TEST(MeasurementSync, ShiftsTheCutByTheTimeOffset) {
  MeasurementSync::Options options;
  options.td = 0.012;
  MeasurementSync sync(options);
  AddImu(&sync, 0, 60);
  sync.AddPoints(Points(50 * kMs));
  EXPECT_FALSE(sync.Pop().has_value());  // needs 62 ms
  AddImu(&sync, 65, 65);
  const auto frame = sync.Pop();
  ASSERT_TRUE(frame.has_value());
  EXPECT_EQ(frame->imu.back().t_ns, 62 * kMs);
  EXPECT_EQ(frame->time_offset, 0.012);
}

TEST(MeasurementSync, AChangingTimeOffsetNeitherLosesNorDoublesSamples) {
  MeasurementSync sync({});
  AddImu(&sync, 0, 500);
  std::vector<FrameMeasurement> frames;
  const double offsets[] = {0.0, 0.013, -0.008, -0.0081, 0.02, 0.0};
  for (int i = 0; i < 6; ++i) {
    sync.SetTimeOffset(offsets[i]);
    sync.AddPoints(Points((50 + 50 * i) * kMs));
    auto frame = sync.Pop();
    ASSERT_TRUE(frame.has_value());
    frames.push_back(std::move(*frame));
  }
  ExpectSeamless(frames);
  size_t originals = 0;  // samples of the stream inside or at the end of the intervals
  for (const auto& frame : frames) {
    for (size_t k = &frame == &frames[0] ? 0 : 1; k < frame.imu.size(); ++k) {
      originals += frame.imu[k].t_ns % (5 * kMs) == 0;
    }
  }
  EXPECT_EQ(originals, 61u);  // 0 ... 300 ms
}

TEST(MeasurementSync, DecreasedOffsetDropsTheFrameAndKeepsItsSamples) {
  MeasurementSync sync({});
  AddImu(&sync, 0, 300);
  sync.AddPoints(Points(50 * kMs));
  std::vector<FrameMeasurement> frames = PopAll(&sync);
  sync.SetTimeOffset(-0.06);
  sync.AddPoints(Points(100 * kMs));  // cut at 40 ms, before the last at 50 ms
  EXPECT_FALSE(sync.Pop().has_value());
  EXPECT_EQ(sync.statistics().frames_too_close, 1);
  sync.AddPoints(Points(150 * kMs));
  for (auto& frame : PopAll(&sync)) frames.push_back(std::move(frame));
  ASSERT_EQ(frames.size(), 2u);
  ExpectSeamless(frames);
}

TEST(MeasurementSync, BadImuSamplesAreDroppedAndCounted) {
  MeasurementSync sync({});
  AddImu(&sync, 0, 20);
  ImuSample bad = Sample(25 * kMs);
  bad.gyro.x() = std::numeric_limits<double>::quiet_NaN();
  sync.AddImu(bad);
  bad = Sample(25 * kMs);
  bad.accel.z() = std::numeric_limits<double>::infinity();
  sync.AddImu(bad);
  sync.AddImu(Sample(20 * kMs));  // repeated
  sync.AddImu(Sample(10 * kMs));  // backwards
  AddImu(&sync, 30, 60);
  sync.AddPoints(Points(50 * kMs));
  const auto frames = PopAll(&sync);
  ASSERT_EQ(frames.size(), 1u);
  ExpectSeamless(frames);
  EXPECT_EQ(frames[0].imu.size(), 10u);  // 0 ... 20, 30 ... 50
  EXPECT_EQ(sync.statistics().imu_not_finite, 2);
  EXPECT_EQ(sync.statistics().imu_out_of_order, 2);
  EXPECT_EQ(sync.statistics().imu_gaps, 0);
}

TEST(MeasurementSync, AnImuGapIsCountedAndBridgedByTheNextFrameWithSamples) {
  MeasurementSync sync({});
  AddImu(&sync, 0, 100);
  AddImu(&sync, 300, 400);
  for (int64_t t : {50, 101, 150, 299, 300, 350}) sync.AddPoints(Points(t * kMs));
  const auto frames = PopAll(&sync);
  ExpectSeamless(frames);
  ASSERT_EQ(frames.size(), 3u);
  EXPECT_EQ(frames[1].t_ns, 300 * kMs);
  const std::vector<ImuSample>& imu = frames[1].imu;
  EXPECT_EQ(imu.back().t_ns - imu[imu.size() - 2].t_ns,
            200 * kMs);  // a single interval, not divided into acceptable ones
  EXPECT_EQ(sync.statistics().imu_gaps, 1);
  EXPECT_EQ(sync.statistics().frames_in_imu_gap, 3);
}

TEST(MeasurementSync, ImagesBeforeTheFirstImuSampleAreDropped) {
  MeasurementSync sync({});
  sync.AddPoints(Points(10 * kMs));
  sync.AddPoints(Points(60 * kMs));
  EXPECT_FALSE(sync.Pop().has_value());  // IMU samples may still arrive
  EXPECT_EQ(sync.statistics().frames_without_imu, 0);
  AddImu(&sync, 60, 100);
  const auto frames = PopAll(&sync);
  ASSERT_EQ(frames.size(), 1u);
  EXPECT_EQ(frames[0].t_ns, 60 * kMs);
  EXPECT_EQ(frames[0].imu.size(), 1u);
  EXPECT_EQ(sync.statistics().frames_without_imu, 1);
}

TEST(MeasurementSync, RepeatedAndBackwardImagesAreDropped) {
  MeasurementSync sync({});
  AddImu(&sync, 0, 200);
  for (int64_t t : {50, 50, 40, 100}) sync.AddPoints(Points(t * kMs));
  EXPECT_EQ(PopAll(&sync).size(), 2u);
  sync.AddPoints(Points(100 * kMs));  // also if the first one has been returned already
  EXPECT_FALSE(sync.Pop().has_value());
  EXPECT_EQ(sync.statistics().frames, 5);
  EXPECT_EQ(sync.statistics().frames_out_of_order, 3);
}

// Includes samples that were returned already, and one that the gate replaced.
TEST(MeasurementSync, RepeatedSamplesAreNoJump) {
  MeasurementSync sync({});
  const auto send = [&sync](int64_t begin_ms, int64_t end_ms) {
    for (int64_t t = begin_ms; t <= end_ms; t += 5) {
      ImuSample sample = testing::Sample(t * kMs);
      if (t == 900) sample.gyro.x() = 30;
      sync.AddImu(sample);
    }
  };
  send(0, 1000);
  for (int64_t t = 50; t <= 1000; t += 50) sync.AddPoints(Points(t * kMs));
  auto frames = PopAll(&sync);
  send(805, 1000);
  send(1005, 1500);
  for (int64_t t = 1050; t <= 1500; t += 50) sync.AddPoints(Points(t * kMs));
  for (auto& frame : PopAll(&sync)) frames.push_back(std::move(frame));
  EXPECT_EQ(sync.statistics().imu_replaced, 1);
  EXPECT_EQ(sync.statistics().imu_out_of_order, 40);
  EXPECT_EQ(sync.statistics().jumps_back, 0);
  EXPECT_EQ(frames.size(), 30u);
}

TEST(MeasurementSync, BackwardJumpIsDetectedAfterMoreThanTenImages) {
  for (const int images : {10, 11}) {
    MeasurementSync sync({});
    for (int64_t t = 0; t <= 1000; t += 50) sync.AddPoints(Points(t * kMs));
    for (int64_t t = 1020 - 50 * images; t <= 1020; t += 50) sync.AddPoints(Points(t * kMs));
    EXPECT_EQ(sync.statistics().jumps_back, images == 11 ? 1 : 0);
  }
}

TEST(MeasurementSync, SingleFrameInTheFutureIsDropped) {
  MeasurementSync sync({});
  AddImu(&sync, 0, 300);
  for (const int64_t t : {50, 3'600'000, 100, 150}) sync.AddPoints(Points(t * kMs));
  EXPECT_EQ(PopAll(&sync).size(), 3u);
  EXPECT_EQ(sync.statistics().frames_ahead_of_time, 1);
  EXPECT_EQ(sync.statistics().frames_out_of_order, 0);
}

TEST(MeasurementSync, FramesAreDroppedAfterTheTimeout) {
  MeasurementSync::Options options;
  options.max_wait = 0.2;
  MeasurementSync sync(options);
  AddImu(&sync, 0, 1000);
  for (int64_t t = 50; t <= 1000; t += 50) sync.AddPoints(Points(t * kMs));
  const auto frames = PopAll(&sync);
  ASSERT_EQ(frames.size(), 5u);
  EXPECT_EQ(frames.front().t_ns, 800 * kMs);
  EXPECT_EQ(frames.front().imu.front().t_ns, 0) << "their samples lead to the next one";
  EXPECT_EQ(sync.statistics().frames_too_late, 15);
  EXPECT_NEAR(sync.statistics().longest_wait, 0.95, 1e-9);
}

// With a slow camera or network, there is nothing newer.
TEST(MeasurementSync, TheNewestFrameIsUsedHoweverLate) {
  MeasurementSync::Options options;
  options.max_wait = 0.2;
  MeasurementSync sync(options);
  for (int64_t t = 50; t <= 1000; t += 50) {
    AddImu(&sync, t - 50, t + 950);
    sync.AddPoints(Points(t * kMs));
    EXPECT_EQ(PopAll(&sync).size(), 1u);
  }
}

TEST(MeasurementSync, FramesWithFewPointsAreCounted) {
  MeasurementSync sync({});
  PointFrame frame = Points(50 * kMs);
  frame.points.resize(9);
  sync.AddPoints(frame);
  frame.t_ns = 100 * kMs;
  frame.points.resize(10);
  sync.AddPoints(frame);
  EXPECT_EQ(sync.statistics().frames_with_few_points, 1);
}

TEST(MeasurementSync, QueuesAreBounded) {
  MeasurementSync::Options options;
  options.max_frames = 3;
  options.max_imu_samples = 20;
  MeasurementSync sync(options);
  for (int64_t t = 10; t <= 50; t += 10) {
    sync.AddPoints(Points(t * kMs));
    sync.AddLines(Lines(t * kMs));
  }
  EXPECT_EQ(sync.queued_frames(), 3u);
  EXPECT_EQ(sync.statistics().frames_dropped_full, 2);
  EXPECT_EQ(sync.statistics().lines_without_points, 2);
  AddImu(&sync, 0, 60);
  std::vector<FrameMeasurement> frames = PopAll(&sync);
  ASSERT_EQ(frames.size(), 3u);
  EXPECT_EQ(frames[0].t_ns, 30 * kMs);

  AddImu(&sync, 65, 300);  // a long time without images: the interval is kept, but not all samples
  EXPECT_GT(sync.statistics().imu_dropped_full, 0);
  sync.AddPoints(Points(300 * kMs));
  for (auto& frame : PopAll(&sync)) frames.push_back(std::move(frame));
  ASSERT_EQ(frames.size(), 4u);
  ExpectSeamless(frames);
  EXPECT_EQ(frames[3].imu.size(), 20u);
}

TEST(MeasurementSync, FlushDeliversFramesCoveredByTheImu) {
  MeasurementSync sync(WithLines());
  AddImu(&sync, 0, 110);
  for (int64_t t : {50, 100, 150}) sync.AddPoints(Points(t * kMs));
  EXPECT_FALSE(sync.Pop().has_value());  // waits for lines
  std::vector<FrameMeasurement> frames;
  while (auto frame = sync.Flush()) frames.push_back(std::move(*frame));
  EXPECT_EQ(frames.size(), 2u);
  ExpectSeamless(frames);
  EXPECT_EQ(sync.queued_frames(), 0u);
  EXPECT_EQ(sync.statistics().frames_without_imu, 1);
}

TEST(MeasurementSync, ClearForgetsTimeAndKeepsTheCounts) {
  MeasurementSync sync(WithLines());
  AddImu(&sync, 1000, 1100);
  sync.AddPoints(Points(1050 * kMs));
  sync.AddLines(Lines(1050 * kMs));
  EXPECT_TRUE(sync.Pop().has_value());
  sync.AddPoints(Points(1090 * kMs));
  sync.Clear();
  EXPECT_EQ(sync.queued_frames(), 0u);

  AddImu(&sync, 0, 100);  // the recording restarts
  sync.AddPoints(Points(50 * kMs));
  sync.AddLines(Lines(50 * kMs));
  const auto frame = sync.Pop();
  ASSERT_TRUE(frame && frame->lines);
  EXPECT_EQ(frame->imu.front().t_ns, 0);
  EXPECT_EQ(sync.statistics().frames, 3);
  EXPECT_EQ(sync.statistics().imu_out_of_order, 0);
}

}  // namespace
}  // namespace plm_vins
