// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/output/calibrated_config.h"

#include <gtest/gtest.h>

#include <stdexcept>

#include "test/testing/numeric_jacobian.h"
#include "test/testing/temporary_folder.h"

namespace plm_vins {
namespace {

using Mode = SensorConfig::ExtrinsicMode;

Calibration SomeCalibration() {
  Calibration calibration;
  CameraCalibration& camera = calibration.cameras.front();
  camera.parameters.width = 640;
  camera.parameters.height = 480;
  Intrinsics intrinsics;
  intrinsics << 401, 402, 321, 241, -0.3, 0.1, 0.001, 0.002;
  camera.parameters = camera.parameters.With(intrinsics);
  camera.T_B_C = {Eigen::Quaterniond(0.8, 0, 0.6, 0), {0.1, 0.2, 0.3}};
  calibration.td = 0.004;
  return calibration;
}

TEST(CalibratedConfig, IsWrittenIfAnythingIsRefined) {
  EXPECT_FALSE(RefinesCalibration({}));
  SensorConfig sensors[3];
  sensors[0].estimate_intrinsics = true;
  sensors[1].estimate_td = true;
  sensors[2].estimate_extrinsic = Mode::kCalibrateRotation;
  for (const SensorConfig& sensor : sensors) EXPECT_TRUE(RefinesCalibration(sensor));
}

TEST(CalibratedConfig, LoadsUnchanged) {
  const testing::TemporaryFolder folder;
  Config config;
  config.points.fisheye = false;  // as set by the loader without a mask
  config.estimator.window_size = 12;
  config.sensor.rolling_shutter = true;
  config.sensor.rolling_shutter_tr = 0.03;
  SaveCalibratedConfig(SomeCalibration(), config, folder.File("calibrated.yaml"));
  const Config read = LoadConfig(folder.File("calibrated.yaml"));
  const CameraCalibration camera = SomeCalibration().cameras.front();
  EXPECT_EQ(read.estimator.window_size, 12);
  EXPECT_EQ(read.sensor.cameras[0].parameters.intrinsics(), camera.parameters.intrinsics());
  EXPECT_MATRIX_NEAR(read.sensor.cameras[0].T_B_C.R(), camera.T_B_C.R(), 1e-10);
  EXPECT_EQ(read.sensor.cameras[0].T_B_C.translation, camera.T_B_C.translation);
  EXPECT_EQ(read.sensor.td, 0.004);
  EXPECT_EQ(read.sensor.rolling_shutter_tr, 0.03);
}

TEST(CalibratedConfig, HasAllCameras) {
  Config config;
  config.sensor.cameras.emplace_back();
  Calibration calibration = SomeCalibration();
  calibration.cameras.push_back(calibration.cameras.front());
  calibration.cameras[1].T_B_C.translation.x() += 0.1;
  const CameraSensor second = WithCalibration(calibration, config).sensor.cameras[1];
  EXPECT_EQ(second.parameters.intrinsics(), calibration.cameras[1].parameters.intrinsics());
  EXPECT_EQ(second.T_B_C.translation, calibration.cameras[1].T_B_C.translation);
}

// Saves any estimated calibration and loads it again.
Config ReadBack(const Calibration& calibration) {
  const testing::TemporaryFolder folder;
  Config config;
  config.points.fisheye = false;
  SaveCalibratedConfig(calibration, config, folder.File("calibrated.yaml"));
  return LoadConfig(folder.File("calibrated.yaml"));
}

TEST(CalibratedConfig, StaysInTheRangesOfTheKeys) {
  Calibration calibration = SomeCalibration();
  calibration.td = -1.01;
  const Config read = ReadBack(calibration);
  EXPECT_EQ(read.sensor.td, -1);
}

TEST(CalibratedConfig, HasTheCalibratedRotation) {
  Config config;
  for (const Mode mode : {Mode::kFixed, Mode::kRefine}) {
    config.sensor.estimate_extrinsic = mode;
    EXPECT_EQ(WithCalibration(SomeCalibration(), config).sensor.estimate_extrinsic, mode);
  }
  config.sensor.estimate_extrinsic = Mode::kCalibrateRotation;
  EXPECT_EQ(WithCalibration(SomeCalibration(), config).sensor.estimate_extrinsic, Mode::kRefine);
}

TEST(CalibratedConfig, ErrorNamesAnUnwritableFile) {
  const testing::TemporaryFolder folder;
  EXPECT_THROW(SaveCalibratedConfig({}, Config(), folder.File("none/calibrated.yaml")),
               std::runtime_error);
}

}  // namespace
}  // namespace plm_vins
