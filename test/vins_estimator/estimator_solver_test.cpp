// SPDX-License-Identifier: BSD-3-Clause
// The estimator gives the same results with both solvers.
#include <gtest/gtest.h>

#include "test/vins_estimator/estimated_flight.h"
#include "vins_estimator/estimator.h"

namespace plm_vins {
namespace {

using testing::EstimatedFlight;
using testing::PoseCovariance;

EstimatedFlight EstimateWith(SolverType solver, const testing::SimulatedFlight& flight) {
  Config config = testing::ConfigFor(flight);
  config.estimator.solver = solver;
  Estimator estimator(config);
  return testing::Estimate(flight, &estimator);
}

TEST(EstimatorSolver, CeresGivesTheSameTrajectory) {
  auto options = testing::FlightOptions(simulator::Motion::kFast, 1);
  options.max_points = 80;
  options.max_lines = 40;
  const testing::SimulatedFlight flight = testing::SimulateFlight(options);
  const EstimatedFlight ours = EstimateWith(SolverType::kSchur, flight);
  const EstimatedFlight ceres = EstimateWith(SolverType::kCeres, flight);
  ASSERT_GT(ours.outputs.size(), 100u);
  ASSERT_EQ(ceres.outputs.size(), ours.outputs.size());
  EXPECT_NE(ceres.outputs.back().state.pose, ours.outputs.back().state.pose) << "solver not used";
  EXPECT_NEAR(testing::AbsoluteError(ceres), testing::AbsoluteError(ours), 1e-3);
  EXPECT_LT((PoseCovariance(ceres.outputs.back()) - PoseCovariance(ours.outputs.back())).norm(),
            0.05 * PoseCovariance(ours.outputs.back()).norm());
}

}  // namespace
}  // namespace plm_vins
