// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/map/line_landmark.h"

#include <gtest/gtest.h>

namespace plm_vins {
namespace {

LineLandmark::Observation Seen(int64_t t_ns, double length, int camera = 0) {
  return {{t_ns, camera}, {{0, 0}, {length, 0}}};
}

std::vector<int64_t> Stamps(const std::vector<LineLandmark::Observation>& observations) {
  std::vector<int64_t> stamps;
  stamps.reserve(observations.size());
  for (const LineLandmark::Observation& o : observations) stamps.push_back(o.t_ns);
  return stamps;
}

TEST(AddAnchorObservation, KeepsTheFirstAndTheNewestByTime) {
  std::vector<LineLandmark::Observation> observations;
  for (const int64_t t : {30, 10, 20, 50, 40}) AddAnchorObservation(Seen(t, 1), &observations);
  EXPECT_EQ(Stamps(observations), (std::vector<int64_t>{10, 30, 40, 50}));
}

// Two parts of a merged line may have observations in one image.
TEST(AddAnchorObservation, OfOneImageKeepsTheLongerSegment) {
  std::vector<LineLandmark::Observation> observations = {Seen(10, 0.3)};
  AddAnchorObservation(Seen(10, 0.5), &observations);
  AddAnchorObservation(Seen(10, 0.4), &observations);
  AddAnchorObservation(Seen(10, 0.1, /*camera=*/1), &observations);
  ASSERT_EQ(Stamps(observations), (std::vector<int64_t>{10, 10}));
  EXPECT_EQ(observations[0].Length(), 0.5);
}

}  // namespace
}  // namespace plm_vins
