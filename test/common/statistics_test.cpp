// SPDX-License-Identifier: BSD-3-Clause
#include "common/statistics.h"

#include <gtest/gtest.h>

namespace plm_vins {
namespace {

TEST(Median, IsTheMiddleValue) {
  EXPECT_EQ(Median({}), 0);
  EXPECT_EQ(Median({4}), 4);
  EXPECT_EQ(Median({9, 1, 5}), 5);
  EXPECT_EQ(Median({7, 3}), 7);
  EXPECT_EQ(Median({8, 2, 6, 4}), 6);
}

}  // namespace
}  // namespace plm_vins
