// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/ros/estimator_diagnostics.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace plm_vins {
namespace {

using ::testing::HasSubstr;

using Status = diagnostic_updater::DiagnosticStatusWrapper;

// Reports the diagnostics of a tracked image with a pose of this age.
class EstimatorDiagnosticsTest : public ::testing::Test {
 protected:
  Status Report(double age) {
    diagnostics_.Update(output_, ++frames_, age);
    Status status;
    diagnostics_.Report(0, &status);
    return status;
  }

  static std::string Value(const Status& status, const std::string& key) {
    for (const auto& value : status.values) {
      if (value.key == key) return value.value;
    }
    return "missing";
  }

  void SetUp() override {
    ros::Time::init();
    output_.status = EstimatorStatus::kTracking;
    output_.has_pose = true;
  }

  EstimatorDiagnostics diagnostics_{ImuNoise(), "/robot1/imu", "/points", "/lines"};
  EstimatorOutput output_;
  int64_t frames_ = 0;
};

TEST_F(EstimatorDiagnosticsTest, AreOkWhileTrackingInTime) {
  const Status status = Report(0.1);
  EXPECT_EQ(status.level, diagnostic_msgs::DiagnosticStatus::OK);
  EXPECT_EQ(status.message, "tracking");
  EXPECT_EQ(Value(status, "pose_age_ms"), "100");
}

TEST_F(EstimatorDiagnosticsTest, WarnOfPosesOlderThanHalfASecond) {
  EXPECT_EQ(Report(0.49).level, diagnostic_msgs::DiagnosticStatus::OK);
  const Status status = Report(4.2);
  EXPECT_EQ(status.level, diagnostic_msgs::DiagnosticStatus::WARN);
  EXPECT_THAT(status.message, HasSubstr("4200 ms"));
  EXPECT_EQ(Value(status, "pose_age_ms"), "4200");
}

TEST_F(EstimatorDiagnosticsTest, StateTheNoiseOfTheImuAsConfiguredUntilItIsLearned) {
  ImuNoise configured;
  configured.accel_density = 0.5;
  EstimatorDiagnostics diagnostics(configured, "/imu", "/points", "/lines");
  const auto density = [&] {
    Status status;
    diagnostics.Report(0, &status);
    return Value(status, "accel_density");
  };
  EXPECT_EQ(density(), "0.5");
  output_.imu_noise.accel_density = 0.7;
  diagnostics.Update(output_, 1, 0);
  EXPECT_EQ(density(), "0.7");
  diagnostics.Update(EstimatorOutput(), 1, 0);  // everything restarts
  EXPECT_EQ(density(), "0.5");
}

TEST_F(EstimatorDiagnosticsTest, WarnOfDoubtfulPoses) {
  output_.on_imu_alone = true;
  EXPECT_THAT(Report(0).message, HasSubstr("blind"));
  output_.on_imu_alone = false;
  output_.contradicted = true;
  const Status status = Report(0);
  EXPECT_THAT(status.message, HasSubstr("contradicts"));
  EXPECT_EQ(status.level, diagnostic_msgs::DiagnosticStatus::WARN);
}

TEST_F(EstimatorDiagnosticsTest, WarnOfUnusableInput) {
  diagnostics_.CountMalformed("two channels");
  diagnostics_.CountLeftOut(3);
  Status status;
  diagnostics_.Report(0, &status);
  EXPECT_EQ(status.level, diagnostic_msgs::DiagnosticStatus::WARN);
  EXPECT_THAT(status.message, HasSubstr("waiting"));
  EXPECT_EQ(Value(status, "feature_messages_malformed"), "1");
  EXPECT_EQ(Value(status, "features_impossible"), "3");
}

TEST_F(EstimatorDiagnosticsTest, AreOkAgainOnceAFaultHasPassed) {
  Config config;
  CameraParameters& camera = config.sensor.cameras[0].parameters;
  camera.width = camera.height = 200;
  camera.fx = camera.fy = camera.cx = camera.cy = 100;
  EstimationStage stage(config);
  const auto add_second = [&](int64_t second, double force) {
    for (int64_t i = 0; i < 200; ++i) {
      const int64_t t_ns = second * 1'000'000'000 + i * 5'000'000;
      stage.AddImu({t_ns, {0.1, 0.2, 0}, {0, 0, force}});
      if (i % 10 == 0) stage.AddPoints({t_ns, {}});
    }
    diagnostics_.UpdateCounts(stage, {});
    return Report(0.1);
  };
  Status status;
  for (int64_t second = 0; second < 5; ++second) status = add_second(second, 1);
  EXPECT_EQ(status.level, diagnostic_msgs::DiagnosticStatus::WARN);
  EXPECT_THAT(status.message, HasSubstr("seems to be in g: multiply it by 9.81, to m/s^2"));
  for (int64_t second = 5; second < 12; ++second) status = add_second(second, 9.81);
  EXPECT_EQ(status.level, diagnostic_msgs::DiagnosticStatus::OK);
  EXPECT_THAT(status.message, HasSubstr("to m/s^2 (until 00:00:0"));
}

TEST_F(EstimatorDiagnosticsTest, KeepTheReasonOfTheLastRestart) {
  output_.restarted = true;
  output_.reason = "nothing seen";
  Report(0);
  output_.restarted = false;
  output_.reason = "";
  EXPECT_EQ(Value(Report(0), "last_restart"), "nothing seen");
}

}  // namespace
}  // namespace plm_vins
