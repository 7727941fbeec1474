// SPDX-License-Identifier: BSD-3-Clause
#include "offline/recordings/recording_interval.h"

#include <gtest/gtest.h>

namespace plm_vins {
namespace {

using Part = RecordingInterval::Part;

constexpr int64_t kFirstImage = 1403636579763555584;

RecordingEvent Event(RecordingEvent::Kind kind, double seconds) {
  return {kind, kFirstImage + ToNanoseconds(seconds), {}};
}
RecordingEvent Image(double seconds) { return Event(RecordingEvent::Kind::kImage, seconds); }
RecordingEvent Imu(double seconds) { return Event(RecordingEvent::Kind::kImu, seconds); }

TEST(RecordingInterval, IncludesEverythingByDefault) {
  RecordingInterval interval;
  EXPECT_EQ(interval.Locate(Imu(-5)), Part::kUse);
  EXPECT_EQ(interval.Locate(Image(0)), Part::kUse);
  EXPECT_EQ(interval.Locate(Image(1e6)), Part::kUse);
}

TEST(RecordingInterval, CountsFromTheFirstImage) {
  RecordingInterval interval(2, 3);
  EXPECT_EQ(interval.Locate(Imu(-5)), Part::kSkip);
  EXPECT_EQ(interval.Locate(Image(0)), Part::kSkip);
  EXPECT_EQ(interval.Locate(Image(1.95)), Part::kSkip);
  EXPECT_EQ(interval.Locate(Image(2)), Part::kUse);
  EXPECT_EQ(interval.Locate(Image(5)), Part::kUse);
  EXPECT_EQ(interval.Locate(Image(5.05)), Part::kSkip);
}

TEST(RecordingInterval, IncludesImuSamplesAroundTheImages) {
  RecordingInterval interval(2, 3);
  interval.Locate(Image(0));
  EXPECT_EQ(interval.Locate(Imu(1.7)), Part::kSkip);
  EXPECT_EQ(interval.Locate(Imu(1.9)), Part::kUse);
  EXPECT_EQ(interval.Locate(Imu(5.1)), Part::kUse);
  EXPECT_EQ(interval.Locate(Imu(5.3)), Part::kSkip);
  EXPECT_EQ(interval.Locate(Image(5.3)), Part::kSkip);
  EXPECT_EQ(interval.Locate(Image(5.35)), Part::kEnd);
}

TEST(RecordingInterval, IncludesDataAfterABackwardJump) {
  RecordingInterval interval;
  interval.Locate(Image(0));
  EXPECT_EQ(interval.Locate(Image(-100)), Part::kUse);
  EXPECT_EQ(interval.Locate(Imu(-100)), Part::kUse);
}

TEST(RecordingInterval, AnImuSampleFromTheFutureDoesNotEndIt) {
  RecordingInterval interval(0, 3);
  interval.Locate(Image(0));
  interval.Locate(Image(0.05));
  EXPECT_EQ(interval.Locate(Imu(1000)), Part::kSkip);
  EXPECT_EQ(interval.Locate(Imu(0.1)), Part::kUse);
}

TEST(RecordingInterval, AnImageFromTheFutureDoesNotEndIt) {
  RecordingInterval interval(0, 3);
  interval.Locate(Image(0));
  interval.Locate(Image(0.05));
  for (const double t : {0.1, 0.2}) {
    EXPECT_EQ(interval.Locate(Image(1000)), Part::kSkip);
    EXPECT_EQ(interval.Locate(Image(t)), Part::kUse);
  }
}

// IMU samples may be recorded later than images of the same time.
TEST(RecordingInterval, WaitsForTheImuWhereImagesAreRecordedBeforeIt) {
  RecordingInterval interval(0, 3);
  for (const double t : {0.0, 0.05, 3.0}) EXPECT_EQ(interval.Locate(Image(t)), Part::kUse);
  for (const double lead : {0.3, 0.5, 1.5, 2.0}) {
    EXPECT_EQ(interval.Locate(Image(3 + lead)), Part::kSkip);
    EXPECT_EQ(interval.Locate(Image(3.05 + lead)), Part::kSkip);
    EXPECT_EQ(interval.Locate(Imu(1 + lead)), Part::kUse);
  }
  EXPECT_EQ(interval.Locate(Imu(3.25)), Part::kSkip);
  EXPECT_EQ(interval.Locate(Image(5.1)), Part::kEnd);
}

TEST(RecordingInterval, DoesNotWaitForAnImuThatHasEnded) {
  RecordingInterval interval(0, 3);
  for (const double t : {0.0, 0.05, 3.0}) interval.Locate(Image(t));
  interval.Locate(Imu(1));
  for (const double t : {4.0, 6.0, 7.9}) EXPECT_EQ(interval.Locate(Image(t)), Part::kSkip);
  EXPECT_EQ(interval.Locate(Image(8.1)), Part::kEnd);
}

TEST(RecordingInterval, CountsFromAnImageThatTheNextOneConfirms) {
  for (const double wrong : {-1e9, 1e6}) {
    RecordingInterval all(0, 3);
    EXPECT_EQ(all.Locate(Image(wrong)), Part::kUse);
    for (const double t : {0.0, 0.05, 3.0}) {
      EXPECT_EQ(all.Locate(Imu(t)), Part::kUse);
      EXPECT_EQ(all.Locate(Image(t)), Part::kUse);
    }
    EXPECT_EQ(all.Locate(Image(3.1)), Part::kSkip);

    RecordingInterval later(2, 3);
    for (const double t : {wrong, 0.0, 0.05, 1.5}) {
      EXPECT_EQ(later.Locate(Image(t)), Part::kSkip);
      EXPECT_EQ(later.Locate(Imu(0.01)), Part::kSkip);
    }
    EXPECT_EQ(later.Locate(Image(2)), Part::kUse);
  }
}

}  // namespace
}  // namespace plm_vins
