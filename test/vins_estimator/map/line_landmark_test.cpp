// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/map/line_landmark.h"

#include <gtest/gtest.h>

namespace plm_vins {
namespace {

LineView View(int64_t t_ns, double length) { return {t_ns, {{0, 0}, {length, 0}}}; }

std::vector<int64_t> Stamps(const std::vector<LineView>& views) {
  std::vector<int64_t> stamps;
  stamps.reserve(views.size());
  for (const LineView& view : views) stamps.push_back(view.t_ns);
  return stamps;
}

TEST(AddAnchorView, KeepsTheFirstAndTheNewestByTime) {
  std::vector<LineView> views;
  for (const int64_t t : {30, 10, 20, 50, 40}) AddAnchorView(View(t, 1), &views);
  EXPECT_EQ(Stamps(views), (std::vector<int64_t>{10, 30, 40, 50}));
}

// Two parts of a merged line may have observations by one anchor.
TEST(AddAnchorView, OfOneAnchorKeepsTheLongerSegment) {
  std::vector<LineView> views = {View(10, 0.3)};
  AddAnchorView(View(10, 0.5), &views);
  AddAnchorView(View(10, 0.4), &views);
  ASSERT_EQ(Stamps(views), std::vector<int64_t>{10});
  EXPECT_EQ(Length(views[0]), 0.5);
}

}  // namespace
}  // namespace plm_vins
