// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/rotation_calibration/rotation_check.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "common/geometry/so3.h"
#include "test/vins_estimator/initialization/simulated_frames.h"

namespace plm_vins {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

using testing::SimulatedFlight;

SimulatedFlight Fly(uint64_t seed, simulator::Motion motion = simulator::Motion::kGentle) {
  auto options = testing::FlightOptions(motion, seed);
  options.trajectory.duration = 15;
  options.point_outlier_ratio = 0.02;
  return testing::SimulateFlight(options, /*skip=*/4);
}

RotationCheck CheckOf(const SimulatedFlight& flight) {
  RotationCheck check(flight.sensor, 0, 0.5);
  for (const FrameMeasurement& frame : flight.frames) check.Add(frame, /*in_doubt=*/true);
  return check;
}

std::string Check(const SimulatedFlight& flight) { return CheckOf(flight).finding(); }

TEST(RotationCheck, FindsNothingIfAllIsRight) {
  for (uint64_t seed = 1; seed <= 3; ++seed) {
    EXPECT_EQ(Check(Fly(seed)), "");
    EXPECT_EQ(Check(Fly(seed, simulator::Motion::kFast)), "");
  }
}

TEST(RotationCheck, NamesAWrongMounting) {
  for (const Eigen::Vector3d& turn : {Eigen::Vector3d(0, 0, M_PI), Eigen::Vector3d(0, 0, M_PI / 2),
                                      Eigen::Vector3d(M_PI / 2, 0, 0)}) {
    SimulatedFlight flight = Fly(1);
    flight.sensor.cameras[0].T_B_C.rotation =
        flight.sensor.cameras[0].T_B_C.rotation * SO3Exp(turn);
    const std::string finding = Check(flight);
    EXPECT_THAT(finding, StartsWith("extrinsicRotation is wrong by "));
    const double degrees = std::stod(finding.substr(30));
    EXPECT_NEAR(degrees, turn.norm() * 180 / M_PI, 3);
  }
}

// Without translation, which the relative pose of two images would trade for it.
TEST(RotationCheck, NamesAWrongFocalLength) {
  SimulatedFlight flight = Fly(2, simulator::Motion::kPureRotation);
  for (FrameMeasurement& frame : flight.frames) {
    for (PointObservation& point : frame.points.points) point.xy /= 1.06;
  }
  EXPECT_EQ(Check(flight).rfind("the focal length is wrong by about +", 0), 0u) << Check(flight);
  EXPECT_NEAR(CheckOf(flight).error(), 0.06, 0.03);
}

TEST(RotationCheck, NamesTheCameraOfAWrongFocalLength) {
  SimulatedFlight flight = Fly(2, simulator::Motion::kPureRotation);
  flight.sensor.cameras.push_back(flight.sensor.cameras[0]);
  RotationCheck check(flight.sensor, 1, 0.5);
  for (FrameMeasurement& frame : flight.frames) {
    for (PointObservation& point : frame.points.points) {
      point.xy /= 1.06;
      point.camera = 1;
    }
    check.Add(frame, /*in_doubt=*/true);
  }
  EXPECT_THAT(check.finding(), StartsWith("camera 1: the focal length is wrong by about +"));
}

// In translation, too, which a relative pose would trade for the error.
TEST(RotationCheck, NamesTheFocalLengthOfAnotherResolution) {
  for (const double factor : {1.25, 0.8}) {
    SimulatedFlight flight = Fly(2, simulator::Motion::kFast);
    for (FrameMeasurement& frame : flight.frames) {
      for (PointObservation& point : frame.points.points) point.xy /= factor;
    }
    const std::string finding = Check(flight);
    ASSERT_THAT(finding, StartsWith("the focal length is wrong by about "));
    EXPECT_NEAR(std::stod(finding.substr(35)), 100 * (factor - 1), 4) << finding;
  }
}

// It is shifted to the right.
TEST(RotationCheck, NamesAWrongPrincipalPoint) {
  SimulatedFlight flight = Fly(2, simulator::Motion::kFast);
  for (FrameMeasurement& frame : flight.frames) {
    for (PointObservation& point : frame.points.points) point.xy.x() -= 0.05;
  }
  const RotationCheck check = CheckOf(flight);
  ASSERT_THAT(check.finding(), StartsWith("the principal point is wrong by about "));
  EXPECT_NEAR(check.error(), 0.05, 0.02);
}

TEST(RotationCheck, NamesTheInverse) {
  SimulatedFlight flight = Fly(3);
  Eigen::Quaterniond& R_B_C = flight.sensor.cameras[0].T_B_C.rotation;
  R_B_C = Eigen::Quaterniond(R_B_C.conjugate());
  EXPECT_NE(Check(flight).find("its inverse fits"), std::string::npos) << Check(flight);
}

TEST(RotationCheck, NamesACameraUpsideDown) {
  SimulatedFlight flight = Fly(3);
  Eigen::Quaterniond& R_B_C = flight.sensor.cameras[0].T_B_C.rotation;
  R_B_C = R_B_C * SO3Exp(Eigen::Vector3d(0, 0, M_PI));
  EXPECT_NE(Check(flight).find("turned by 180 deg"), std::string::npos) << Check(flight);
}

TEST(RotationCheck, NamesAMirroredImage) {
  for (const int axis : {0, 1}) {
    SimulatedFlight flight = Fly(3);
    for (FrameMeasurement& frame : flight.frames) {
      for (PointObservation& point : frame.points.points) point.xy[axis] *= -1;
    }
    EXPECT_THAT(Check(flight), HasSubstr("the image is mirrored")) << axis;
  }
}

TEST(RotationCheck, NamesAGyroWithLeftHandedAxes) {
  Eigen::Matrix3d swap;
  swap << 0, 1, 0, 1, 0, 0, 0, 0, 1;
  for (const auto& [text, matrix] :
       {std::pair<std::string, Eigen::Matrix3d>{"signs are wrong", -Eigen::Matrix3d::Identity()},
        {"sign of z is wrong", Eigen::Vector3d(1, 1, -1).asDiagonal()},
        {"x and y are swapped", swap}}) {
    SimulatedFlight flight = Fly(3);
    flight.frames.resize(static_cast<size_t>(5 / 0.05));
    for (FrameMeasurement& frame : flight.frames) {
      for (ImuSample& sample : frame.imu) sample.gyro = matrix * sample.gyro;
    }
    EXPECT_THAT(Check(flight), HasSubstr(text)) << Check(flight);
  }
}

SimulatedFlight FlyWithWrongGyro() {
  SimulatedFlight flight = Fly(2, simulator::Motion::kFast);
  for (FrameMeasurement& frame : flight.frames) {
    for (ImuSample& sample : frame.imu)
      sample.gyro = Eigen::Vector3d(1.04, 0.97, 1).cwiseProduct(sample.gyro);
  }
  return flight;
}

TEST(RotationCheck, NamesAGyroWithWrongScales) {
  SimulatedFlight flight = FlyWithWrongGyro();
  EXPECT_THAT(Check(flight), StartsWith("scale or axes of the gyro are wrong by up to "));
  flight.frames.resize(static_cast<size_t>(10 / 0.05));
  EXPECT_THAT(Check(flight), StartsWith("scale or axes of the gyro are wrong by up to "));
}

TEST(RotationCheck, LeavesTheGyroToTheFirstCamera) {
  SimulatedFlight flight = FlyWithWrongGyro();
  flight.sensor.cameras.push_back(flight.sensor.cameras[0]);
  RotationCheck check(flight.sensor, 1, 0.5);
  for (FrameMeasurement& frame : flight.frames) {
    for (PointObservation& point : frame.points.points) point.camera = 1;
    check.Add(frame, /*in_doubt=*/true);
    EXPECT_EQ(check.finding(), "");
  }
}

}  // namespace
}  // namespace plm_vins
