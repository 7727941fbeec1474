// SPDX-License-Identifier: BSD-3-Clause
// Reports of the estimation stage about motion that only the camera shows.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>
#include <string>

#include "test/vins_estimator/estimated_flight.h"
#include "test/vins_estimator/planned_flight.h"
#include "vins_estimator/estimation_stage.h"

namespace plm_vins {
namespace {

using ::testing::StartsWith;

struct Reports {
  std::set<std::string> input;
  int poses = 0;
};

Reports ReportsOf(const testing::SimulatedFlight& flight) {
  EstimationStage stage(testing::ConfigFor(flight));
  Reports reports;
  for (size_t i = 0; i < flight.frames.size(); ++i) {
    const FrameMeasurement& frame = flight.frames[i];
    for (size_t k = i > 0 ? 1 : 0; k < frame.imu.size(); ++k) stage.AddImu(frame.imu[k]);
    stage.AddPoints(frame.points);
    while (const auto estimate = stage.Pop()) {
      reports.poses += estimate->output.has_pose ? 1 : 0;
      reports.input.insert(stage.InputFinding().text);
    }
  }
  reports.input.erase("");
  return reports;
}

TEST(EstimationStageMotion, NamesConstantSpeedFirst) {
  testing::FlightPlan plan;
  plan.duration = 6;
  plan.T_W_V = [](double t) {
    return Rigid3d(Eigen::Quaterniond::Identity(), {0, 0.3 * t - 1, 1.5});
  };
  const Reports reports = ReportsOf(testing::PlannedFlight(plan).Simulate());
  EXPECT_EQ(reports.poses, 0);
  ASSERT_FALSE(reports.input.empty());
  for (const std::string& text : reports.input) {
    EXPECT_THAT(text, StartsWith("constant speed: scale not observable yet"));
  }
}

}  // namespace
}  // namespace plm_vins
