// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/initialization/motion_initializer.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/geometry/so3.h"
#include "simulator/random.h"
#include "test/vins_estimator/initialization/simulated_frames.h"

namespace plm_vins {
namespace {

using ::testing::HasSubstr;

using Eigen::Vector3d;

constexpr int kFrames = 11;

// Exact data of a body that moves horizontally, without rotation and at constant velocity, in front
// of a wall of points.
std::vector<FrameMeasurement> Glide(const SensorConfig& sensor, const Vector3d& velocity) {
  simulator::Random random(7);
  const Eigen::Quaterniond R_W_B = simulator::ForwardLookingBody(sensor.cameras[0].T_B_C);
  constexpr int kLandmarks = 100;
  std::vector<Vector3d> landmarks;
  landmarks.reserve(kLandmarks);
  for (int i = 0; i < kLandmarks; ++i) {
    landmarks.push_back({random.Uniform(3, 8), random.Uniform(-2, 2), random.Uniform(-1, 1)});
  }
  std::vector<FrameMeasurement> frames(kFrames);
  for (int i = 0; i < kFrames; ++i) {
    FrameMeasurement& frame = frames[i];
    frame.t_ns = i * 200'000'000;
    const Rigid3d T_W_C =
        Rigid3d(R_W_B, velocity * ToSeconds(frame.t_ns)) * sensor.cameras[0].T_B_C;
    for (size_t id = 0; id < landmarks.size(); ++id) {
      PointObservation point;
      point.id = static_cast<int64_t>(id);
      point.xy = (T_W_C.Inverse() * landmarks[id]).hnormalized();
      frame.points.points.push_back(point);
    }
    for (int64_t t = frame.t_ns - 200'000'000; t <= frame.t_ns; t += 5'000'000) {
      frame.imu.push_back({t, Vector3d::Zero(), R_W_B.conjugate() * Vector3d(0, 0, 9.81)});
    }
  }
  return frames;
}

class MotionInitializerTest : public ::testing::Test {
 protected:
  std::optional<std::vector<FrameState>> Run(const std::vector<FrameMeasurement>& frames) {
    return InitializeFromMotion(frames, simulator::DefaultSensors(), 0.5, {}, &reason_);
  }

  // Keeps every fifth frame of a flight, with joined IMU samples.
  void Thin(const testing::SimulatedFlight& flight) {
    std::vector<ImuSample> imu;
    for (size_t i = 0; i < 5 * kFrames; ++i) {
      JoinImu(flight.frames[i].imu, &imu);
      if (i % 5 != 0) continue;
      frames_.push_back(flight.frames[i]);
      frames_.back().imu = imu;
      truth_.push_back(flight.truth[i]);
      imu = {imu.back()};
    }
  }

  std::vector<FrameMeasurement> frames_;
  std::vector<FrameState> truth_;
  std::string reason_;
};

TEST_F(MotionInitializerTest, StatesStartAtTheOriginWithoutHeading) {
  Thin(testing::SimulateFlight(testing::FlightOptions(simulator::Motion::kFast, 1), 3));
  const auto states = Run(frames_);
  ASSERT_TRUE(states) << reason_;
  ASSERT_EQ(states->size(), frames_.size());
  EXPECT_LT(states->front().position().norm(), 1e-9);
  EXPECT_NEAR(Yaw(Eigen::Quaterniond(states->front().rotation())), 0, 1e-9);
  for (size_t i = 0; i < frames_.size(); ++i) {
    EXPECT_EQ((*states)[i].t_ns, frames_[i].t_ns);
    EXPECT_LT(testing::GravityError((*states)[i], truth_[i]), 0.02);
    EXPECT_LT(testing::VelocityError((*states)[i], truth_[i]), 0.1);
  }
}

TEST_F(MotionInitializerTest, RejectsConstantVelocity) {
  EXPECT_FALSE(Run(Glide(simulator::DefaultSensors(), {0.1, 0.5, 0.1})));
  EXPECT_THAT(reason_, HasSubstr("scale"));
}

TEST_F(MotionInitializerTest, RejectsAnImuThatDisagreesWithTheCamera) {
  Thin(testing::SimulateFlight(testing::FlightOptions(simulator::Motion::kFast, 1), 3));
  for (FrameMeasurement& frame : frames_) {
    for (ImuSample& sample : frame.imu)
      sample.accel = {sample.accel.x(), -sample.accel.z(), sample.accel.y()};
  }
  EXPECT_FALSE(Run(frames_));
  EXPECT_FALSE(reason_.empty());
}

}  // namespace
}  // namespace plm_vins
