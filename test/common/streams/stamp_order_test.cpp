// SPDX-License-Identifier: BSD-3-Clause
#include "common/streams/stamp_order.h"

#include <gtest/gtest.h>

#include <vector>

namespace plm_vins {
namespace {

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

TEST(StampOrder, AcceptsSteps) { EXPECT_EQ(Accepted({0, 10, 20}), (Stamps{0, 10, 20})); }

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
