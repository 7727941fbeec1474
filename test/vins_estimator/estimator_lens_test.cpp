// SPDX-License-Identifier: BSD-3-Clause
// A distortion model that does not fit the lens is noticed in flight; one that fits is not.
#include <gtest/gtest.h>

#include "test/vins_estimator/estimated_flight.h"
#include "vins_estimator/map/recalibration.h"

namespace plm_vins {
namespace {

using simulator::Motion;
using testing::SimulatedFlight;

// The lens of EuRoC's left camera, and the radial-tangential model that comes with the dataset.
CameraParameters EquidistantLens() {
  CameraParameters camera = simulator::DefaultSensors().cameras[0].parameters;
  camera.model = CameraParameters::Model::kPinholeEquidistant;
  camera.fx = 460.02;
  camera.fy = 458.63;
  camera.cx = 365.51;
  camera.cy = 249.26;
  camera.distortion = {-0.00107256, 0.02314686, -0.03762009, 0.02288249};
  return camera;
}

CameraParameters Fisheye() {
  CameraParameters camera = EquidistantLens();
  camera.width = camera.height = 512;
  camera.fx = camera.fy = 191;
  camera.cx = 255;
  camera.cy = 257;
  camera.distortion = {0.0034, 0.0007, -0.0020, 0.0002};
  return camera;
}

simulator::FeatureSimulationOptions Options(const CameraParameters& lens, Motion motion) {
  auto options = testing::FlightOptions(motion, 1);
  options.trajectory.duration = 25;
  options.max_points = 80;
  options.sensors.cameras[0].parameters = lens;
  return options;
}

// Returns the warning after a flight; `believed` is the configured camera.
std::string WarningAfter(const simulator::FeatureSimulationOptions& options,
                         const CameraParameters& believed, bool refine) {
  SimulatedFlight flight = testing::WithoutLines(testing::SimulateFlight(options));
  const Recalibration recalibration(flight.sensor.cameras[0].parameters, believed);
  for (FrameMeasurement& frame : flight.frames) recalibration.Move(0, &frame);
  flight.sensor.cameras[0].parameters = believed;
  flight.sensor.estimate_intrinsics = refine;
  Estimator estimator(testing::ConfigFor(flight));
  testing::Estimate(flight, &estimator);
  return estimator.lenses()[0].warning();
}

TEST(EstimatorLensTest, WrongModelIsReported) {
  const CameraParameters radtan = simulator::DefaultSensors().cameras[0].parameters;
  for (const bool refine : {false, true}) {
    const std::string warning =
        WarningAfter(Options(EquidistantLens(), Motion::kFast), radtan, refine);
    EXPECT_NE(warning.find("recalibrate with an equidistant (fisheye) model"), std::string::npos)
        << warning << refine;
  }
}

TEST(EstimatorLensTest, CorrectModelIsNotReported) {
  const CameraParameters radtan = simulator::DefaultSensors().cameras[0].parameters;
  EXPECT_EQ(WarningAfter(Options(radtan, Motion::kFast), radtan, false), "");
  for (const CameraParameters& lens : {radtan, EquidistantLens(), Fisheye()}) {
    EXPECT_EQ(WarningAfter(Options(lens, Motion::kFast), lens, true), "");
  }
  EXPECT_EQ(WarningAfter(Options(radtan, Motion::kCorridor), radtan, true), "");
  EXPECT_EQ(WarningAfter(Options(radtan, Motion::kGentle), radtan, true), "");
}

TEST(EstimatorLensTest, UnconfiguredRollingShutterIsNoLensError) {
  auto options = Options(EquidistantLens(), Motion::kFast);
  options.sensors.rolling_shutter = true;
  options.sensors.rolling_shutter_tr = 0.02;
  SimulatedFlight flight = testing::WithoutLines(testing::SimulateFlight(options));
  flight.sensor.rolling_shutter = false;
  Estimator estimator(testing::ConfigFor(flight));
  testing::Estimate(flight, &estimator);
  EXPECT_EQ(estimator.lenses()[0].warning(), "");
}

}  // namespace
}  // namespace plm_vins
