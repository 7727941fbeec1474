// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/problem/window_variables.h"

#include <gtest/gtest.h>

#include <memory>
#include <stdexcept>

#include "test/vins_estimator/simulated_window.h"

namespace plm_vins {
namespace {

class WindowVariablesTest : public ::testing::Test {
 protected:
  WindowVariablesTest() : simulated_(testing::SimulateWindow(3)) {}

  SlidingWindow& window() { return simulated_.window; }
  FrameState& State(size_t frame) { return window().frames[frame].state; }
  const Variable& At(int index) const { return problem_.variables()[static_cast<size_t>(index)]; }

  testing::SimulatedWindow simulated_;
  WindowProblem problem_;
};

bool Nothing(const BlockId& /*id*/) { return false; }

TEST_F(WindowVariablesTest, EachIsAddedOnceWithItsValues) {
  WindowVariables variables(&window(), Nothing, nullptr, &problem_);
  for (int i = 0; i < 2; ++i) {
    EXPECT_EQ(At(variables.Pose(State(1).t_ns)).values, State(1).pose.data());
    EXPECT_EQ(At(variables.Motion(State(1).t_ns)).values, State(1).motion.data());
    EXPECT_EQ(At(variables.Extrinsics(0)).values, window().cameras[0].extrinsics.data());
    EXPECT_EQ(At(variables.TimeOffset()).values, &window().td);
    EXPECT_EQ(At(variables.Intrinsics(0)).values, window().cameras[0].intrinsics.data());
    EXPECT_EQ(problem_.variables().size(), 5u);
  }
}

TEST_F(WindowVariablesTest, LandmarksAreNot) {
  WindowVariables variables(&window(), Nothing, nullptr, &problem_);
  EXPECT_THROW(variables.Add({BlockKind::kPoint, 1}), std::logic_error);
  EXPECT_THROW(variables.Add({BlockKind::kLine, 1}), std::logic_error);
}

}  // namespace
}  // namespace plm_vins
