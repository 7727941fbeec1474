// SPDX-License-Identifier: BSD-3-Clause
#include "linefeature_tracker/following/line_occupancy.h"

#include <gtest/gtest.h>

namespace plm_vins {
namespace {

TEST(LineOccupancyTest, DistinguishesDuplicatesFromNeighbors) {
  LineOccupancy occupied(5);
  EXPECT_FALSE(occupied.IsTaken({{0, 0}, {100, 0}}));
  occupied.Add({{0, 0}, {100, 0}});
  EXPECT_TRUE(occupied.IsTaken({{0, 2}, {100, 1}}));
  EXPECT_TRUE(occupied.IsTaken({{90, 2}, {10, 4}}));      // the other way round
  EXPECT_TRUE(occupied.IsTaken({{40, 0}, {60, 0}}));      // a part of it
  EXPECT_FALSE(occupied.IsTaken({{0, 6}, {100, 6}}));     // parallel
  EXPECT_FALSE(occupied.IsTaken({{50, -50}, {50, 50}}));  // crossing
  EXPECT_FALSE(occupied.IsTaken({{105, 0}, {200, 0}}));   // beyond its end
  EXPECT_FALSE(occupied.IsTaken({{90, 0}, {200, 0}}));    // hardly beside it
}

}  // namespace
}  // namespace plm_vins
