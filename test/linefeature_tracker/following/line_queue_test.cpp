// SPDX-License-Identifier: BSD-3-Clause
#include "linefeature_tracker/following/line_queue.h"

#include <gtest/gtest.h>

namespace plm_vins {
namespace {

const cv::Size kSize(400, 300);

LineSegment Level(double x, double y) { return {{x - 20, y}, {x + 20, y}}; }
LineSegment Upright(double x, double y) { return {{x, y - 20}, {x, y + 20}}; }

TEST(LineQueueTest, TakesTheBestOfEachRegionFirst) {
  LineQueue queue(kSize);
  queue.AddCandidate(Level(40, 50), 0);
  queue.AddCandidate(Level(50, 60), 1);
  queue.AddCandidate(Level(350, 250), 2);
  queue.CountLine(Level(45, 55));
  EXPECT_EQ(queue.Pop(), 2U);
  EXPECT_EQ(queue.Pop(), 0U);
  EXPECT_EQ(queue.Pop(), 1U);
  EXPECT_EQ(queue.Pop(), std::nullopt);
}

TEST(LineQueueTest, SpreadsOverDirections) {
  LineQueue queue(kSize);
  queue.AddCandidate(Level(40, 50), 0);
  queue.AddCandidate(Upright(40, 50), 1);
  queue.CountLine(Level(45, 55).Reversed());
  EXPECT_EQ(queue.Pop(), 1U);
}

TEST(LineQueueTest, LinesAroundAnAxisHaveOneDirection) {
  LineQueue queue(kSize);
  queue.AddCandidate({{20, 51}, {60, 49}}, 0);
  queue.AddCandidate(Upright(40, 50), 1);
  queue.CountLine({{20, 49}, {60, 51}});
  EXPECT_EQ(queue.Pop(), 1U);
}

TEST(LineQueueTest, TakesLinesBeyondTheImage) {
  LineQueue queue(kSize);
  queue.AddCandidate(Level(-30, -10), 0);
  queue.AddCandidate(Level(500, 400), 1);
  EXPECT_TRUE(queue.Pop());
  EXPECT_TRUE(queue.Pop());
}

}  // namespace
}  // namespace plm_vins
