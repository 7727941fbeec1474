// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/marginalization/window_estimate.h"

#include <gtest/gtest.h>

#include "test/vins_estimator/simulated_window.h"
#include "vins_estimator/problem/initial_prior.h"
#include "vins_estimator/problem/problem_builder.h"

namespace plm_vins {
namespace {

// Six keyframes, the oldest of which has become an anchor.
class WindowEstimateTest : public ::testing::Test {
 protected:
  WindowEstimateTest() : estimate_(testing::SimulateWindow(7)) {
    estimate_.prior = InitialPrior(InitialUncertainty(), options_, estimate_.map.window);
    anchor_ns_ = estimate_.map.window.frames.front().state.t_ns;
    estimate_.SlideOldest(options_, /*stays_as_anchor=*/true);
  }

  // Expects that every variable of the prior is in the map; otherwise the problem cannot be built.
  void ExpectInStep() {
    ProblemBuilder builder(options_, &estimate_.map.window, &estimate_.prior);
    EXPECT_NO_THROW(builder.AddPrior());
  }

  bool PriorHoldsPoseOf(int64_t t_ns) const {
    return estimate_.prior.Linearization({BlockKind::kPose, t_ns}) != nullptr;
  }

  const ProblemOptions options_ = testing::OnePixelOptions();
  WindowEstimate estimate_;
  int64_t anchor_ns_ = 0;
};

TEST_F(WindowEstimateTest, RemovedAnchorLeavesMapAndPrior) {
  estimate_.RemoveAnchor(anchor_ns_);
  EXPECT_FALSE(PriorHoldsPoseOf(anchor_ns_));
  EXPECT_TRUE(estimate_.map.window.anchors.empty());
  ExpectInStep();
}

TEST_F(WindowEstimateTest, DroppedFrameLeavesMapAndPrior) {
  const int64_t next_ns = estimate_.map.window.frames[1].state.t_ns;
  ASSERT_TRUE(PriorHoldsPoseOf(next_ns));
  while (estimate_.map.window.frames.size() > 2) estimate_.DropSecondNewest();
  EXPECT_FALSE(PriorHoldsPoseOf(next_ns));
  ExpectInStep();
}

TEST_F(WindowEstimateTest, OldestFrameIsMarginalizedIntoThePrior) {
  const int64_t oldest_ns = estimate_.map.window.frames.front().state.t_ns;
  estimate_.SlideOldest(options_, /*stays_as_anchor=*/false);
  EXPECT_FALSE(PriorHoldsPoseOf(oldest_ns));
  EXPECT_THROW(estimate_.map.window.StateAt(oldest_ns), std::logic_error);
  EXPECT_TRUE(PriorHoldsPoseOf(estimate_.map.window.frames.front().state.t_ns));
  ExpectInStep();
}

}  // namespace
}  // namespace plm_vins
