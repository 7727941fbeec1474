// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/lengths/stated_lengths.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "test/vins_estimator/estimated_flight.h"

namespace plm_vins {
namespace {

using ::testing::HasSubstr;

TEST(StatedLengths, KnowTheUnitsOfDepthImages) {
  EXPECT_THAT(ProbableDepthUnit(10, 0.01, 0.001), HasSubstr("0.1 mm? depth_unit: 0.0001"));
  EXPECT_THAT(ProbableDepthUnit(5.1, 0.01, 0.001), HasSubstr("1/5000 m? depth_unit: 0.0002"));
  EXPECT_THAT(ProbableDepthUnit(4, 0.01, 0.001), HasSubstr("depth_unit: 0.00025"));
  EXPECT_THAT(ProbableDepthUnit(1000, 0.01, 0.001), HasSubstr("32FC1 images in mm"));
  EXPECT_THAT(ProbableDepthUnit(3.28, 0.01, 0.001), HasSubstr("feet"));
  EXPECT_THAT(ProbableDepthUnit(0.1, 0.01, 0.0001), HasSubstr("mm? depth_unit: 0.001"));
  EXPECT_THAT(ProbableDepthUnit(1.88, 0.01, 0.001), HasSubstr("disparity instead of depth"));
  EXPECT_EQ(ProbableDepthUnit(1.1, 0.01, 0.001), "");
}

testing::SimulatedFlight FlyWithDepth(double factor) {
  auto options = testing::FlightOptions(simulator::Motion::kFast, 1);
  options.sensors.depth.emplace();
  auto flight = testing::SimulateFlight(options);
  for (FrameMeasurement& frame : flight.frames) {
    for (PointObservation& point : frame.points.points) {
      if (point.depth) *point.depth *= factor;
    }
  }
  return flight;
}

bool HasDepth(const FrameMeasurement& measurement) {
  const auto& points = measurement.points.points;
  return std::any_of(points.begin(), points.end(),
                     [](const PointObservation& point) { return point.depth.has_value(); });
}

TEST(StatedLengths, LeaveOutDepthsOfAnotherUnit) {
  const auto flight = FlyWithDepth(0.5);
  const Config config = testing::ConfigFor(flight);
  StatedLengths lengths(config);
  bool is_wrong = false;
  size_t images = 0;
  while (!is_wrong) {
    ASSERT_LT(images, flight.frames.size());
    EXPECT_TRUE(HasDepth(lengths.Usable(flight.frames[images])));
    is_wrong = lengths.Add(flight.frames[images++]);
  }
  EXPECT_EQ(lengths.images().size(), images - 1) << "all before, from which to repeat";
  EXPECT_FALSE(HasDepth(lengths.Usable(flight.frames[images])));
  EXPECT_FALSE(lengths.Usable(config).sensor.depth);
  EXPECT_THAT(lengths.Finding(), HasSubstr("depths are "));
  EXPECT_THAT(lengths.Finding(), HasSubstr(" times too short"));
  EXPECT_GT(lengths.Contradiction(), 5);
}

// At first, their unit may be wrong instead.
TEST(StatedLengths, LeaveOutDepthsThatAreNotAligned) {
  const auto flight = FlyWithDepth(1);
  const Config config = testing::ConfigFor(flight);
  StatedLengths lengths(config);
  EstimatorReport report;
  report.depth.misalignment = {6, 0.5};
  size_t i = 0;
  while (!lengths.Add(flight.frames[i], report) && i < 80) ++i;
  EXPECT_GT(i, 5);
  EXPECT_LT(i, 65);
  EXPECT_EQ(lengths.images().size(), i) << "all before, from which to repeat";
  EXPECT_FALSE(lengths.Add(flight.frames[i + 1], report)) << "no news";
  EXPECT_FALSE(HasDepth(lengths.Usable(flight.frames[i + 1])));
  EXPECT_FALSE(lengths.Usable(config).sensor.depth);
  EXPECT_THAT(lengths.Finding(), HasSubstr("not aligned to camera 0, by at least 6 px"));
  EXPECT_DOUBLE_EQ(lengths.Contradiction(), 12);
  EXPECT_EQ(lengths.Doubt(), 0) << "no length is used";
}

TEST(StatedLengths, NameTheUnitOfDepthsThatSeemUnaligned) {
  const auto flight = FlyWithDepth(0.1);
  StatedLengths lengths(testing::ConfigFor(flight));
  EstimatorReport report;
  report.depth.misalignment = {6, 0.5};
  for (size_t i = 0; i < 80; ++i) lengths.Add(flight.frames[i], report);
  EXPECT_THAT(lengths.Finding(), HasSubstr("times too short (unit cm?"));
}

TEST(StatedLengths, NameABaselineThatOnlyTheEstimatorKnows) {
  auto options = testing::FlightOptions(simulator::Motion::kHover, 1);
  options.sensors.cameras = simulator::DefaultStereoSensors().cameras;
  const auto flight = testing::SimulateFlight(options);
  StatedLengths lengths(testing::ConfigFor(flight));
  EstimatorReport report;
  report.cameras = {{1, std::nullopt, std::nullopt, LengthEvidence{-0.2, 0.02}}};
  EXPECT_TRUE(lengths.Add(flight.frames[0], report));
  EXPECT_THAT(lengths.Finding(), HasSubstr("baseline of cameras 0 and 1 is not the configured"));
  EXPECT_THAT(lengths.Finding(), HasSubstr("which are too long, unless its rotation or a "));
  EXPECT_THAT(lengths.Finding(), HasSubstr("camera 1 is not used"));
}

TEST(StatedLengths, AreDoubtedWhereTheyAreUsed) {
  auto flight = FlyWithDepth(1);
  StatedLengths lengths(testing::ConfigFor(flight));
  lengths.Add(flight.frames[0]);
  EXPECT_GT(lengths.Doubt(), 0);
  for (size_t i = 1; i < 80; ++i) {
    for (PointObservation& point : flight.frames[i].points.points) point.depth.reset();
    lengths.Add(flight.frames[i]);
  }
  EXPECT_EQ(lengths.Doubt(), 0);
}

TEST(StatedLengths, LeaveOutDepthsBeyondTheLargest) {
  auto flight = FlyWithDepth(1);
  flight.sensor.depth->max = 2;
  StatedLengths lengths(testing::ConfigFor(flight));
  for (const PointObservation& point : lengths.Usable(flight.frames[0]).points.points) {
    EXPECT_LE(point.depth.value_or(0), 2);
  }
}

}  // namespace
}  // namespace plm_vins
