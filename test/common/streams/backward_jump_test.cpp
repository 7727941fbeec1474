// SPDX-License-Identifier: BSD-3-Clause
#include "common/streams/backward_jump.h"

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

}  // namespace
}  // namespace plm_vins
