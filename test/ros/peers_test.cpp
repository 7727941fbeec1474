// SPDX-License-Identifier: BSD-3-Clause
// The estimator's node with input as from the trackers of VINS-Mono and PL-VINS: messages in their
// formats, in any order, late or missing; announced restarts. Run by peers.test.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <memory>
#include <random>

#include "test/ros/estimator_log.h"
#include "test/ros/peer_trackers.h"

namespace plm_vins {
namespace {

using testing::EstimatorLog;
using testing::ImageMessages;
using testing::PeerTrackers;
using Kind = ImageMessages::Kind;

constexpr double kPeriod = 0.025;  // [s] of wall time per image: twice real time
constexpr double kPatience = 60;   // [s]

simulator::FeatureDataset MakeFlight() {
  simulator::FeatureSimulationOptions options;
  options.trajectory.duration = 8;
  options.trajectory.motion = simulator::Motion::kFast;
  options.trajectory.rest = 1.5;
  options.trajectory.lead_in = 1;
  options.max_points = 80;
  return simulator::SimulateFeatures(options);
}

ImageMessages PointsThenLines(size_t image) {
  return {{{Kind::kPoints, image}, {Kind::kLines, image}}};
}

// The tests are consecutive parts of one run of the estimator.
class Peers : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    flight_ = std::make_unique<simulator::FeatureDataset>(MakeFlight());
    trackers_ = std::make_unique<PeerTrackers>(*flight_);
    log_ = std::make_unique<EstimatorLog>();
    trackers_->WaitForEstimator();
  }
  static void TearDownTestSuite() {
    log_.reset();
    trackers_.reset();
    flight_.reset();
  }

  void SetUp() override {
    ASSERT_TRUE(log_->NextStatus());
    log_->odometry.clear();
  }

  static void WaitUntilDone() { ASSERT_TRUE(log_->WaitUntilDone()); }

  // Root mean square distance from the truth after alignment of all poses [m].
  static double Error() {
    std::map<int64_t, Eigen::Vector3d> truth;
    for (const FrameState& state : flight_->truth) truth[state.t_ns] = state.position();
    const auto count = static_cast<Eigen::Index>(log_->odometry.size());
    Eigen::Matrix3Xd estimate(3, count), expected(3, count);
    for (Eigen::Index i = 0; i < count; ++i) {
      const nav_msgs::Odometry& odometry = log_->odometry[i];
      const auto& p = odometry.pose.pose.position;
      estimate.col(i) = Eigen::Vector3d(p.x, p.y, p.z);
      expected.col(i) = truth.at(ToNanoseconds(odometry.header.stamp));
    }
    const Eigen::Matrix4d T = Eigen::umeyama(estimate, expected, /*with_scaling=*/false);
    const Eigen::Matrix3Xd aligned = (T * estimate.colwise().homogeneous()).topRows<3>();
    return std::sqrt((aligned - expected).squaredNorm() / static_cast<double>(count));
  }

  static bool TimeRunsForward() {
    return std::is_sorted(log_->odometry.begin(), log_->odometry.end(),
                          [](const nav_msgs::Odometry& a, const nav_msgs::Odometry& b) {
                            return a.header.stamp < b.header.stamp;
                          });
  }

  static std::unique_ptr<simulator::FeatureDataset> flight_;
  static std::unique_ptr<PeerTrackers> trackers_;
  static std::unique_ptr<EstimatorLog> log_;
};
std::unique_ptr<simulator::FeatureDataset> Peers::flight_;
std::unique_ptr<PeerTrackers> Peers::trackers_;
std::unique_ptr<EstimatorLog> Peers::log_;

// VINS-Mono's tracker does not publish the first image, which has no velocities.
TEST_F(Peers, OfVinsMonoWork) {
  trackers_->Play(1, trackers_->images(), kPeriod, PointsThenLines);
  WaitUntilDone();
  EXPECT_GT(log_->odometry.size(), 0.8 * static_cast<double>(trackers_->images()));
  EXPECT_LT(Error(), 0.03);
  EXPECT_TRUE(TimeRunsForward());
  EXPECT_EQ(log_->Count("feature_messages_malformed"), 0);
  EXPECT_EQ(log_->Count("resets"), 0);
  EXPECT_LE(log_->Count("frames_without_lines"), 3);
  EXPECT_GT(log_->Count("lines_in_window"), 10);
}

// The recording restarts with an announcement; lines are up to three images late, some messages are
// missing.
TEST_F(Peers, MayBeLateOutOfStepAndIncomplete) {
  trackers_->PublishRestart();
  std::mt19937 random(1);
  size_t images_with_points = 0;
  trackers_->Play(0, trackers_->images(), kPeriod, [&](size_t image) {
    ImageMessages all;
    const size_t lag = random() % 4;
    const bool lines_come = image >= lag && random() % 5 != 0;
    const bool lines_first = random() % 2 == 0;
    if (lines_come && lines_first) all.messages.push_back({Kind::kLines, image - lag});
    if (random() % 10 != 0) {
      all.messages.push_back({Kind::kPoints, image});
      ++images_with_points;
    }
    if (lines_come && !lines_first) all.messages.push_back({Kind::kLines, image - lag});
    return all;
  });
  WaitUntilDone();
  EXPECT_EQ(log_->Count("resets"), 1);
  EXPECT_EQ(log_->Value("last_restart"), "requested on /feature_tracker/restart");
  EXPECT_GT(log_->odometry.size(), 0.7 * static_cast<double>(images_with_points));
  EXPECT_LT(Error(), 0.05);
  EXPECT_TRUE(TimeRunsForward());
}

TEST_F(Peers, OfPlVinsSendNoVelocities) {
  trackers_->PublishRestart();
  trackers_->Play(0, trackers_->images(), kPeriod, [](size_t image) {
    ImageMessages without = PointsThenLines(image);
    without.with_velocities = false;
    return without;
  });
  WaitUntilDone();
  EXPECT_GT(log_->odometry.size(), 0.7 * static_cast<double>(trackers_->images()));
  EXPECT_LT(Error(), 0.05);
  EXPECT_EQ(log_->Count("feature_messages_malformed"), 0);
}

// Arbitrary timestamps, duplicate ids, and invalid numbers.
TEST_F(Peers, MaySendGarbageWithoutHarm) {
  ros::NodeHandle node;
  ros::Publisher imu = node.advertise<sensor_msgs::Imu>("/imu0", 10);
  ros::Publisher points = node.advertise<sensor_msgs::PointCloud>("/feature_tracker/feature", 10);
  testing::SpinUntil(kPatience,
                     [&] { return points.getNumSubscribers() > 0 && imu.getNumSubscribers() > 0; });
  trackers_->PublishRestart();
  sensor_msgs::Imu sample;
  sample.angular_velocity.x = 0.1;
  trackers_->Play(0, trackers_->images(), kPeriod, [&](size_t image) {
    if (image == 60 || image == 80) {
      sample.header.stamp = ros::Time(4'294'967'295, 0);
      imu.publish(sample);
      sensor_msgs::PointCloud twice = PeerTrackers::ToVinsMono(flight_->points[image - 1]);
      twice.header.stamp = sample.header.stamp;
      points.publish(twice);
      for (float& id : twice.channels[0].values) id = twice.channels[0].values[0];
      twice.points[0].x = std::numeric_limits<float>::quiet_NaN();
      twice.header.stamp = ros::Time(0, 1);
      points.publish(twice);
    }
    return PointsThenLines(image);
  });
  WaitUntilDone();
  EXPECT_GT(log_->odometry.size(), 0.7 * static_cast<double>(trackers_->images()));
  EXPECT_GT(log_->Count("features_impossible"), 50);
  EXPECT_EQ(log_->Count("internal_errors"), 0);
  EXPECT_GE(log_->Count("frames_ahead_of_time"), 1);
}

TEST_F(Peers, WithAnotherLayoutAreRejectedWithoutHarm) {
  const int64_t frames = log_->Count("frames");
  ros::NodeHandle node;
  ros::Publisher points = node.advertise<sensor_msgs::PointCloud>("/feature_tracker/feature", 10);
  testing::SpinUntil(kPatience, [&] { return points.getNumSubscribers() > 0; });
  sensor_msgs::PointCloud message = PeerTrackers::ToVinsMono(flight_->points.back());
  message.channels.resize(2);
  points.publish(message);
  EXPECT_TRUE(log_->WaitForStatus(kPatience, [](const EstimatorLog& log) {
    return log.Count("feature_messages_malformed") == 1;
  }));
  EXPECT_EQ(log_->Count("frames"), frames);
}

}  // namespace
}  // namespace plm_vins
