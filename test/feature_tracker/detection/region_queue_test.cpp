// SPDX-License-Identifier: BSD-3-Clause
#include "feature_tracker/detection/region_queue.h"

#include <gtest/gtest.h>

namespace plm_vins {
namespace {

// Four regions of 100 x 100 px.
RegionQueue FourRegions() { return {{199, 199}, 4}; }

TEST(RegionQueue, ServesThePoorestRegionFirst) {
  RegionQueue queue = FourRegions();
  queue.AddCandidate({10, 10});  // better, but its region has points already
  queue.AddCandidate({150, 150});
  queue.CountPoint({50, 50});
  EXPECT_EQ(queue.Pop(), cv::Point2f(150, 150));
  EXPECT_EQ(queue.Pop(), cv::Point2f(10, 10));
  EXPECT_FALSE(queue.Pop());
}

TEST(RegionQueue, KeepsTheOrderWithinARegion) {
  RegionQueue queue = FourRegions();
  queue.AddCandidate({30, 10});
  queue.AddCandidate({10, 10});
  EXPECT_EQ(queue.Pop(), cv::Point2f(30, 10));
  EXPECT_EQ(queue.Pop(), cv::Point2f(10, 10));
}

TEST(RegionQueue, TakesTurnsAsPointsAreCounted) {
  RegionQueue queue = FourRegions();
  for (const float x : {10.F, 30.F, 150.F, 170.F}) queue.AddCandidate({x, 10});
  std::vector<float> order;
  while (const auto point = queue.Pop()) {
    queue.CountPoint(*point);
    order.push_back(point->x);
  }
  EXPECT_EQ(order, (std::vector<float>{10, 150, 30, 170}));
}

}  // namespace
}  // namespace plm_vins
