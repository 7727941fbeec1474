// SPDX-License-Identifier: BSD-3-Clause
#include "common/streams/stamp_order.h"

#include <gtest/gtest.h>

#include <vector>

namespace plm_vins {
namespace {

// Returns the index of the timestamp at which the stream restarts; -1 if it does not.
int FindJump(BackwardJumpDetector* detector, const std::vector<int64_t>& refused) {
  for (size_t i = 0; i < refused.size(); ++i) {
    if (detector->Reject(refused[i])) return static_cast<int>(i);
  }
  return -1;
}

TEST(BackwardJumpDetector, DetectsARestartedStream) {
  BackwardJumpDetector detector(3);
  EXPECT_EQ(FindJump(&detector, {10, 20, 30, 40}), 3);
}

TEST(BackwardJumpDetector, RejectsStampsUntilTheyIncreaseAgain) {
  BackwardJumpDetector detector(3);
  EXPECT_FALSE(detector.HasRejected());
  detector.Reject(10);
  EXPECT_TRUE(detector.HasRejected());
  detector.Accept();
  EXPECT_FALSE(detector.HasRejected());
}

TEST(BackwardJumpDetector, AcceptedStampsShowThatTheOldStreamContinues) {
  BackwardJumpDetector detector(3);
  EXPECT_EQ(FindJump(&detector, {10, 20, 30}), -1);
  detector.Accept();
  EXPECT_EQ(FindJump(&detector, {40, 50, 60}), -1);
}

// Rejects `count` timestamps, ten apart, and returns the result for the one accepted after them.
bool EndsStepBack(int64_t begin, int count, int64_t accepted) {
  BackwardJumpDetector detector(1000);
  for (int i = 0; i < count; ++i) EXPECT_FALSE(detector.Reject(begin + 10 * i));
  return detector.EndsStepBack(accepted);
}

TEST(BackwardJumpDetector, DetectsASmallStepBack) {
  EXPECT_TRUE(EndsStepBack(1007, 20, 1207));
  EXPECT_TRUE(EndsStepBack(1007, 20, 1247)) << "some got lost";
  EXPECT_TRUE(EndsStepBack(-3, 10, 97));
}

TEST(BackwardJumpDetector, IgnoresStragglers) {
  EXPECT_FALSE(EndsStepBack(1007, 9, 1097)) << "too few";
  EXPECT_FALSE(EndsStepBack(1000, 20, 1400)) << "those that overtook them are in between";
  BackwardJumpDetector detector(1000);
  EXPECT_FALSE(detector.EndsStepBack(0));
  for (int i = 0; i < 50; ++i) EXPECT_FALSE(detector.Reject(1000 - 10 * (i % 5)));
  EXPECT_FALSE(detector.EndsStepBack(1010)) << "not one after the other";
  for (int i = 0; i < 20; ++i) detector.Reject(2000 + 10 * i);
  detector.Accept();
  EXPECT_FALSE(detector.EndsStepBack(2200)) << "over";
}

TEST(BackwardJumpDetector, IgnoresAStoppedClock) {
  BackwardJumpDetector detector(3);
  EXPECT_EQ(FindJump(&detector, {50, 50, 50, 50, 50, 50}), -1);
  EXPECT_EQ(FindJump(&detector, {60, 50, 60, 50, 60, 50}), -1);
}

using Stamps = std::vector<int64_t>;

// Returns the accepted timestamps, where more than 10 from one to the next is a jump and three
// rejected ones are a restart.
Stamps Accepted(const Stamps& stamps) {
  StampOrder order({2, 10});
  Stamps accepted;
  for (const int64_t t : stamps) {
    if (StampOrder::IsAccepted(order.Add(t))) accepted.push_back(t);
  }
  return accepted;
}

TEST(StampOrder, RejectsSingleStampsInTheFuture) {
  EXPECT_EQ(Accepted({0, 900, 10, 900, 20, 800, 30}), (Stamps{0, 10, 20, 30}));
}

TEST(StampOrder, AGapCostsOneStamp) {
  EXPECT_EQ(Accepted({0, 100, 105, 110}), (Stamps{0, 105, 110}));
}

TEST(StampOrder, StreamOfLeapsContinues) {
  EXPECT_EQ(Accepted({0, 20, 40, 60, 80}), (Stamps{0, 40, 80}));
}

TEST(StampOrder, LeapIsNotConfirmedByAStepBack) {
  EXPECT_EQ(Accepted({0, 900, 800, 10}), (Stamps{0, 10}));
}

TEST(StampOrder, RejectsStampsThatDoNotIncrease) {
  EXPECT_EQ(Accepted({100, 100, 99, 101}), (Stamps{100, 101}));
}

TEST(StampOrder, RestartsAfterItsPatience) {
  EXPECT_EQ(Accepted({100, 20, 21, 22, 23}), (Stamps{100, 22, 23}));
}

TEST(StampOrder, TellsWhy) {
  StampOrder order({1, 10});
  EXPECT_FALSE(order.newest_ns());
  EXPECT_EQ(order.Add(100), StampVerdict::kFollows);
  EXPECT_EQ(order.Add(200), StampVerdict::kIsAhead);
  EXPECT_EQ(order.Add(201), StampVerdict::kFollowsGap);
  EXPECT_EQ(order.Add(50), StampVerdict::kIsBack);
  EXPECT_EQ(order.newest_ns(), 201);
  EXPECT_EQ(order.Add(51), StampVerdict::kRestarts);
  EXPECT_EQ(order.newest_ns(), 51);
  order.Clear();
  EXPECT_EQ(order.Add(10), StampVerdict::kFollows);
}

}  // namespace

}  // namespace plm_vins
