// SPDX-License-Identifier: BSD-3-Clause
#include "common/config/stereo_pairs.h"

#include <gtest/gtest.h>

#include "simulator/default_sensors.h"

namespace plm_vins {
namespace {

std::string Pairs(const SensorConfig& sensor) {
  std::string text;
  for (const auto& [first, second] : StereoPairs(sensor)) {
    text += std::to_string(first) + "-" + std::to_string(second) + " ";
  }
  return text;
}

// A stereo pair, and one more that is turned about the vertical axis.
SensorConfig TwoPairs(double yaw) {
  SensorConfig sensor = simulator::DefaultStereoSensors();
  const Rigid3d turn(Eigen::Quaterniond(Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitX())),
                     Eigen::Vector3d::Zero());
  for (int i = 0; i < 2; ++i) {
    CameraSensor turned = sensor.cameras[i];
    turned.T_B_C = turn * turned.T_B_C;
    sensor.cameras.push_back(turned);
  }
  return sensor;
}

TEST(StereoPairsTest, FollowFromTheCalibration) {
  EXPECT_EQ(Pairs(simulator::DefaultSensors()), "");
  EXPECT_EQ(Pairs(simulator::DefaultStereoSensors()), "0-1 ");
  EXPECT_EQ(Pairs(TwoPairs(M_PI)), "0-1 2-3 ");
  EXPECT_EQ(Pairs(TwoPairs(1.0)), "0-1 2-3 ");
  EXPECT_EQ(Pairs(TwoPairs(0.1)), "0-1 2-3 ");
}

TEST(StereoPairsTest, CanBeGiven) {
  SensorConfig sensor = TwoPairs(M_PI);
  sensor.stereo_pairs = "0-2 1-3";
  EXPECT_FALSE(CheckStereoPairs(sensor));
  EXPECT_EQ(Pairs(sensor), "0-2 1-3 ");
  EXPECT_TRUE(IsTracked(1, StereoPairs(sensor)));
  EXPECT_FALSE(IsTracked(2, StereoPairs(sensor)));
  sensor.stereo_pairs = "none";
  EXPECT_EQ(Pairs(sensor), "");
}

TEST(StereoPairsTest, OthersAreProblems) {
  SensorConfig sensor = TwoPairs(M_PI);
  for (const char* text :
       {"", "all", "0-1,2-3", "1-0", "0-0", "0-4", "0-1 1-2", "0-2 1-2", "0-1 0-2"}) {
    sensor.stereo_pairs = text;
    EXPECT_TRUE(CheckStereoPairs(sensor)) << text;
  }
}

}  // namespace
}  // namespace plm_vins
