// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/monitoring/companion_report.h"

#include <gtest/gtest.h>

namespace plm_vins {
namespace {

TEST(CompanionReport, IsEmptyWithoutFaults) { EXPECT_EQ(DescribeFaults({}, {}), ""); }

TEST(CompanionReport, NamesAllFaults) {
  SecondCameraFaults second_camera;
  second_camera.delay = 0.0123;
  second_camera.baseline = LengthEvidence{-0.0101, 0.0021};
  DepthFaults depth;
  depth.scale = LengthEvidence{0.0195, 0.004};
  depth.delay = 0.0302;
  EXPECT_EQ(DescribeFaults(second_camera, depth),
            "second camera: it exposes +12 ms after the first camera; second camera: according to "
            "the IMU, its baseline is 1.0 +- 0.2 % shorter than body_T_cam1 states; depth_topic: "
            "according to the IMU, depths are 1.9 +- 0.4 % too long; depth_topic: depth images are "
            "30 ms older than their timestamps");
}

}  // namespace
}  // namespace plm_vins
