// SPDX-License-Identifier: BSD-3-Clause
// IMU samples on their way to the callback thread, which is this one. Messages published by pointer
// within a process are received at once. Run by imu_inbox.test.
#include "tracking/ros/imu_inbox.h"

#include <gtest/gtest.h>
#include <ros/callback_queue.h>

#include "common/ros/geometry_conversion.h"
#include "test/ros/estimator_log.h"

namespace plm_vins {
namespace {

constexpr double kPatience = 10;  // [s]
constexpr int64_t kStep = 5'000'000;

class ImuInboxTest : public ::testing::Test {
 protected:
  static void Connect(const ros::Publisher& publisher) {
    ASSERT_TRUE(testing::SpinUntil(kPatience, [&] { return publisher.getNumSubscribers() == 1; }));
  }

  void SetUp() override { Connect(publisher_); }

  void Publish(int count) {
    for (int i = 0; i < count; ++i) {
      const auto message = boost::make_shared<sensor_msgs::Imu>();
      message->header.stamp = ToRosTime(++published_ * kStep);
      publisher_.publish(message);
    }
  }

  // Number of notices that the callback thread has received.
  int Notices() {
    ros::getGlobalCallbackQueue()->callAvailable();
    return notices_;
  }

  int notices_ = 0;
  int64_t published_ = 0;
  ros::NodeHandle node_;
  ros::Publisher publisher_ = node_.advertise<sensor_msgs::Imu>("imu", 5000);
  ImuInbox inbox_{node_, "imu", [this] { ++notices_; }};
};

TEST_F(ImuInboxTest, GivesAllSamplesOnceInOrder) {
  Publish(7);
  const std::vector<ImuSample> samples = inbox_.Take();
  ASSERT_EQ(samples.size(), 7u);
  for (int i = 0; i < 7; ++i) EXPECT_EQ(samples[i].t_ns, (i + 1) * kStep);
  EXPECT_TRUE(inbox_.Take().empty());
}

TEST_F(ImuInboxTest, NotifiesOnlyWaitingReaders) {
  Publish(19);
  EXPECT_EQ(Notices(), 0);
}

TEST_F(ImuInboxTest, NotifiesOncePerWait) {
  ASSERT_TRUE(inbox_.WaitForNext());
  Publish(5);
  EXPECT_EQ(Notices(), 1);
}

TEST_F(ImuInboxTest, DoesNotWaitForAvailableSamples) {
  Publish(1);
  EXPECT_FALSE(inbox_.WaitForNext());
  inbox_.Take();
  EXPECT_TRUE(inbox_.WaitForNext());
}

TEST_F(ImuInboxTest, NotifiesAfterManySamples) {
  Publish(20);
  EXPECT_EQ(Notices(), 1);
}

TEST_F(ImuInboxTest, DropsTheOldestWithoutAReader) {
  Publish(2100);
  const std::vector<ImuSample> samples = inbox_.Take();
  ASSERT_EQ(samples.size(), 2000u);
  EXPECT_EQ(samples.front().t_ns, 101 * kStep);
  EXPECT_EQ(samples.back().t_ns, 2100 * kStep);
}

// Notices wait for that thread as well, and nothing else limits their number.
TEST_F(ImuInboxTest, StopsNotifyingWithoutAReader) {
  Publish(2100);
  EXPECT_EQ(Notices(), 2000 / 20);
}

TEST_F(ImuInboxTest, DoesNotNotifyAfterDestruction) {
  {
    ImuInbox other(node_, "imu_of_another", [this] { ++notices_; });
    const ros::Publisher publisher = node_.advertise<sensor_msgs::Imu>("imu_of_another", 10);
    Connect(publisher);
    ASSERT_TRUE(other.WaitForNext());
    publisher.publish(boost::make_shared<sensor_msgs::Imu>());
    ASSERT_FALSE(other.WaitForNext());
  }
  EXPECT_EQ(Notices(), 0);
}

}  // namespace
}  // namespace plm_vins
