// SPDX-License-Identifier: BSD-3-Clause
#include "common/streams/forward_jump.h"

#include <gtest/gtest.h>

#include <vector>

namespace plm_vins {
namespace {

// Returns the accepted timestamps, where more than 10 from one to the next is a jump.
std::vector<int64_t> Accepted(const std::vector<int64_t>& stamps) {
  ForwardJumpDetector detector(10);
  std::vector<int64_t> accepted = {stamps.front()};
  for (size_t i = 1; i < stamps.size(); ++i) {
    if (detector.Accept(accepted.back(), stamps[i])) accepted.push_back(stamps[i]);
  }
  return accepted;
}

using Stamps = std::vector<int64_t>;

TEST(ForwardJump, AcceptsSteps) { EXPECT_EQ(Accepted({0, 10, 20}), (Stamps{0, 10, 20})); }

TEST(ForwardJump, RejectsSingleStampsInTheFuture) {
  EXPECT_EQ(Accepted({0, 900, 10, 900, 20, 800, 30}), (Stamps{0, 10, 20, 30}));
}

TEST(ForwardJump, AGapCostsOneStamp) {
  EXPECT_EQ(Accepted({0, 100, 105, 110}), (Stamps{0, 105, 110}));
}

TEST(ForwardJump, StreamOfLeapsContinues) {
  EXPECT_EQ(Accepted({0, 20, 40, 60, 80}), (Stamps{0, 40, 80}));
}

TEST(ForwardJump, LeapIsNotConfirmedByAStepBack) {
  EXPECT_EQ(Accepted({0, 900, 800, 10}), (Stamps{0, 10}));
}

}  // namespace
}  // namespace plm_vins
