// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/equations/window_problem.h"

#include <gtest/gtest.h>

#include <stdexcept>

#include "vins_estimator/factors/point_factor.h"
#include "vins_estimator/factors/zero_velocity_factor.h"

namespace plm_vins {
namespace {

TEST(WindowProblem, AddsAVariableOnce) {
  WindowProblem problem;
  double pose[7] = {}, other_pose[7] = {}, motion[9] = {};
  const int first = problem.AddVariable({BlockKind::kPose, 5}, pose, /*constant=*/true, other_pose);
  EXPECT_EQ(problem.AddVariable({BlockKind::kMotion, 5}, motion), first + 1);
  EXPECT_EQ(problem.AddVariable({BlockKind::kPose, 5}, other_pose), first);
  ASSERT_EQ(problem.variables().size(), 2u);
  EXPECT_EQ(problem.variables()[first].values, pose);
  EXPECT_EQ(problem.variables()[first].linearization, other_pose);
  EXPECT_TRUE(problem.variables()[first].constant);
  EXPECT_FALSE(problem.variables()[first + 1].constant);
}

TEST(WindowProblem, FindsVariablesByKindAndKey) {
  WindowProblem problem;
  double values[9] = {};
  const int pose = problem.AddVariable({BlockKind::kPose, 7}, values);
  const int motion = problem.AddVariable({BlockKind::kMotion, 7}, values);
  EXPECT_EQ(problem.Find({BlockKind::kPose, 7}), pose);
  EXPECT_EQ(problem.Find({BlockKind::kMotion, 7}), motion);
  EXPECT_EQ(problem.Find({BlockKind::kPose, 8}), -1);
  EXPECT_EQ(problem.Find({BlockKind::kPoint, 7}), -1);
}

TEST(WindowProblem, KeepsTermsWithTheirLandmark) {
  WindowProblem problem;
  double motion[9] = {}, td = 0, points[2][3] = {};
  const int motion_index = problem.AddVariable({BlockKind::kMotion, 1}, motion);
  const int td_index = problem.AddVariable({BlockKind::kTimeOffset, 0}, &td);
  problem.AddTerm(ZeroVelocityFactor(1.0), nullptr, {motion_index});
  const ChainKind of_host{/*same_frame=*/true, /*same_camera=*/true};
  for (int64_t id : {0, 1}) {
    const int landmark = problem.AddLandmark({BlockKind::kPoint, id}, points[id]);
    EXPECT_EQ(landmark, id);
    const int point = problem.Find({BlockKind::kPoint, id});
    problem.AddLandmarkTerm(landmark, PointFactor(of_host, TimedBearing(), 1.0), nullptr,
                            {td_index, point});
  }
  EXPECT_EQ(problem.terms().size(), 1u);
  ASSERT_EQ(problem.landmarks().size(), 2u);
  const LandmarkTerms& second = problem.landmarks()[1];
  EXPECT_EQ(second.variable, problem.Find({BlockKind::kPoint, 1}));
  ASSERT_EQ(second.terms.size(), 1u);
  EXPECT_EQ(second.terms[0].variable_count, 2);
  EXPECT_EQ(second.terms[0].variables[0], td_index);
  EXPECT_EQ(second.terms[0].variables[1], second.variable);
}

TEST(WindowProblem, RejectsATermWithTooFewVariables) {
  WindowProblem problem;
  double motion[9] = {};
  problem.AddVariable({BlockKind::kMotion, 1}, motion);
  EXPECT_THROW(problem.AddTerm(ZeroVelocityFactor(1.0), nullptr, {}), std::logic_error);
}

}  // namespace
}  // namespace plm_vins
