// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/ros/calibration_log.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <stdexcept>

#include "test/testing/temporary_folder.h"
#include "test/vins_estimator/ros/busy_disk.h"

namespace plm_vins {
namespace {

TEST(CalibrationLog, SavesTheNewestRefinement) {
  const testing::TemporaryFolder folder;
  Config config;
  config.sensor.estimate_td = true;
  CalibrationLog log(config);
  log.Save(folder.path());
  EXPECT_EQ(folder.Read("calibrated.yaml"), "") << "there was no pose";
  Calibration calibration;
  for (const double td : {0.01, 0.02}) {
    calibration.td = td;
    log.Set(calibration);
  }
  log.Save(folder.path());
  EXPECT_NE(folder.Read("calibrated.yaml").find("\ntd: 0.02\n"), std::string::npos);
}

TEST(CalibrationLog, SavesNothingWithoutRefinement) {
  const testing::TemporaryFolder folder;
  CalibrationLog log{Config()};
  log.Set(Calibration());
  log.Save(folder.path());
  EXPECT_EQ(folder.Read("calibrated.yaml"), "");
}

TEST(CalibrationLog, KeepsTheConfigurationInUse) {
  const testing::TemporaryFolder folder;
  folder.Write("calibrated.yaml", "in use");
  Config config;
  config.file = folder.path() + "/../" + std::filesystem::path(folder.path()).filename().string() +
                "/calibrated.yaml";
  CalibrationLog(config).CheckFolder(folder.path());  // nothing is refined or written
  config.sensor.estimate_td = true;
  CalibrationLog log(config);
  log.Set(Calibration());
  EXPECT_THROW(log.CheckFolder(folder.path()), std::runtime_error);
  EXPECT_THROW(log.Save(folder.path()), std::runtime_error);
  EXPECT_EQ(folder.Read("calibrated.yaml"), "in use");
}

TEST(CalibrationLog, AcceptsUpdatesWhileSaving) {
  const testing::TemporaryFolder folder;
  Config config;
  config.sensor.estimate_td = true;
  CalibrationLog log(config);
  log.Set(Calibration());
  EXPECT_TRUE(testing::EndsWhileSaving(
      folder.File("calibrated.yaml"), [&] { log.Save(folder.path()); },
      [&] { log.Set(Calibration()); }));
}

}  // namespace
}  // namespace plm_vins
