// SPDX-License-Identifier: BSD-3-Clause
#include "feature_tracker/detection/spacing_grid.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace plm_vins {
namespace {

TEST(SpacingGrid, AgreesWithComparingAllPairs) {
  const cv::Size size(321, 203);
  constexpr double kDistance = 17.5;
  cv::RNG random(7);
  SpacingGrid grid(size, kDistance);
  std::vector<cv::Point2f> points;
  int refused = 0;
  for (int i = 0; i < 2000; ++i) {
    const cv::Point2f point(random.uniform(0.F, size.width - 1.F),
                            random.uniform(0.F, size.height - 1.F));
    const bool is_free = std::none_of(points.begin(), points.end(), [&](const cv::Point2f& other) {
      return cv::norm(other - point) < kDistance;
    });
    EXPECT_EQ(grid.IsFree(point), is_free);
    if (is_free) {
      grid.Add(point);
      points.push_back(point);
    } else {
      ++refused;
    }
  }
  EXPECT_GT(points.size(), 50U);
  EXPECT_GT(refused, 1000);
}

TEST(SpacingGrid, TakesPointsAtTheImagesEdges) {
  SpacingGrid grid({100, 60}, 10);
  grid.Add({0, 0});
  grid.Add({99, 59});
  EXPECT_FALSE(grid.IsFree({9.9F, 0}));
  EXPECT_TRUE(grid.IsFree({10.1F, 0}));
  EXPECT_FALSE(grid.IsFree({99, 50}));
}

}  // namespace
}  // namespace plm_vins
