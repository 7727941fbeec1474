// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/input/line_pairing.h"

#include <gtest/gtest.h>

#include "test/vins_estimator/input/sync_input.h"

namespace plm_vins {
namespace {

// The tests of MeasurementSync show the other rules.

using testing::kMs;
using testing::Lines;

constexpr int kMaxLag = 3, kPatience = 10;
constexpr double kMaxStall = 0.4;  // [s]

LinePairing Pairing() {
  return LinePairing({/*expected=*/true, kMaxLag, kMaxStall, kPatience, /*max_frames=*/200});
}

void Add(LinePairing* pairing, int64_t t_ms, bool image_waits = false) {
  pairing->Add(Lines(t_ms * kMs), image_waits);
}

bool Take(LinePairing* pairing, int64_t t_ms, const LinePairing::NewerImages& newer = {}) {
  const auto lines = pairing->Take(t_ms * kMs, newer);
  if (lines) {
    EXPECT_EQ(lines->t_ns, t_ms * kMs);
  }
  return lines.has_value();
}

// Adds images without lines until lines count as missing. The last image is at 10 ms.
LinePairing Missing() {
  LinePairing pairing = Pairing();
  for (int i = 1; i <= kPatience; ++i) {
    EXPECT_FALSE(pairing.are_missing());
    Take(&pairing, i);
  }
  EXPECT_TRUE(pairing.are_missing());
  return pairing;
}

TEST(LinePairing, AStallOfTheTransportDelaysImagesWhoseLinesWereInTimeBefore) {
  LinePairing pairing = Pairing();
  Add(&pairing, 50);
  EXPECT_TRUE(Take(&pairing, 50));
  EXPECT_FALSE(pairing.AreDecided(100 * kMs, {7, 0.35}));
  EXPECT_TRUE(pairing.AreDecided(100 * kMs, {9, 0.45}));
  for (int i = 0; i < kPatience; ++i) {
    EXPECT_FALSE(pairing.AreDecided((100 + i) * kMs, {7, 0.35})) << i;
    Add(&pairing, 100 + i);
    EXPECT_TRUE(Take(&pairing, 100 + i, {7, 0.35}));
  }
  EXPECT_TRUE(pairing.AreDecided(200 * kMs, {kMaxLag, 0.15})) << "a tracker that is too slow";
  Add(&pairing, 200);
  EXPECT_TRUE(Take(&pairing, 200, {kMaxLag - 1, 0.1}));
  EXPECT_FALSE(pairing.AreDecided(250 * kMs, {7, 0.35}));
  EXPECT_FALSE(Take(&pairing, 250, {9, 0.45}));
  EXPECT_TRUE(pairing.AreDecided(300 * kMs, {kMaxLag, 0.15})) << "a tracker that has stopped";
}

TEST(LinePairing, UsesTheLinesOfTheImageAndDropsEarlierOnes) {
  LinePairing pairing = Pairing();
  for (const int64_t t : {10, 20, 30, 50}) Add(&pairing, t);
  EXPECT_TRUE(Take(&pairing, 30));
  EXPECT_EQ(pairing.statistics().lines_without_points, 2);
  EXPECT_FALSE(Take(&pairing, 40));
  EXPECT_EQ(pairing.statistics().frames_without_lines, 1);
  EXPECT_TRUE(Take(&pairing, 50));
  EXPECT_EQ(pairing.statistics().lines_without_points, 2);
}

TEST(LinePairing, MissingLinesEndWithThoseOfAWaitingImage) {
  LinePairing late = Missing();
  Add(&late, 7);  // later than the lag
  EXPECT_TRUE(late.are_missing());
  Add(&late, 8);
  EXPECT_FALSE(late.are_missing());

  LinePairing early = Missing();
  Add(&early, 11, /*image_waits=*/false);
  EXPECT_TRUE(early.are_missing());
  Add(&early, 12, /*image_waits=*/true);
  EXPECT_FALSE(early.are_missing());
}

TEST(LinePairing, ClearForgetsTimeNotThatLinesAreMissing) {
  LinePairing pairing = Missing();
  Add(&pairing, 20);
  pairing.Clear();
  EXPECT_TRUE(pairing.are_missing());
  Add(&pairing, 5);
  EXPECT_EQ(pairing.statistics().lines_out_of_order, 0);
  EXPECT_EQ(pairing.statistics().lines_late, 0);
  EXPECT_TRUE(Take(&pairing, 5));
  EXPECT_EQ(pairing.statistics().frames_without_lines, kPatience);
}

}  // namespace
}  // namespace plm_vins
