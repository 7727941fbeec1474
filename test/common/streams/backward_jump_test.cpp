// SPDX-License-Identifier: BSD-3-Clause
#include "common/streams/backward_jump.h"

#include <gtest/gtest.h>

#include <vector>

namespace plm_vins {
namespace {

// Index of the stamp with which the stream begins anew; -1: it does not.
int FindJump(BackwardJumpDetector* detector, const std::vector<int64_t>& refused) {
  for (size_t i = 0; i < refused.size(); ++i) {
    if (detector->Refuse(refused[i])) return static_cast<int>(i);
  }
  return -1;
}

TEST(BackwardJumpDetector, FindsAStreamThatBeginsAnew) {
  BackwardJumpDetector detector(3);
  EXPECT_EQ(FindJump(&detector, {10, 20, 30, 40}), 3);
}

TEST(BackwardJumpDetector, TakesAcceptedStampsAsASignThatTheOldStreamGoesOn) {
  BackwardJumpDetector detector(3);
  EXPECT_EQ(FindJump(&detector, {10, 20, 30}), -1);
  detector.Accept();
  EXPECT_EQ(FindJump(&detector, {40, 50, 60}), -1);
}

TEST(BackwardJumpDetector, DoesNotTakeAClockThatStandsStillForANewStream) {
  BackwardJumpDetector detector(3);
  EXPECT_EQ(FindJump(&detector, {50, 50, 50, 50, 50, 50}), -1);
  EXPECT_EQ(FindJump(&detector, {60, 50, 60, 50, 60, 50}), -1);
}

}  // namespace
}  // namespace plm_vins
