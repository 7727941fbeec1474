// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/monitoring/blindness_monitor.h"

#include <gtest/gtest.h>

#include "common/measurements.h"

namespace plm_vins {
namespace {

// Of a position known to this deviation, in all directions together.
Eigen::Matrix3d Known(double deviation) {
  return deviation * deviation / 3 * Eigen::Matrix3d::Identity();
}

TEST(BlindnessMonitor, BearsDriftWhileSomethingIsSeen) {
  BlindnessMonitor monitor;
  for (int i = 0; i < 1000; ++i) EXPECT_FALSE(monitor.Add(i, 6, 6, Known(0.01 * i)));
}

TEST(BlindnessMonitor, EndsWhatBlindnessHasMadeTooUncertain) {
  BlindnessMonitor monitor;
  monitor.Add(0, 100, 100, Known(3.0));
  EXPECT_FALSE(monitor.Add(ToNanoseconds(0.5), 0, 0, Known(3.0)));
  EXPECT_FALSE(monitor.Add(ToNanoseconds(1.5), 5, 5, Known(3.02)));
  EXPECT_EQ(monitor.Add(ToNanoseconds(3.5), 5, 5, Known(3.06)).value_or(""),
            "nothing has held the position for 3.5 s, which leaves it open by 0.60 m");
}

TEST(BlindnessMonitor, WhatHoldsNothingIsAsGoodAsBlindness) {
  BlindnessMonitor monitor;
  monitor.Add(0, 100, 100, Known(0.1));
  for (int i = 1; i < 10; ++i) {
    EXPECT_FALSE(monitor.Add(ToNanoseconds(0.5 * i), 100, 5, Known(0.05 * i)));
    EXPECT_FALSE(monitor.blind());
  }
  EXPECT_EQ(monitor.Add(ToNanoseconds(5.0), 100, 5, Known(0.6)).value_or(""),
            "nothing has held the position for 5.0 s, which leaves it open by 0.59 m");
}

TEST(BlindnessMonitor, AGapBetweenImagesIsBlindness) {
  BlindnessMonitor monitor;
  monitor.Add(0, 100, 100, Known(0.1));
  EXPECT_EQ(monitor.Add(ToNanoseconds(4.0), 100, 100, Known(0.6)).value_or(""),
            "nothing has held the position for 4.0 s, which leaves it open by 0.59 m");
}

TEST(BlindnessMonitor, TakesNothingFromAnUnknownCovariance) {
  BlindnessMonitor monitor;
  EXPECT_FALSE(monitor.Add(0, 100, 100, Eigen::Matrix3d::Zero()));
  EXPECT_FALSE(monitor.Add(1, 100, 100, Known(3.0)));
  EXPECT_FALSE(monitor.Add(2, 100, 100, Eigen::Matrix3d::Zero()));
  EXPECT_FALSE(monitor.Add(3, 5, 5, Known(3.0)));
  EXPECT_TRUE(monitor.blind());
  EXPECT_FALSE(monitor.Add(4, 100, 100, Eigen::Matrix3d::Zero()));
  EXPECT_FALSE(monitor.blind());
  EXPECT_TRUE(monitor.Add(5, 5, 5, Known(3.1)));
}

TEST(BlindnessMonitor, SightStartsItOver) {
  BlindnessMonitor monitor;
  monitor.Add(0, 0, 0, Known(0.4));
  monitor.Add(1, 50, 50, Known(0.4));
  EXPECT_FALSE(monitor.Add(2, 0, 0, Known(0.6)));
}

}  // namespace
}  // namespace plm_vins
