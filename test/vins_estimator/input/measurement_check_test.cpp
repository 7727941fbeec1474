// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/input/measurement_check.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <stdexcept>
#include <string>
#include <utility>

#include "test/testing/message_of.h"
#include "test/testing/still_scene.h"
#include "vins_estimator/estimator.h"

namespace plm_vins {
namespace {

constexpr int64_t kStamp = 7'000'000'000;
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

FrameMeasurement Good() {
  FrameMeasurement measurement;
  measurement.t_ns = measurement.points.t_ns = kStamp;
  measurement.points.points = {{1, {0, 0.5}, {0, 0}, {0, 1}}, {2, {0.5, 0}, {0, 0}, {0, 0}}};
  measurement.lines = LineFrame{kStamp, {{1, {0, 0}, {1, 1}}, {2, {0, 0}, {1, 0}}}};
  measurement.imu = {{kStamp, {0, 0, 0}, {0, 0, 9.81}}};
  return measurement;
}

// The image after Good().
FrameMeasurement Next() {
  FrameMeasurement measurement = Good();
  measurement.t_ns = measurement.points.t_ns = measurement.lines->t_ns = kStamp + 10;
  measurement.imu.push_back(measurement.imu.front());
  measurement.imu.back().t_ns = kStamp + 10;
  return measurement;
}

void ExpectRefused(Estimator* estimator, const FrameMeasurement& measurement,
                   const std::string& words) {
  EXPECT_THAT(testing::MessageOf([&] { estimator->Process(measurement); }),
              ::testing::HasSubstr(words));
}

// Expects that the estimator rejects it with these words, and accepts a valid one afterwards.
void ExpectRefused(const FrameMeasurement& measurement, const std::string& words) {
  Estimator estimator(testing::StillConfig());
  ExpectRefused(&estimator, measurement, words);
  EXPECT_NO_THROW(estimator.Process(Good()));
}

// Expects that the estimator rejects it after a valid one.
void ExpectRefusedNext(const FrameMeasurement& measurement, const std::string& words) {
  Estimator estimator(testing::StillConfig());
  estimator.Process(Good());
  ExpectRefused(&estimator, measurement, words);
  EXPECT_NO_THROW(estimator.Process(Next()));
}

TEST(MeasurementCheck, AcceptsValidMeasurements) {
  EXPECT_NO_THROW(CheckMeasurement(Good(), std::nullopt));
  EXPECT_NO_THROW(CheckMeasurement(Next(), EndOf(Good())));
}

TEST(MeasurementCheck, RejectsNonIncreasingStamps) {
  Estimator estimator(testing::StillConfig());
  estimator.Process(Good());
  EXPECT_THROW(estimator.Process(Good()), std::invalid_argument);
  estimator.Reset();
  EXPECT_NO_THROW(estimator.Process(Good()));
}

TEST(MeasurementCheck, RejectsFeaturesOfAnotherImage) {
  FrameMeasurement measurement = Good();
  measurement.points.t_ns += 1;
  ExpectRefused(measurement, "points have the timestamp 7000000001 ns");
  measurement = Good();
  measurement.lines->t_ns -= 1;
  ExpectRefused(measurement, "lines have the timestamp 6999999999 ns");
}

TEST(MeasurementCheck, RejectsRepeatedIds) {
  FrameMeasurement measurement = Good();
  measurement.points.points[1].id = 1;
  ExpectRefused(measurement, "point 1 occurs twice");
  measurement = Good();
  measurement.lines->lines[1].id = 1;
  ExpectRefused(measurement, "line 1 occurs twice");
}

TEST(MeasurementCheck, RejectsImpossibleCoordinates) {
  FrameMeasurement measurement = Good();
  measurement.points.points[0].xy.x() = kNan;
  ExpectRefused(measurement, "point 1 has impossible coordinates");
  measurement = Good();
  measurement.points.points[0].velocity.y() = std::numeric_limits<double>::infinity();
  ExpectRefused(measurement, "point 1 has impossible coordinates");
  measurement = Good();
  measurement.points.points[1].uv_px.x() = kNan;
  ExpectRefused(measurement, "point 2 has impossible coordinates");
  measurement = Good();
  measurement.lines->lines[1].end.y() = -1e20;
  ExpectRefused(measurement, "line 2 has impossible coordinates");
}

TEST(MeasurementCheck, RejectsImuSamplesThatAreNotFinite) {
  FrameMeasurement measurement = Good();
  measurement.imu[0].accel.z() = kNan;
  ExpectRefused(measurement, "IMU sample is not finite");
}

TEST(MeasurementCheck, RejectsInvalidDoubts) {
  for (const double doubt : {-1.0, kNan, std::numeric_limits<double>::infinity()}) {
    FrameMeasurement measurement = Good();
    measurement.imu[0].gyro_doubt = doubt;
    ExpectRefused(measurement, "or its doubt negative");
    measurement = Good();
    measurement.imu[0].accel_doubt = doubt;
    ExpectRefused(measurement, "or its doubt negative");
  }
}

TEST(MeasurementCheck, RejectsImuSamplesThatDoNotReachTheImage) {
  FrameMeasurement measurement = Next();
  measurement.imu.clear();
  ExpectRefusedNext(measurement, "has no IMU sample");
  measurement = Next();
  std::swap(measurement.imu[0], measurement.imu[1]);
  ExpectRefusedNext(measurement, "stamps of its IMU samples do not increase");
  measurement = Next();
  measurement.imu[0].t_ns += 1;
  ExpectRefusedNext(measurement, "do not begin at the end of the previous ones, 7000000000 ns");
  measurement = Next();
  measurement.imu.pop_back();
  ExpectRefusedNext(measurement, "no IMU sample follows the previous image");
}

}  // namespace
}  // namespace plm_vins
