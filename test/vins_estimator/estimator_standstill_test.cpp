// SPDX-License-Identifier: BSD-3-Clause
// The estimator where the vehicle rests, or seems to.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "test/vins_estimator/estimated_flight.h"
#include "test/vins_estimator/planned_flight.h"

namespace plm_vins {
namespace {

using testing::EstimatedFlight;
using testing::FlightPlan;
using testing::GentleFlight;

EstimatedFlight Fly(const FlightPlan& plan) {
  return testing::Estimate(testing::PlannedFlight(plan).Simulate());
}

// Returns the error of the last position, aligned at the image `duration` [s] before it [m].
double ErrorOver(double duration, const EstimatedFlight& flight) {
  const auto images = static_cast<size_t>(duration / 0.05);
  const size_t last = flight.outputs.size() - 1, first = last - images;
  const Rigid3d T = testing::AlignHeading(flight.outputs[first].state, flight.truth[first]);
  return (T * Eigen::Vector3d(flight.outputs[last].state.position()) -
          flight.truth[last].position())
      .norm();
}

// Too slow for the IMU, and within a pixel in half a second for the camera.
TEST(EstimatorStandstill, SlowFlightIsNotStandstill) {
  for (const double v : {0.02, 0.05}) {
    FlightPlan plan;
    plan.duration = 40;
    plan.room = {40, 40, 20};
    plan.T_W_V = [v](double t) {
      Rigid3d T_W_V = GentleFlight(t, 2, 12);
      const double s = std::max(0.0, t - 14);  // it creeps from then on
      T_W_V.translation += Eigen::Vector3d(0, v * (s - std::tanh(s)), 8);
      return T_W_V;
    };
    EXPECT_LT(ErrorOver(26, Fly(plan)), 0.05) << v;
  }
}

// After half a minute on the ground points with known depths are still there.
TEST(EstimatorStandstill, MapSurvivesAStandstill) {
  FlightPlan plan;
  plan.duration = 42;
  plan.T_W_V = [](double t) { return GentleFlight(t, 2, 12); };
  const EstimatedFlight flight = Fly(plan);
  EXPECT_TRUE(flight.outputs.back().stationary);
  EXPECT_GT(flight.outputs.back().counts.known_seen, 50);
}

// Leaves an image without points; those after it have others, as of a tracker that lost all.
void Blank(size_t first, size_t last, testing::SimulatedFlight* flight) {
  for (size_t i = first; i < flight->frames.size(); ++i) {
    auto& points = flight->frames[i].points.points;
    if (i <= last) points.clear();
    for (PointObservation& point : points) point.id += 100'000;
  }
}

// The estimate of a flight from 2 to `landing` s and of the standstill after it.
FlightPlan FlightWithRest(double landing, double duration) {
  FlightPlan plan;
  plan.duration = duration;
  plan.T_W_V = [landing](double t) { return GentleFlight(t, 2, landing); };
  return plan;
}

void ExpectHeld(const EstimatedFlight& flight, double limit, double duration) {
  EXPECT_TRUE(flight.restarts.empty()) << flight.restarts.front();
  EXPECT_LT(ErrorOver(duration, flight), limit);
}

TEST(EstimatorStandstill, BlankImagesDoNotEndStandstill) {
  for (const double landing : {2.0, 10.0}) {
    const auto flight = testing::PlannedFlight(FlightWithRest(landing, 32)).Simulate();
    auto now_and_then = flight, covered = flight;
    for (size_t i = 240; i < 620; i += 10) Blank(i, i, &now_and_then);
    Blank(260, 600, &covered);
    ExpectHeld(testing::Estimate(now_and_then), 0.02, 20);
    ExpectHeld(testing::Estimate(covered), 0.02, 20);
  }
}

// The keyframe before the end of a rest is up to ten seconds old.
TEST(EstimatorStandstill, TakeOffBeginsAtTheStandstillPosition) {
  FlightPlan plan;
  plan.duration = 14;
  plan.T_W_V = [](double t) { return GentleFlight(t, 12, 40); };
  auto flight = testing::PlannedFlight(plan).Simulate();
  Blank(238, 250, &flight);  // dead reckoning at the take-off
  const EstimatedFlight estimated = testing::Estimate(flight);
  EXPECT_TRUE(estimated.restarts.empty());
  ASSERT_GT(estimated.outputs.size(), 200u);
  EXPECT_LT(testing::GreatestError(estimated, 100), 0.05);
}

// Images of a flight from `begin` on with the IMU of a body at standstill: a train fills the view.
testing::SimulatedFlight MovingScene(double begin) {
  auto flight = testing::PlannedFlight(FlightWithRest(2, 20)).Simulate();
  FlightPlan plan;
  plan.duration = 20;
  plan.T_W_V = [begin](double t) { return GentleFlight(t, begin, 18); };
  const auto scene = testing::PlannedFlight(plan).Simulate();
  for (size_t i = 0; i < flight.frames.size(); ++i)
    flight.frames[i].points = scene.frames[i].points;
  return flight;
}

TEST(EstimatorStandstill, MovingSceneDoesNotMoveTheEstimate) {
  ExpectHeld(testing::Estimate(MovingScene(8)), 0.02, 15);
}

TEST(EstimatorStandstill, SceneThatMovesFromTheStartIsNoMotionOfTheBody) {
  for (const double begin : {-3.0, 0.0, 1.0}) {
    auto flight = MovingScene(begin);
    flight.frames.resize(240);
    Estimator estimator(testing::ConfigFor(flight));
    for (const EstimatorOutput& output : testing::Estimate(flight, &estimator).outputs) {
      const double deviation =
          std::sqrt(testing::PoseCovariance(output).diagonal().head<3>().maxCoeff());
      EXPECT_LT(output.state.position().norm(), std::max(0.02, 3 * deviation))
          << begin << " s, at " << ToSeconds(output.t_ns - flight.frames[0].t_ns);
    }
    EXPECT_TRUE(estimator.SeesUnfeltMotion()) << begin;
  }
}

// Distance of a body whose velocity rises from 0 to 1 m/s between two times [m].
double Accelerated(double t, double begin, double end) {
  const double u = std::clamp((t - begin) / (end - begin), 0.0, 1.0);
  return (end - begin) * u * u * u * u * (2.5 + u * (-3 + u)) + std::max(0.0, t - end);
}

// Images of a body at standstill from `landing` on, with the IMU of a lift that moves 4 s later.
testing::SimulatedFlight Lift(double landing, double acceleration, double duration) {
  auto flight = testing::PlannedFlight(FlightWithRest(landing, landing + 20)).Simulate();
  FlightPlan plan;
  plan.duration = landing + 20;
  plan.T_W_V = [=](double t) {
    Rigid3d T_W_V = GentleFlight(t, 2, landing);
    const double begin = landing + 4, end = landing + 12;
    const double v = acceleration * duration / 1.875;
    T_W_V.translation.z() +=
        v * (Accelerated(t, begin, begin + duration) - Accelerated(t, end, end + duration));
    return T_W_V;
  };
  const auto lift = testing::PlannedFlight(plan).Simulate();
  for (size_t i = 0; i < flight.frames.size(); ++i) flight.frames[i].imu = lift.frames[i].imu;
  return flight;
}

TEST(EstimatorStandstill, LiftDoesNotMoveTheEstimate) {
  for (const double landing : {2.0, 10.0}) {  // without and with known depths
    for (const double acceleration : {0.6, 1.5}) {
      const auto flight = Lift(landing, acceleration, 2.5);
      Estimator estimator(testing::ConfigFor(flight));
      const EstimatedFlight estimated = testing::Estimate(flight, &estimator);
      EXPECT_TRUE(estimated.restarts.empty()) << estimated.restarts.front();
      EXPECT_TRUE(estimator.ViewMovesAlong());
      EXPECT_LT(testing::GreatestError(estimated, estimated.outputs.size() - 330),
                acceleration < 1 ? 0.007 : 0.05)
          << acceleration << " m/s^2 after " << landing << " s";
    }
  }
}

// Its corners rest at first while the IMU feels the motion.
TEST(EstimatorStandstill, TakeOffBeforeAFarSceneIsNoLift) {
  FlightPlan plan;
  plan.duration = 10;
  plan.room = {160, 160, 80};
  plan.T_W_V = [](double t) {
    Rigid3d T_W_V = GentleFlight(t, 6, 14);
    T_W_V.translation.z() += 20 + Accelerated(t, 3, 4) - Accelerated(t, 6, 7);
    return T_W_V;
  };
  const auto flight = testing::PlannedFlight(plan).Simulate();
  EXPECT_LT(testing::GreatestError(testing::Estimate(flight), 20), 0.2);
}

}  // namespace
}  // namespace plm_vins
