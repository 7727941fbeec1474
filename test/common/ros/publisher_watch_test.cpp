// SPDX-License-Identifier: BSD-3-Clause
#include "common/ros/publisher_watch.h"

#include <gtest/gtest.h>

#include <boost/make_shared.hpp>

namespace plm_vins {
namespace {

boost::shared_ptr<ros::M_string> Connect() { return boost::make_shared<ros::M_string>(); }

TEST(PublisherWatch, DetectsANewConnection) {
  PublisherWatch watch(1);
  const auto first = Connect();
  const auto second = Connect();
  EXPECT_FALSE(watch.HasChanged(0, first)) << "there was none before";
  EXPECT_FALSE(watch.HasChanged(0, first));
  EXPECT_TRUE(watch.HasChanged(0, second));
  EXPECT_FALSE(watch.HasChanged(0, second));
}

TEST(PublisherWatch, ReportsANewProcessOnceOnAnyTopic) {
  PublisherWatch watch(2);
  EXPECT_FALSE(watch.HasChanged(0, Connect()));
  EXPECT_FALSE(watch.HasChanged(1, Connect()));
  for (const size_t first : {0, 1, 1, 0}) {
    EXPECT_TRUE(watch.HasChanged(first, Connect()));
    EXPECT_FALSE(watch.HasChanged(1 - first, Connect()));
  }
}

TEST(PublisherWatch, DetectsANewProcessAfterAReconnection) {
  PublisherWatch watch(2);
  const auto keyframes = Connect();
  EXPECT_FALSE(watch.HasChanged(0, Connect()));
  EXPECT_FALSE(watch.HasChanged(1, keyframes));
  EXPECT_TRUE(watch.HasChanged(0, Connect())) << "cannot be told from another process";
  EXPECT_FALSE(watch.HasChanged(1, keyframes));
  EXPECT_TRUE(watch.HasChanged(1, Connect()));
  EXPECT_FALSE(watch.HasChanged(0, Connect()));
}

TEST(PublisherWatch, DetectsAProcessThatPublishesOneTopicOnly) {
  PublisherWatch watch(2);
  EXPECT_FALSE(watch.HasChanged(0, Connect()));
  for (int i = 0; i < 3; ++i) EXPECT_TRUE(watch.HasChanged(0, Connect()));
  EXPECT_FALSE(watch.HasChanged(1, Connect()));
  EXPECT_TRUE(watch.HasChanged(1, Connect()));
}

TEST(TurnsWatch, DistinguishesAlternationFromRestarts) {
  TurnsWatch starts;
  for (const double t : {0.0, 2.0, 2.6, 4.0, 5.5}) EXPECT_FALSE(starts.AddChange(t)) << t;
  TurnsWatch turns;
  for (const double t : {0.0, 0.05}) EXPECT_FALSE(turns.AddChange(t));
  for (const double t : {0.1, 0.15, 0.2}) EXPECT_TRUE(turns.AddChange(t));
}

}  // namespace
}  // namespace plm_vins
