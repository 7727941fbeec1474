// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/monitoring/fault_report.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "vins_estimator/imu/imu_noise_meter.h"

namespace plm_vins {
namespace {

using ::testing::AllOf;
using ::testing::ContainsRegex;
using ::testing::HasSubstr;
using ::testing::Not;

ContradictionEvidence Evidence() {
  ContradictionEvidence evidence;
  evidence.noise_factor = 5;
  evidence.imu_rate = evidence.configured_imu_rate = 200;
  return evidence;
}

TEST(ContradictionReport, ListsChecksWithoutAKnownCause) {
  EXPECT_THAT(DescribeContradiction(Evidence()),
              AllOf(ContainsRegex("noise is raised by a factor of 5; check.*extrinsicRotation.*td.*"
                                  "focal length.*IMU.*image stabilization"),
                    Not(HasSubstr("acc_n")), Not(HasSubstr("gyr_n"))));
}

TEST(ContradictionReport, ListsOnlyWhatTheRotationsLeaveOpen) {
  ContradictionEvidence evidence = Evidence();
  evidence.rotations = ContradictionEvidence::Rotations::kAgree;
  EXPECT_THAT(DescribeContradiction(evidence),
              ContainsRegex("agree about rotations.*; check.*accelerometer.*delay.*moving objects.*"
                            "image stabilization"));
  evidence.rotations = ContradictionEvidence::Rotations::kExplained;
  EXPECT_THAT(DescribeContradiction(evidence), Not(HasSubstr("check")));
}

TEST(ContradictionReport, NamesKnownCausesFirst) {
  ContradictionEvidence evidence = Evidence();
  evidence.accel_noise_factor = 12;
  evidence.image_jitter = 0.004;
  evidence.imu_rate = 400;
  EXPECT_THAT(DescribeContradiction(evidence),
              ContainsRegex("; the IMU rate is 400 Hz, but imu_rate is 200; "
                            "image timestamps jitter by 4.0 ms; acc_n is 12 times.*; check"));
  evidence.gyro_noise_factor = 9;
  EXPECT_THAT(DescribeContradiction(evidence), HasSubstr("; gyr_n is 9 times too small"));
  evidence.gyro_noise_factor = 5;  // as of propellers
  EXPECT_THAT(DescribeContradiction(evidence), Not(HasSubstr("gyr_n")));
}

TEST(ImuNoiseMeter, MeasuresWhiteNoiseDuringMotion) {
  constexpr double kGyroDensity = 3e-4, kAccelDensity = 4e-3, kRate = 200;
  std::mt19937 random(1);
  std::normal_distribution<double> noise(0, std::sqrt(kRate));
  ImuNoiseMeter meter;
  EXPECT_EQ(meter.accel_density(), 0);
  for (int i = 0; i < 4000; ++i) {
    const double t = i / kRate;
    ImuSample sample{ToNanoseconds(t)};
    sample.gyro = {std::sin(3 * t), 0, std::cos(2 * t)};
    sample.accel = {3 * std::sin(5 * t), 0, 9.81};
    for (int axis = 0; axis < 3; ++axis) {
      sample.gyro[axis] += kGyroDensity * noise(random);
      sample.accel[axis] += kAccelDensity * noise(random);
    }
    if (i % 100 != 0) meter.Add(sample);  // some are lost
  }
  EXPECT_NEAR(meter.gyro_density(), kGyroDensity, 0.05 * kGyroDensity);
  EXPECT_NEAR(meter.accel_density(), kAccelDensity, 0.05 * kAccelDensity);
}

TEST(SensorReport, IsEmptyWithoutFaults) { EXPECT_EQ(DescribeFaults({}, {}), ""); }

TEST(SensorReport, NamesAllFaults) {
  CameraFaults late;
  late.camera = 1;
  late.delay = 0.0123;
  late.baseline = LengthEvidence{-0.0101, 0.0020};
  CameraFaults misfit;
  misfit.camera = 2;
  misfit.misfit_px = 7.04;
  DepthFaults depth;
  depth.scale = LengthEvidence{0.0195, 0.0038};
  depth.delay = 0.0302;
  EXPECT_EQ(DescribeFaults({late, misfit}, depth),
            "camera 1: it exposes +12 ms after camera 0; camera 1: according to the IMU, its "
            "baseline is 1.0 +- 0.2 % shorter than configured; camera 2: it deviates by 7.0 px "
            "from its calibration and is not used; recalibrate it; depth_topic: according to the "
            "IMU, depths are 1.9 +- 0.4 % too long; depth_topic: depth images are "
            "30 ms older than their timestamps, or not aligned to camera 0");
}

}  // namespace

}  // namespace plm_vins
