// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/monitoring/sensor_report.h"

#include <gtest/gtest.h>

namespace plm_vins {
namespace {

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
