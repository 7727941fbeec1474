// SPDX-License-Identifier: BSD-3-Clause
#include "tracking/pairing_queue.h"

#include <gtest/gtest.h>

#include "common/measurements.h"

namespace plm_vins {
namespace {

constexpr int64_t kMilli = 1'000'000;

ImageSample At(int64_t milliseconds) { return {milliseconds * kMilli, {}}; }

class PairingQueueTest : public ::testing::Test {
 protected:
  bool IsAwaited(int64_t milliseconds) const { return queue_.IsAwaited(milliseconds * kMilli); }
  // The stamp [ms], or -1.
  int64_t Take(int64_t milliseconds) {
    const auto taken = queue_.Take(milliseconds * kMilli);
    return taken ? taken->t_ns / kMilli : -1;
  }

  PairingQueue<ImageSample> queue_;
};

TEST_F(PairingQueueTest, PairsByEqualStampWithinTwoMilliseconds) {
  for (const int64_t t : {100, 148, 203}) queue_.Add(At(t));
  EXPECT_EQ(Take(100), 100);
  EXPECT_EQ(Take(150), 148);
  EXPECT_EQ(Take(200), -1);
  EXPECT_EQ(Take(203), 203);  // what is too early for one image is kept for the next
  EXPECT_EQ(Take(203), -1);
}

TEST_F(PairingQueueTest, DropsWhatIsTooOld) {
  for (const int64_t t : {100, 150, 200}) queue_.Add(At(t));
  EXPECT_EQ(Take(200), 200);
  EXPECT_EQ(Take(100), -1);
}

TEST_F(PairingQueueTest, WaitsForAnActiveSensor) {
  EXPECT_FALSE(IsAwaited(100));  // nothing has come yet
  queue_.Add(At(100));
  EXPECT_FALSE(IsAwaited(100));
  EXPECT_TRUE(IsAwaited(150));
  queue_.Add(At(150));
  EXPECT_FALSE(IsAwaited(150));
  EXPECT_TRUE(IsAwaited(200));
  EXPECT_FALSE(IsAwaited(900));  // it has stopped
}

TEST_F(PairingQueueTest, DoesNotWaitForImagesThatASlowSensorSkips) {
  queue_.Add(At(100));
  queue_.Add(At(300));
  EXPECT_FALSE(IsAwaited(350));
  EXPECT_FALSE(IsAwaited(400));
  EXPECT_TRUE(IsAwaited(500));
}

TEST_F(PairingQueueTest, RestartsIfStampsJumpBack) {
  for (const int64_t t : {1000, 1050}) queue_.Add(At(t));
  for (int64_t t = 0; t <= 500; t += 50) queue_.Add(At(t));
  EXPECT_EQ(Take(500), 500);
  EXPECT_TRUE(IsAwaited(550));
}

// Networks may reorder and repeat messages.
TEST_F(PairingQueueTest, KeepsTheOthersIfOneIsLateOrRepeated) {
  for (const int64_t t : {100, 150, 150, 50, 200}) queue_.Add(At(t));
  EXPECT_EQ(Take(100), 100);
  EXPECT_EQ(Take(150), 150);
  EXPECT_EQ(Take(200), 200);
}

TEST_F(PairingQueueTest, HoldsASecondOfImages) {
  for (int64_t t = 0; t <= 3000; t += 50) queue_.Add(At(t));
  EXPECT_EQ(Take(1950), -1);
  EXPECT_EQ(Take(2000), 2000);
}

}  // namespace
}  // namespace plm_vins
