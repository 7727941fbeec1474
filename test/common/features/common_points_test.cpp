// SPDX-License-Identifier: BSD-3-Clause
#include "common/features/common_points.h"

#include <gtest/gtest.h>

namespace plm_vins {
namespace {

PointFrame Frame(const std::vector<int64_t>& ids) {
  PointFrame frame;
  for (const int64_t id : ids) {
    PointObservation point;
    point.id = id;
    frame.points.push_back(point);
  }
  return frame;
}

TEST(CommonPoints, HaveTheOrderOfTheSecondImage) {
  const PointFrame first = Frame({1, 2, 3, 4}), second = Frame({9, 4, 2});
  const std::vector<CommonPoint> common = CommonPoints(first, second);
  ASSERT_EQ(common.size(), 2u);
  EXPECT_EQ(common[0].first, &first.points[3]);
  EXPECT_EQ(common[0].second, &second.points[1]);
  EXPECT_EQ(common[1].first, &first.points[1]);
  EXPECT_EQ(common[1].second, &second.points[2]);
}

TEST(CommonPoints, AreNoneWithAnEmptyImage) {
  EXPECT_TRUE(CommonPoints(Frame({}), Frame({1})).empty());
  EXPECT_TRUE(CommonPoints(Frame({1}), Frame({})).empty());
}

}  // namespace
}  // namespace plm_vins
