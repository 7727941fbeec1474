// SPDX-License-Identifier: BSD-3-Clause
// Restarts of the back end on request and after jumps of the timestamps, and its warnings about the
// IMU.
#include "vins_estimator/estimation_stage.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <iomanip>
#include <sstream>
#include <string>
#include <vector>

#include "test/testing/numeric_jacobian.h"
#include "test/testing/still_scene.h"
#include "test/vins_estimator/estimated_flight.h"
#include "test/vins_estimator/planned_flight.h"

namespace plm_vins {
namespace {

constexpr int64_t kMillisecond = 1'000'000;

class EstimationStageTest : public ::testing::Test {
 protected:
  void SetUp() override {
    Config config = testing::StillConfig();
    config.use_lines = false;
    stage_.emplace(config);
    outputs_.clear();
  }

  void AddImu(int milliseconds) { stage_->AddImu(testing::StillImu(milliseconds * kMillisecond)); }
  void AddPoints(int milliseconds) {
    PointFrame frame;
    frame.t_ns = milliseconds * kMillisecond;
    for (int i = 0; i < 20; ++i) {
      PointObservation point;
      point.id = i;
      const int row = i / 5;
      point.xy = {0.1 * (i % 5 - 2), 0.1 * (row - 2)};
      point.uv_px = {160 + 200 * point.xy.x(), 120 + 200 * point.xy.y()};
      frame.points.push_back(point);
    }
    stage_->AddPoints(frame);
  }

  // Adds input at standstill from `begin` to `end` [ms]: IMU samples at 200 Hz, images at 20 Hz.
  void Rest(int begin, int end) {
    for (int t = begin; t <= end; t += 5) {
      AddImu(t);
      if (t % 50 == 0) AddPoints(t);
      Take();
    }
  }

  void Take() {
    while (const auto frame = stage_->Pop()) outputs_.push_back(frame->output);
  }

  std::vector<std::string> Restarts() const {
    std::vector<std::string> reasons;
    for (const EstimatorOutput& output : outputs_) {
      if (output.restarted) reasons.push_back(output.reason);
    }
    return reasons;
  }

  std::optional<EstimationStage> stage_;
  std::vector<EstimatorOutput> outputs_;
};

TEST_F(EstimationStageTest, ReportsTheAngularVelocityCovariance) {
  Config config = testing::StillConfig();
  config.use_lines = false;
  config.sensor.imu_noise.gyro_density = 0.01;
  stage_.emplace(config);
  std::optional<EstimatedFrame> last;
  for (int t = 0; t <= 1000; t += 5) {
    AddImu(t);
    if (t % 50 == 0) AddPoints(t);
    while (const auto frame = stage_->Pop()) last = frame;
  }
  ASSERT_TRUE(last);
  EXPECT_NEAR(last->angular_velocity_variance, 0.01 * 0.01 / 0.005, 1e-9);
}

TEST_F(EstimationStageTest, ResetIsReportedWithTheNextImage) {
  Rest(5000, 7000);
  ASSERT_TRUE(outputs_.back().has_pose);
  stage_->Reset("why");
  EXPECT_EQ(stage_->resets(), 1);
  EXPECT_TRUE(Restarts().empty());
  Rest(7005, 9000);
  EXPECT_EQ(Restarts(), (std::vector<std::string>{"why"}));
  EXPECT_TRUE(outputs_.back().has_pose);
  EXPECT_EQ(stage_->resets(), 1);
}

TEST_F(EstimationStageTest, UsesCorrectedReadings) {
  Config config = testing::StillConfig();
  config.use_lines = false;
  config.sensor.imu.accel_correction << 0, -1.05, 0, 0.95, 0, 0, 0, 0, 1;
  stage_.emplace(config);
  size_t samples = 0;
  for (int t = 0; t <= 1000; t += 5) {
    stage_->AddImu(Uncorrected(testing::StillImu(t * kMillisecond), config.sensor.imu));
    if (t % 50 == 0) AddPoints(t);
    while (const auto frame = stage_->Pop()) {
      for (const ImuSample& sample : frame->imu) {
        EXPECT_MATRIX_NEAR(sample.accel, testing::StillImu(0).accel, 1e-12);
        ++samples;
      }
    }
  }
  EXPECT_GT(samples, 100u);
}

TEST_F(EstimationStageTest, ResetBeforeTheStartIsNotReported) {
  stage_->Reset("before the first image");
  Rest(0, 500);
  stage_->Reset("why");
  stage_->Reset("again");
  Rest(505, 1000);
  EXPECT_EQ(Restarts(), (std::vector<std::string>{"why"}));
  EXPECT_EQ(stage_->resets(), 1);
}

// NTP may set a clock back by so little that timestamps pass the last one before they suffice for a
// decision, or only those of images do.
TEST_F(EstimationStageTest, StartsOverWhereAllStampsStepBackALittle) {
  for (const int step : {100, 200, 400, 600}) {
    SetUp();
    Rest(5000, 7000);
    for (int i = 0; i < 400; ++i) {
      const int t = 7003 - step + 5 * i;
      AddImu(t);
      if (i % 10 == 0) AddPoints(t);
      Take();
    }
    EXPECT_EQ(Restarts(), (std::vector<std::string>{"timestamps jumped back"})) << step;
    EXPECT_EQ(stage_->statistics().jumps_back, 1);
    EXPECT_TRUE(outputs_.back().has_pose);
  }
}

// Only one sensor's clock was set back, and that of the other follows.
TEST_F(EstimationStageTest, StartsOverWhereTheImuAloneJumpsBack) {
  Rest(5000, 6000);
  for (int t = 0; t <= 5500; t += 5) AddImu(t);
  EXPECT_EQ(stage_->statistics().jumps_back, 1);
  Rest(5505, 7500);
  EXPECT_EQ(Restarts(), (std::vector<std::string>{"timestamps jumped back"}));
  EXPECT_TRUE(outputs_.back().has_pose);
}

TEST_F(EstimationStageTest, StartsOverWhereImagesAloneJumpBack) {
  Rest(5000, 6000);
  for (int t = 0; t <= 1000; t += 50) AddPoints(t);
  EXPECT_EQ(stage_->statistics().jumps_back, 1);
  Rest(1005, 3000);
  EXPECT_EQ(Restarts(), (std::vector<std::string>{"timestamps jumped back"}));
  EXPECT_TRUE(outputs_.back().has_pose);
}

// NTP may set a clock forward by months.
TEST_F(EstimationStageTest, StartsOverWhereAllStampsLeapAhead) {
  Rest(5000, 7000);
  ASSERT_TRUE(outputs_.back().has_pose);
  constexpr int kLeap = 2'000'000'000;
  Rest(kLeap, kLeap + 3000);
  EXPECT_EQ(
      Restarts(),
      (std::vector<std::string>{"no IMU for more than a minute, or its clock jumped forward"}));
  EXPECT_EQ(stage_->statistics().leaps_ahead, 1);
  EXPECT_EQ(stage_->resets(), 1);
  EXPECT_TRUE(outputs_.back().has_pose);
  EXPECT_EQ(outputs_.back().t_ns, (kLeap + 3000) * kMillisecond);
}

// The estimator handles the longest pause that is not a jump.
TEST_F(EstimationStageTest, PauseIsNotALeap) {
  Rest(5000, 7000);
  Rest(66'000, 68'000);
  EXPECT_EQ(stage_->statistics().leaps_ahead, 0);
  EXPECT_EQ(stage_->statistics().imu_gaps, 1);
  EXPECT_TRUE(outputs_.back().has_pose);
}

TEST_F(EstimationStageTest, ReportsATooLowImuRate) {
  for (int t = 0; t <= 8000; t += 60) {
    AddImu(t);
    AddPoints(t + 20);
    Take();
  }
  EXPECT_EQ(stage_->frames(), 0);
  EXPECT_EQ(
      stage_->ImuContradiction().rfind("the IMU rate is 16.7 Hz; at least 20 Hz is needed", 0), 0u);
}

// Runs the stage on a flight with points only.
testing::EstimatedFlight Fly(const testing::SimulatedFlight& flight, EstimationStage* stage) {
  testing::EstimatedFlight estimated;
  for (size_t i = 0; i < flight.frames.size(); ++i) {
    const FrameMeasurement& frame = flight.frames[i];
    for (size_t k = i > 0 ? 1 : 0; k < frame.imu.size(); ++k) stage->AddImu(frame.imu[k]);
    stage->AddPoints(frame.points);
    while (const auto estimate = stage->Pop()) {
      if (estimate->output.restarted) estimated.restarts.push_back(estimate->output.reason);
      if (!estimate->output.has_pose) continue;
      estimated.outputs.push_back(estimate->output);
      estimated.truth.push_back(flight.truth[i]);
    }
  }
  return estimated;
}

EstimationStage StageFor(const testing::SimulatedFlight& flight) {
  Config config = testing::ConfigFor(flight);
  config.use_lines = false;
  return EstimationStage(config);
}

int64_t CountRepeated(const EstimationStage& stage) {
  for (const DropCount& drop : stage.Drops()) {
    if (drop.cause == "frames_repeated") return drop.count;
  }
  return -1;
}

testing::SimulatedFlight GentleFlightFor(double duration) {
  return testing::PlannedFlight(testing::GentlePlan(duration)).Simulate();
}

// Everything that the stage reports after an image, in words.
std::string ReportOf(const EstimationStage& stage, const EstimatorOutput& newest) {
  std::ostringstream text;
  text << std::setprecision(17) << newest.t_ns << ' ' << ToString(newest.status) << ' '
       << newest.imu_noise_scale << ' ' << newest.imu_noise.accel_density << ' '
       << newest.contradicted << newest.on_imu_alone << newest.keyframe << newest.stationary
       << newest.imu_doubted << ' ' << newest.counts.points_in_window << ' '
       << newest.counts.known_rejected << " input: " << stage.InputFinding().text
       << "; IMU: " << stage.ImuContradiction() << "; sensors: " << stage.SensorFaults();
  return text.str();
}

// Runs the stage on a flight; returns its reports, and its positions to the last bit.
std::vector<std::string> ReportsOf(const testing::SimulatedFlight& flight, EstimationStage* stage) {
  std::vector<std::string> reports;
  for (size_t i = 0; i < flight.frames.size(); ++i) {
    const FrameMeasurement& frame = flight.frames[i];
    for (size_t k = i > 0 ? 1 : 0; k < frame.imu.size(); ++k) stage->AddImu(frame.imu[k]);
    stage->AddPoints(frame.points);
    while (const auto estimate = stage->Pop()) {
      std::ostringstream position;
      position << std::hexfloat << estimate->output.state.position().transpose();
      reports.push_back(ReportOf(*stage, estimate->output) + position.str());
    }
  }
  return reports;
}

// The flight is played again from its start, after one that left many findings.
TEST(EstimationStage, ReportsAfterARestartWhatANewOneReports) {
  const testing::SimulatedFlight flight = GentleFlightFor(8);
  testing::SimulatedFlight bad = flight;
  for (FrameMeasurement& frame : bad.frames) {
    for (PointObservation& point : frame.points.points) {
      point.xy = {-point.xy.y(), point.xy.x()};  // the camera is mounted turned by 90 degrees
    }
    for (ImuSample& sample : frame.imu) {
      const double sign = sample.t_ns / 5'000'000 % 2 == 0 ? 1 : -1;
      sample.accel += sign * Eigen::Vector3d(2, 2, 2);  // vibration
    }
  }
  EstimationStage fresh = StageFor(flight), restarted = StageFor(flight);
  ReportsOf(bad, &restarted);
  EXPECT_NE(restarted.InputFinding().text, "");
  restarted.Reset("played again");
  EXPECT_EQ(ReportsOf(flight, &restarted), ReportsOf(flight, &fresh));
  EXPECT_EQ(restarted.queued_frames(), fresh.queued_frames());
}

// The stage finds out by itself that stamps jumped back, and judges the rotations again.
TEST(EstimationStage, FindsAWrongRotationAfterStampsJumpedBack) {
  testing::SimulatedFlight flight = GentleFlightFor(8);
  EstimationStage stage = StageFor(flight);
  Fly(flight, &stage);
  EXPECT_EQ(stage.InputFinding().text, "");
  for (FrameMeasurement& frame : flight.frames) {
    frame.t_ns -= 100'000'000'000;
    frame.points.t_ns = frame.t_ns;
    for (PointObservation& point : frame.points.points) point.xy = {-point.xy.y(), point.xy.x()};
    for (ImuSample& sample : frame.imu) sample.t_ns -= 100'000'000'000;
  }
  Fly(flight, &stage);
  EXPECT_EQ(stage.InputFinding().text.rfind("extrinsicRotation is wrong by 90 deg", 0), 0u)
      << stage.InputFinding().text;
}

TEST(EstimationStage, FindsAWrongTimeOffset) {
  for (const double delay : {-0.03, 0.03}) {
    testing::SimulatedFlight flight = GentleFlightFor(20);
    flight.sensor.td = delay;
    EstimationStage stage = StageFor(flight);
    Fly(flight, &stage);
    const std::string finding = stage.InputFinding().text;
    ASSERT_EQ(finding.rfind("td is wrong by ", 0), 0u) << finding;
    EXPECT_NEAR(std::stod(finding.substr(15)), -1e3 * delay, 10);
  }
}

// If repeated images counted as observations, they would hold the position for two seconds while
// the vehicle moves.
TEST(EstimationStage, RepeatedImageIsNotStandstill) {
  testing::SimulatedFlight flight = GentleFlightFor(12);
  constexpr size_t kFrozen = 160, kThawed = 200;  // images
  for (size_t i = kFrozen; i < kThawed; ++i) {
    flight.frames[i].points.points = flight.frames[kFrozen - 1].points.points;
  }
  EstimationStage stage = StageFor(flight);
  const testing::EstimatedFlight estimated = Fly(flight, &stage);
  EXPECT_TRUE(estimated.restarts.empty());
  EXPECT_EQ(CountRepeated(stage), static_cast<int64_t>(kThawed - kFrozen));
  const size_t frozen_at = estimated.outputs.size() - (flight.frames.size() - kFrozen);
  for (size_t i = frozen_at; i < frozen_at + kThawed - kFrozen; ++i) {
    EXPECT_TRUE(estimated.outputs[i].on_imu_alone) << i;
  }
  EXPECT_LT(testing::GreatestError(estimated, frozen_at - 1), 0.1);
}

// A simulated camera delivers identical images while the vehicle stands still.
TEST(EstimationStage, NoiseFreeCameraMayStandStill) {
  testing::FlightPlan plan;
  plan.duration = 15;
  plan.corner_noise_px = 0;
  plan.T_W_V = [](double t) { return testing::GentleFlight(t, 3, 8); };
  const testing::SimulatedFlight flight = testing::PlannedFlight(plan).Simulate();
  EstimationStage stage = StageFor(flight);
  const testing::EstimatedFlight estimated = Fly(flight, &stage);
  EXPECT_TRUE(estimated.restarts.empty());
  EXPECT_LE(CountRepeated(stage), 10);  // half a second after the landing
  EXPECT_TRUE(estimated.outputs.back().stationary);
  EXPECT_LT(testing::GreatestError(estimated, 0), 0.02);
}

// Vibrations in flight are observable from the images.
TEST(EstimationStage, ReportsFarTooSmallConfiguredNoise) {
  testing::FlightPlan plan = testing::GentlePlan(12);
  for (const double noise : {1, 20}) {
    plan.imu_noise = noise;
    const testing::SimulatedFlight flight = testing::PlannedFlight(plan).Simulate();
    EstimationStage stage = StageFor(flight);
    Fly(flight, &stage);
    for (const char* const name : {"; acc_n is ", "; gyr_n is "}) {
      EXPECT_EQ(stage.ImuContradiction().find(name) != std::string::npos, noise > 1) << noise;
    }
    EXPECT_EQ(stage.ImuContradiction().empty(), noise == 1) << noise;
  }
}

// Vibration shows in the samples of the IMU, so the camera does not contradict them.
TEST(EstimationStage, SuddenVibrationIsNoContradiction) {
  testing::FlightPlan plan = testing::GentlePlan(8);
  const testing::SimulatedFlight flight = testing::PlannedFlight(plan).Simulate();
  plan.imu_noise = 12;
  const testing::SimulatedFlight vibrating = testing::PlannedFlight(plan).Simulate();
  EstimationStage stage = StageFor(flight);
  for (size_t i = 0; i < flight.frames.size(); ++i) {
    FrameMeasurement frame = flight.frames[i];
    if (i > 130) frame.imu = vibrating.frames[i].imu;
    Fly({flight.sensor, {frame}, {flight.truth[i]}}, &stage);
    ASSERT_EQ(stage.ImuContradiction(), "") << i;
  }
}

// The samples are as configured: neither acc_n nor gyr_n is the cause.
TEST(EstimationStage, DoesNotBlameTheNoiseForAWrongCalibration) {
  testing::SimulatedFlight flight = GentleFlightFor(12);
  flight.sensor.cameras[0].T_B_C.rotation *=
      Eigen::Quaterniond(Eigen::AngleAxisd(0.3, Eigen::Vector3d::UnitZ()));
  EstimationStage stage = StageFor(flight);
  Fly(flight, &stage);
  const std::string contradiction = stage.ImuContradiction();
  EXPECT_EQ(stage.InputFinding().text.rfind("extrinsicRotation is wrong by 17 deg", 0), 0u)
      << stage.InputFinding().text;
  EXPECT_EQ(contradiction.find("acc_n"), std::string::npos) << contradiction;
  EXPECT_EQ(contradiction.find("gyr_n"), std::string::npos) << contradiction;
}

}  // namespace
}  // namespace plm_vins
