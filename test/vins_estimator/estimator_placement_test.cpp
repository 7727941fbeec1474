// SPDX-License-Identifier: BSD-3-Clause
// Images between keyframes, for which the window is not optimized again.
#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "test/vins_estimator/estimated_flight.h"
#include "vins_estimator/estimator_options.h"
#include "vins_estimator/initialization/initializer.h"
#include "vins_estimator/window_odometry.h"

namespace plm_vins {
namespace {

using testing::EstimatedFlight;

// Returns whether only the second newest of the common frames has changed.
bool WasPlaced(const EstimatorOutput& before, const EstimatorOutput& output) {
  const auto in_output = [&](const FrameState& state) {
    return std::find_if(output.window.begin(), output.window.end(),
                        [&](const FrameState& other) { return other.t_ns == state.t_ns; });
  };
  return std::all_of(before.window.begin(), before.window.end() - 1, [&](const FrameState& state) {
    const auto same = in_output(state);
    return same == output.window.end() || same->pose == state.pose;
  });
}

struct Images {
  int count = 0;
  double squared_error = 0, pose = 0, velocity = 0;  // sums
};

class EstimatorPlacement : public ::testing::Test {
 protected:
  // Adds the second half of gentle flights to the statistics of placed and of optimized images.
  void Fly(int flights, double duration, double outlier_ratio) {
    for (int seed = 1; seed <= flights; ++seed) {
      auto options = testing::FlightOptions(simulator::Motion::kGentle, seed);
      options.trajectory.duration = duration;
      options.max_points = 80;
      options.point_outlier_ratio = outlier_ratio;
      Add(testing::Estimate(testing::SimulateFlight(options)));
    }
  }

  Images placed_, solved_;

 private:
  void Add(const EstimatedFlight& flight) {
    const Rigid3d T = testing::AlignHeading(flight.anchor, flight.true_anchor);
    for (size_t i = flight.outputs.size() / 2; i < flight.outputs.size(); ++i) {
      const EstimatorOutput& output = flight.outputs[i];
      Images* images = WasPlaced(flight.outputs[i - 1], output) ? &placed_ : &solved_;
      const Eigen::Vector3d p = T * Eigen::Vector3d(output.state.position());
      const auto consistency = testing::MeasureConsistencyAt(flight, i);
      ++images->count;
      images->squared_error += (p - flight.truth[i].position()).squaredNorm();
      images->pose += consistency.pose;
      images->velocity += consistency.velocity;
    }
  }
};

TEST_F(EstimatorPlacement, EqualsTheWindowSolution) {
  Fly(/*flights=*/6, /*duration=*/15, /*outlier_ratio=*/0);
  EXPECT_GT(placed_.count, 2 * solved_.count);
  const auto ratio = [&](double Images::*sum) {
    return (placed_.*sum / placed_.count) / (solved_.*sum / solved_.count);
  };
  EXPECT_NEAR(ratio(&Images::squared_error), 1, 0.2);
  EXPECT_NEAR(ratio(&Images::pose), 1, 0.2);
  EXPECT_NEAR(ratio(&Images::velocity), 1, 0.3);
}

// A fifth of the points is wrong: too many for placement.
TEST_F(EstimatorPlacement, IsNotUsedIfPointsContradict) {
  Fly(/*flights=*/1, /*duration=*/8, /*outlier_ratio=*/0.2);
  EXPECT_LT(placed_.count, 0.1 * solved_.count);
}

// The tracker restarts in mid-flight: no known point constrains a state.
TEST_F(EstimatorPlacement, IsNotUsedIfAllPointsAreNew) {
  testing::SimulatedFlight flight =
      testing::SimulateFlight(testing::FlightOptions(simulator::Motion::kGentle, 1));
  const size_t begin = flight.frames.size() / 2;
  for (size_t i = begin; i < flight.frames.size(); ++i) {
    for (PointObservation& point : flight.frames[i].points.points) point.id += 1'000'000;
    flight.frames[i].lines.reset();
  }
  const EstimatedFlight estimated = testing::Estimate(flight);
  size_t i = estimated.outputs.size() - (flight.frames.size() - begin);
  for (int keyframes = 0; keyframes < 2; ++i) {
    ASSERT_LT(i, estimated.outputs.size());
    keyframes += estimated.outputs[i].keyframe ? 1 : 0;
    EXPECT_FALSE(keyframes < 2 && WasPlaced(estimated.outputs[i - 1], estimated.outputs[i])) << i;
  }
}

TEST_F(EstimatorPlacement, IsNotUsedAtStandstill) {
  const EstimatedFlight flight = testing::Estimate(
      testing::SimulateFlight(testing::FlightOptions(simulator::Motion::kStill, 1)));
  ASSERT_GT(flight.outputs.size(), 100u);
  for (size_t i = flight.outputs.size() / 2; i < flight.outputs.size(); ++i) {
    const EstimatorOutput& output = flight.outputs[i];
    EXPECT_FALSE(output.stationary && WasPlaced(flight.outputs[i - 1], output)) << i;
  }
  EXPECT_TRUE(flight.outputs.back().stationary);
}

// Few points may determine the velocity badly; most points then contradict it.
TEST(EstimatorPlacementOfStart, IsRefusedIfItContradictsTheInitialStates) {
  const auto flight =
      testing::SimulateFlight(testing::FlightOptions(simulator::Motion::kGentle, 1), /*skip=*/3);
  const Config config = testing::ConfigFor(flight);
  const EstimatorOptions options(config);
  Initializer initializer(config);
  std::optional<InitializationResult> result;
  for (size_t i = 0; !result && i < flight.frames.size(); ++i) {
    result = initializer.Add(flight.frames[i]);
  }
  ASSERT_TRUE(result);
  for (const double speed : {0.0, 0.6}) {
    for (InitialFrame& frame : result->frames) {
      const double t = ToSeconds(frame.state.t_ns - result->frames.front().state.t_ns);
      frame.state.position().z() += speed * t;
      frame.state.velocity().z() += speed;
    }
    WindowOdometry odometry(config, options);
    EXPECT_EQ(odometry.Start(*result, UncertaintyOf(config.sensor, false)).has_value(), speed == 0);
  }
}

}  // namespace
}  // namespace plm_vins
