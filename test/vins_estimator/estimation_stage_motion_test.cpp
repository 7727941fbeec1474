// SPDX-License-Identifier: BSD-3-Clause
// Reports of the estimation stage about motion and rotations that contradict the IMU.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>
#include <string>
#include <vector>

#include "test/vins_estimator/estimated_flight.h"
#include "test/vins_estimator/planned_flight.h"
#include "vins_estimator/estimation_stage.h"

namespace plm_vins {
namespace {

using ::testing::Each;
using ::testing::StartsWith;

struct Reports {
  std::set<std::string> input;
  int poses = 0;
};

Reports ReportsOf(const testing::SimulatedFlight& flight, const Config& config) {
  EstimationStage stage(config);
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
  const testing::SimulatedFlight flight = testing::PlannedFlight(plan).Simulate();
  const Reports reports = ReportsOf(flight, testing::ConfigFor(flight));
  EXPECT_EQ(reports.poses, 0);
  ASSERT_FALSE(reports.input.empty());
  EXPECT_THAT(reports.input, Each(StartsWith("constant speed: scale not observable yet")));
}

// A second camera at the place of the first one, whose transform alone is stated inversely.
TEST(EstimationStageMotion, NamesOnlyTheTransformThatIsInverted) {
  testing::SimulatedFlight flight = testing::PlannedFlight(testing::GentlePlan(16)).Simulate();
  for (FrameMeasurement& frame : flight.frames) {
    const std::vector<PointObservation> first = frame.points.points;
    for (PointObservation point : first) {
      point.camera = 1;
      point.id += 1'000'000;
      frame.points.points.push_back(point);
    }
  }
  Config config = testing::ConfigFor(flight);
  config.use_lines = false;
  std::vector<CameraSensor>& cameras = config.sensor.cameras;
  cameras.push_back(cameras.front());
  cameras.back().T_B_C = cameras.front().T_B_C.Inverse();
  const Reports reports = ReportsOf(flight, config);
  ASSERT_FALSE(reports.input.empty());
  EXPECT_THAT(reports.input, Each(StartsWith("body_T_cam1 is wrong by ")));
}

}  // namespace
}  // namespace plm_vins
