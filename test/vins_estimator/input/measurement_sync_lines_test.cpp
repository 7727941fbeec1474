// SPDX-License-Identifier: BSD-3-Clause
// Pairing of lines with points in MeasurementSync.
#include <gtest/gtest.h>

#include <vector>

#include "test/vins_estimator/input/sync_input.h"
#include "vins_estimator/input/measurement_sync.h"

namespace plm_vins {
namespace {

using testing::AddImu;
using testing::kMs;
using testing::Lines;
using testing::Points;
using testing::PopAll;
using testing::Sample;
using testing::WithLines;

TEST(MeasurementSyncLines, PairsLinesByEqualStamp) {
  MeasurementSync sync(WithLines());
  AddImu(&sync, 0, 200);
  sync.AddLines(Lines(50 * kMs));  // before its points
  sync.AddPoints(Points(50 * kMs));
  auto frame = sync.Pop();
  ASSERT_TRUE(frame && frame->lines);
  EXPECT_EQ(frame->lines->t_ns, 50 * kMs);

  sync.AddPoints(Points(100 * kMs));
  EXPECT_FALSE(sync.Pop().has_value());  // waits
  sync.AddLines(Lines(100 * kMs));
  frame = sync.Pop();
  ASSERT_TRUE(frame && frame->lines);
  EXPECT_EQ(frame->lines->lines.size(), 2u);
  EXPECT_EQ(sync.statistics().frames_without_lines, 0);
}

TEST(MeasurementSyncLines, LaterLineFrameMarksAnEarlierOneAsLost) {
  MeasurementSync sync(WithLines());
  AddImu(&sync, 0, 200);
  sync.AddPoints(Points(50 * kMs));
  sync.AddPoints(Points(100 * kMs));
  sync.AddLines(Lines(100 * kMs));
  const auto frames = PopAll(&sync);
  ASSERT_EQ(frames.size(), 2u);
  EXPECT_FALSE(frames[0].lines.has_value());
  EXPECT_TRUE(frames[1].lines.has_value());
  EXPECT_EQ(sync.statistics().frames_without_lines, 1);
}

TEST(MeasurementSyncLines, MissingLinesDelayAtMostTheLag) {
  MeasurementSync sync(WithLines());
  AddImu(&sync, 0, 400);
  for (int64_t t : {50, 100, 150}) sync.AddPoints(Points(t * kMs));
  EXPECT_FALSE(sync.Pop().has_value());
  sync.AddPoints(Points(200 * kMs));  // three images ahead of the first
  const auto frames = PopAll(&sync);
  ASSERT_EQ(frames.size(), 1u);
  EXPECT_FALSE(frames[0].lines.has_value());

  sync.AddLines(Lines(50 * kMs));  // too late
  EXPECT_FALSE(sync.Pop().has_value());
  EXPECT_EQ(sync.statistics().lines_late, 1);
}

// Adds images from `from` to `to` at this interval [ms], with lines `lag` images late (none if
// negative). Returns for each frame how many images ahead the newest image was.
std::vector<int> FeedWithLines(int64_t from, int64_t to, int lag, MeasurementSync* sync,
                               int64_t interval = 50) {
  std::vector<int> delays;
  for (int64_t t = from; t <= to; t += interval) {
    AddImu(sync, t - interval + 5, t);
    sync->AddPoints(Points(t * kMs));
    if (lag >= 0) sync->AddLines(Lines((t - interval * lag) * kMs));
    for (const FrameMeasurement& frame : PopAll(sync)) {
      delays.push_back(static_cast<int>((t * kMs - frame.t_ns) / (interval * kMs)));
    }
  }
  return delays;
}

// The first image waits as in a stall.
TEST(MeasurementSyncLines, StoppedLineTrackerDelaysAtMostThePatience) {
  MeasurementSync sync(WithLines());
  FeedWithLines(50, 1000, 0, &sync);
  EXPECT_EQ(sync.statistics().frames_without_lines, 0);
  const std::vector<int> delays = FeedWithLines(1050, 3000, -1, &sync);
  EXPECT_EQ(delays.front(), 9);
  EXPECT_EQ(delays.back(), 0);
  EXPECT_EQ(std::count(delays.begin(), delays.end(), 3), 4);
  EXPECT_EQ(delays.size(), 40u) << "every image is handed out";
  EXPECT_TRUE(sync.lines_are_missing());
}

TEST(MeasurementSyncLines, StallOfTheTransportLosesNoLines) {
  MeasurementSync sync(WithLines());
  FeedWithLines(50, 1000, 0, &sync);
  AddImu(&sync, 1005, 1400);  // all at once, and the lines at last
  for (int64_t t = 1050; t <= 1400; t += 50) sync.AddPoints(Points(t * kMs));
  EXPECT_TRUE(PopAll(&sync).empty());
  for (int64_t t = 1050; t <= 1400; t += 50) sync.AddLines(Lines(t * kMs));
  EXPECT_EQ(PopAll(&sync).size(), 8u);
  EXPECT_EQ(sync.statistics().frames_without_lines, 0);
  EXPECT_EQ(sync.statistics().frames_too_late, 0);
}

// At 5 Hz, images wait for their lines longer than `max_wait`, but there is nothing newer to use.
TEST(MeasurementSyncLines, ImagesThatWaitForLinesAreNotTooLate) {
  MeasurementSync::Options options = WithLines();
  options.max_wait = 0.5;
  for (const int lag : {-1, 3}) {
    MeasurementSync sync(options);
    const std::vector<int> delays = FeedWithLines(200, 6000, lag, &sync, 200);
    EXPECT_EQ(delays.size(), lag < 0 ? 30u : 27u);
    EXPECT_EQ(delays.front(), 3);
    EXPECT_EQ(delays.back(), lag < 0 ? 0 : 3);
    EXPECT_EQ(sync.lines_are_missing(), lag < 0);
    EXPECT_EQ(sync.statistics().frames_too_late, 0);
  }
}

TEST(MeasurementSyncLines, ImagesAreDroppedUpToThoseThatWaitForLines) {
  MeasurementSync::Options options = WithLines();
  options.max_wait = 0.1;
  MeasurementSync sync(options);
  AddImu(&sync, 0, 1000);
  for (int64_t t = 50; t <= 1000; t += 50) sync.AddPoints(Points(t * kMs));
  const auto frames = PopAll(&sync);
  ASSERT_EQ(frames.size(), 1u);
  EXPECT_EQ(frames[0].t_ns, 850 * kMs);
  EXPECT_EQ(sync.statistics().frames_too_late, 16);
}

TEST(MeasurementSyncLines, ReturningLinesAreUsedAgain) {
  for (const int lag : {0, 1, 2}) {
    MeasurementSync sync(WithLines());
    FeedWithLines(50, 1000, -1, &sync);
    EXPECT_TRUE(sync.lines_are_missing());
    FeedWithLines(1050, 2000, lag, &sync);
    EXPECT_FALSE(sync.lines_are_missing());
    EXPECT_LE(sync.statistics().frames_without_lines, 20 + lag);
  }
}

TEST(MeasurementSyncLines, FarTooSlowLineTrackerDelaysNothing) {
  MeasurementSync sync(WithLines());
  const std::vector<int> delays = FeedWithLines(50, 3000, 6, &sync);
  EXPECT_EQ(delays.back(), 0);
  EXPECT_TRUE(sync.lines_are_missing());
  EXPECT_FALSE(sync.lines_are_of_other_images());
  EXPECT_GT(sync.statistics().lines_late, 40);
}

// Two trackers that use every second image, but not the same ones.
TEST(MeasurementSyncLines, LinesOfOtherImagesAreMissingForGood) {
  MeasurementSync sync(WithLines());
  AddImu(&sync, 0, 6000);
  size_t frames = 0;
  int changes = 0;
  bool missing = false;
  for (int64_t t = 100; t <= 5000; t += 50) {
    if (t % 100 == 0) {
      sync.AddPoints(Points(t * kMs));
    } else {
      sync.AddLines(Lines(t * kMs));
    }
    frames += testing::PopAll(&sync).size();
    if (sync.lines_are_missing() != missing) ++changes;
    missing = sync.lines_are_missing();
  }
  EXPECT_EQ(frames, 50u);
  EXPECT_EQ(changes, 1);
  EXPECT_TRUE(sync.lines_are_of_other_images());
}

// The line tracker does not know which images the point tracker uses.
TEST(MeasurementSyncLines, LinesOfEveryImagePairWithPointsOfSome) {
  for (const int64_t phase : {0, 50}) {
    MeasurementSync sync(WithLines());
    AddImu(&sync, 0, 3000);
    for (int64_t t = 100; t <= 2000; t += 50) {
      sync.AddLines(Lines(t * kMs));
      if (t % 100 == phase) sync.AddPoints(Points(t * kMs));
      for (const FrameMeasurement& frame : testing::PopAll(&sync)) EXPECT_TRUE(frame.lines);
    }
    EXPECT_EQ(sync.statistics().frames_without_lines, 0);
    EXPECT_FALSE(sync.lines_are_missing());
  }
}

TEST(MeasurementSyncLines, LinesOfAnEarlierRecordingDoNotBlockThoseOfThisOne) {
  MeasurementSync sync(WithLines());
  sync.AddLines(Lines(90000 * kMs));  // left over from before the restart
  FeedWithLines(50, 1000, 0, &sync);
  EXPECT_EQ(sync.statistics().frames_without_lines, 0);
  EXPECT_EQ(sync.statistics().lines_out_of_order, 1);
}

TEST(MeasurementSyncLines, LinesWithoutPointsAndOutOfOrderAreCounted) {
  MeasurementSync sync(WithLines());
  AddImu(&sync, 0, 200);
  sync.AddLines(Lines(25 * kMs));  // its points never arrive
  sync.AddLines(Lines(50 * kMs));
  sync.AddLines(Lines(50 * kMs));
  sync.AddPoints(Points(50 * kMs));
  const auto frame = sync.Pop();
  ASSERT_TRUE(frame && frame->lines);
  EXPECT_EQ(sync.statistics().lines_without_points, 1);
  EXPECT_EQ(sync.statistics().lines_out_of_order, 1);
}

}  // namespace
}  // namespace plm_vins
