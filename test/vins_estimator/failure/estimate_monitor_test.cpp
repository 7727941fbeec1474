// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/failure/estimate_monitor.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "common/measurements.h"

namespace plm_vins {
namespace {

using ::testing::HasSubstr;

// A state at standstill with a standard deviation of 1 cm and a hundred inlier points.
EstimateMonitor::Evidence Good(double t) {
  EstimateMonitor::Evidence evidence;
  evidence.solved = true;
  evidence.newest.t_ns = evidence.predicted.t_ns = ToNanoseconds(t);
  evidence.pose_covariance =
      Eigen::Matrix<double, 6, 6>(1e-4 * Eigen::Matrix<double, 6, 6>::Identity());
  evidence.features_observed = evidence.counts.known_seen = 100;
  return evidence;
}

TEST(EstimateMonitor, AcceptsAConsistentEstimate) {
  EstimateMonitor monitor;
  for (int i = 0; i < 100; ++i) {
    EXPECT_FALSE(monitor.Add(Good(0.05 * i)));
    EXPECT_FALSE(monitor.contradicted());
    EXPECT_FALSE(monitor.blind());
  }
}

TEST(EstimateMonitor, FailsAtOnceWithoutASolution) {
  EstimateMonitor monitor;
  EstimateMonitor::Evidence evidence = Good(0);
  evidence.solved = false;
  const auto failure = monitor.Add(evidence);
  ASSERT_TRUE(failure);
  EXPECT_THAT(failure->why, HasSubstr("no solution"));
  EXPECT_FALSE(failure->has_drifted);
}

TEST(EstimateMonitor, NamesAGapOfTheImuBeforeAFailure) {
  EstimateMonitor::Evidence evidence = Good(0);
  evidence.longest_imu_gap = 3;
  EXPECT_FALSE(EstimateMonitor().Add(evidence));
  evidence.solved = false;
  const auto failure = EstimateMonitor().Add(evidence);
  ASSERT_TRUE(failure);
  EXPECT_THAT(failure->why, HasSubstr("3.0 s"));
}

TEST(EstimateMonitor, FailsOnLastingContradiction) {
  EstimateMonitor monitor;
  std::optional<Failure> failure;
  for (int i = 0; i < 40 && !failure; ++i) {
    EstimateMonitor::Evidence evidence = Good(0.05 * i);
    evidence.counts.known_rejected = 50;
    failure = monitor.Add(evidence);
    EXPECT_TRUE(monitor.contradicted());
  }
  ASSERT_TRUE(failure);
  EXPECT_THAT(failure->why, HasSubstr("camera contradicts"));
  EXPECT_FALSE(failure->has_drifted);
}

TEST(EstimateMonitor, BlindDriftIsNotBridged) {
  EstimateMonitor monitor;
  EXPECT_FALSE(monitor.Add(Good(0)));
  EstimateMonitor::Evidence evidence = Good(3);
  evidence.features_observed = evidence.counts.known_seen = 0;
  evidence.pose_covariance->diagonal().head<3>().setConstant(1);
  const auto failure = monitor.Add(evidence);
  ASSERT_TRUE(failure);
  EXPECT_TRUE(failure->has_drifted);
}

TEST(EstimateMonitor, FailsOnADivergedTimeOffset) {
  for (const double change : {0.19, -0.19}) {
    EstimateMonitor::Evidence evidence = Good(0);
    evidence.time_offset_change = change;
    EXPECT_FALSE(EstimateMonitor().Add(evidence));
  }
  for (const double change : {0.21, -0.21, std::nan("")}) {
    EstimateMonitor::Evidence evidence = Good(0);
    evidence.time_offset_change = change;
    const auto failure = EstimateMonitor().Add(evidence);
    ASSERT_TRUE(failure);
    EXPECT_EQ(failure->why.substr(0, 2), std::isnan(change) ? "td" : "ch") << failure->why;
    EXPECT_TRUE(failure->has_drifted);
  }
}

TEST(EstimateMonitor, FailsOnAStateJump) {
  EstimateMonitor monitor;
  EstimateMonitor::Evidence evidence = Good(0);
  evidence.newest.position().x() += 4;
  const auto failure = monitor.Add(evidence);
  ASSERT_TRUE(failure);
  EXPECT_FALSE(failure->has_drifted);
}

}  // namespace
}  // namespace plm_vins
