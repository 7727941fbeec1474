// SPDX-License-Identifier: BSD-3-Clause
// Images on their way to the callback. Run by image_subscription.test.
#include "common/ros/image_subscription.h"

#include <gtest/gtest.h>
#include <sensor_msgs/Image.h>

#include <vector>

#include "common/ros/geometry_conversion.h"
#include "test/ros/estimator_log.h"

namespace plm_vins {
namespace {

constexpr double kPatience = 10;  // [s]

// An image whose encoding is unknown cannot be decoded, so that an attempt would be counted.
TEST(ImageSubscriptionTest, DoesNotDecodeImagesThatAreNotNeeded) {
  ros::NodeHandle node;
  const ros::Publisher publisher = node.advertise<sensor_msgs::Image>("image", 10);
  std::vector<std::optional<ImageSample>> images;
  ImageSubscription subscription;
  subscription.Subscribe(
      node, ros::NodeHandle("~"), "image", 10,
      [&](std::optional<ImageSample> image) { images.push_back(std::move(image)); },
      [](int64_t t_ns) { return t_ns > 1'000'000; });
  ASSERT_TRUE(testing::SpinUntil(kPatience, [&] { return publisher.getNumSubscribers() == 1; }));
  for (const int64_t t_ns : {1'000'000, 2'000'000}) {
    sensor_msgs::Image message;
    message.header.stamp = ToRosTime(t_ns);
    message.encoding = "unknown";
    publisher.publish(message);
  }
  ASSERT_TRUE(testing::SpinUntil(kPatience, [&] { return images.size() == 2; }));
  ASSERT_TRUE(images[0]);
  EXPECT_EQ(images[0]->t_ns, 1'000'000);
  EXPECT_TRUE(images[0]->gray.empty());
  EXPECT_FALSE(images[1]);
  EXPECT_EQ(subscription.unreadable().count, 1);
}

}  // namespace
}  // namespace plm_vins
