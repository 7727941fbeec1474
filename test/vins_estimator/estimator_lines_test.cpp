// SPDX-License-Identifier: BSD-3-Clause
// Lines that are missing, interrupted or wrong do not degrade the estimate.
#include <gtest/gtest.h>

#include <algorithm>
#include <utility>

#include "test/vins_estimator/estimated_flight.h"
#include "vins_estimator/estimator.h"

namespace plm_vins {
namespace {

using simulator::Motion;
using testing::EstimatedFlight;
using testing::PoseCovariance;
using testing::SimulatedFlight;
using testing::WithoutLines;

constexpr size_t kFewPointsFrom = 60;  // image from which points are few: after three seconds

SimulatedFlight Simulate(Motion motion, uint64_t seed, double duration = 12) {
  auto options = testing::FlightOptions(motion, seed);
  options.trajectory.duration = duration;
  options.max_points = 80;
  options.max_lines = 50;
  return testing::SimulateFlight(options);
}

// Keeps only the oldest `count` point tracks of every image after the start.
void LeaveFewPoints(size_t count, SimulatedFlight* flight) {
  for (size_t i = kFewPointsFrom; i < flight->frames.size(); ++i) {
    auto& points = flight->frames[i].points.points;
    points.resize(std::min(points.size(), count));
  }
}

// Swaps the ids of lines in every image, one pair in 2 * `every` lines.
void MixUpLines(size_t every, SimulatedFlight* flight) {
  for (size_t i = 0; i < flight->frames.size(); ++i) {
    auto& lines = flight->frames[i].lines->lines;
    for (size_t k = i % (2 * every); k + 1 < lines.size(); k += 2 * every) {
      std::swap(lines[k].id, lines[k + 1].id);
    }
  }
}

double MeanLinesInWindow(const EstimatedFlight& flight) {
  double sum = 0;
  for (const EstimatorOutput& output : flight.outputs) sum += output.counts.lines_in_window;
  return sum / static_cast<double>(flight.outputs.size());
}

// Mean error of several flights relative to their paths, with and without lines.
struct Comparison {
  double with_lines = 0, without_lines = 0;
};

Comparison Compare(Motion motion, size_t points, void (*disturb)(SimulatedFlight*)) {
  constexpr uint64_t kSeeds = 3;
  Comparison mean;
  for (uint64_t seed = 1; seed <= kSeeds; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    SimulatedFlight simulated = Simulate(motion, seed);
    LeaveFewPoints(points, &simulated);
    disturb(&simulated);
    const EstimatedFlight with = testing::Estimate(simulated);
    const EstimatedFlight without = testing::Estimate(WithoutLines(simulated));
    EXPECT_TRUE(with.restarts.empty());
    EXPECT_EQ(with.outputs.size(), without.outputs.size());
    EXPECT_GT(MeanLinesInWindow(with), 10);
    EXPECT_EQ(MeanLinesInWindow(without), 0);
    const double error = testing::AbsoluteError(with) / with.path;
    EXPECT_LT(error, 0.01);  // never diverges
    mean.with_lines += error / kSeeds;
    mean.without_lines += testing::AbsoluteError(without) / without.path / kSeeds;
  }
  return mean;
}

TEST(EstimatorWithLines, OutlierLinesDoNoHarm) {
  const auto mix_up = [](SimulatedFlight* flight) { MixUpLines(20, flight); };
  const Comparison mean = Compare(Motion::kGentle, 12, mix_up);
  EXPECT_LT(mean.with_lines, 1.05 * mean.without_lines);
}

TEST(EstimatorWithLines, EmptyLineFramesEqualNoLineFrontEnd) {
  SimulatedFlight empty = Simulate(Motion::kFast, 1, 8);
  for (FrameMeasurement& frame : empty.frames) frame.lines->lines.clear();
  const EstimatedFlight a = testing::Estimate(empty), b = testing::Estimate(WithoutLines(empty));
  ASSERT_GT(a.outputs.size(), 100u);
  ASSERT_EQ(a.outputs.size(), b.outputs.size());
  for (size_t i = 0; i < a.outputs.size(); ++i) {
    ASSERT_EQ(a.outputs[i].state.pose, b.outputs[i].state.pose) << i;
    ASSERT_EQ(a.outputs[i].state.motion, b.outputs[i].state.motion) << i;
    ASSERT_EQ(PoseCovariance(a.outputs[i]), PoseCovariance(b.outputs[i])) << i;
  }
}

TEST(EstimatorWithLines, LineFrontEndMayFailAndRecover) {
  SimulatedFlight simulated = Simulate(Motion::kFast, 1);
  LeaveFewPoints(12, &simulated);
  for (size_t i = 100; i < 160; ++i) simulated.frames[i].lines.reset();
  const EstimatedFlight flight = testing::Estimate(simulated);
  EXPECT_TRUE(flight.restarts.empty());
  EXPECT_LT(testing::AbsoluteError(flight), 0.01 * flight.path);
  const auto lines_at = [&](size_t image) {
    const size_t skipped = simulated.frames.size() - flight.outputs.size();
    return flight.outputs[image - skipped].counts.lines_in_window;
  };
  EXPECT_GT(lines_at(99), 5);
  EXPECT_EQ(lines_at(159), 0);
  EXPECT_GT(lines_at(200), 5);
}

}  // namespace
}  // namespace plm_vins
