// SPDX-License-Identifier: BSD-3-Clause
// Loads trackers and estimator as nodelets next to the same trackers as nodes, and sends both the
// same bag. Run by nodelets.test.
#include <gtest/gtest.h>
#include <nav_msgs/Odometry.h>
#include <nodelet/NodeletList.h>
#include <nodelet/NodeletLoad.h>
#include <nodelet/NodeletUnload.h>
#include <ros/ros.h>
#include <rosbag/bag.h>
#include <rosbag/view.h>
#include <rosgraph_msgs/Log.h>
#include <sensor_msgs/Image.h>
#include <sensor_msgs/Imu.h>
#include <sensor_msgs/PointCloud.h>

#include <algorithm>
#include <atomic>
#include <deque>
#include <filesystem>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "test/ros/estimator_log.h"

namespace plm_vins {
namespace {

using testing::SpinUntil;

constexpr double kTimeout = 20;  // [s]

// The newest features of a tracker.
struct Features {
  explicit Features(const std::string& topic)
      : subscriber(ros::NodeHandle().subscribe(topic, 1000, &Features::Add, this)) {}
  void Add(const sensor_msgs::PointCloudConstPtr& message) { newest = message; }

  bool Has(const ros::Time& stamp) const { return newest && newest->header.stamp == stamp; }

  ros::Subscriber subscriber;
  sensor_msgs::PointCloudConstPtr newest;
};

// Controls the nodelets of the manager.
class Nodelets {
 public:
  static bool Load(const std::string& name, const std::string& type) {
    nodelet::NodeletLoad load;
    load.request.name = name;
    load.request.type = type;
    return ros::service::call("/manager/load_nodelet", load) && load.response.success;
  }
  static bool Unload(const std::string& name) {
    nodelet::NodeletUnload unload;
    unload.request.name = name;
    return ros::service::call("/manager/unload_nodelet", unload) && unload.response.success;
  }
  static std::vector<std::string> List() {
    nodelet::NodeletList list;
    ros::service::call("/manager/list", list);
    std::sort(list.response.nodelets.begin(), list.response.nodelets.end());
    return list.response.nodelets;
  }
  static bool LoadAll() {
    return Load("/feature_tracker", "plm_vins/FeatureTracker") &&
           Load("/linefeature_tracker", "plm_vins/LineFeatureTracker") &&
           Load("/vins_estimator", "plm_vins/VinsEstimator");
  }
  static std::vector<std::string> All() {
    return {"/feature_tracker", "/linefeature_tracker", "/vins_estimator"};
  }
};

// Publishes the messages of the bag, image by image.
class Feed {
 public:
  explicit Feed(const std::string& file) : bag_(file), view_(bag_), next_(view_.begin()) {}

  bool WaitForSubscribers(uint32_t count) const {
    return SpinUntil(kTimeout, [&] {
      return images_.getNumSubscribers() == count && imu_.getNumSubscribers() == count;
    });
  }

  // Publishes an image after IMU samples that extend beyond it. Returns its timestamp.
  ros::Time PublishImage() {
    constexpr size_t kSamplesBeyond = 4;
    size_t beyond = 0;
    while (waiting_.empty() || beyond < kSamplesBeyond) {
      if (const auto image = next_->instantiate<sensor_msgs::Image>()) {
        waiting_.push_back(image);
      } else if (const auto sample = next_->instantiate<sensor_msgs::Imu>()) {
        imu_.publish(sample);
        if (!waiting_.empty() && sample->header.stamp > waiting_.front()->header.stamp) ++beyond;
      }
      ++next_;
    }
    const sensor_msgs::ImageConstPtr image = waiting_.front();
    waiting_.pop_front();
    images_.publish(image);
    return image->header.stamp;
  }

  void Publish(const sensor_msgs::Image& image) { images_.publish(image); }

 private:
  rosbag::Bag bag_;
  rosbag::View view_;
  rosbag::View::iterator next_;
  std::deque<sensor_msgs::ImageConstPtr> waiting_;
  ros::NodeHandle node_;
  ros::Publisher images_ = node_.advertise<sensor_msgs::Image>("/cam0/image_raw", 100);
  ros::Publisher imu_ = node_.advertise<sensor_msgs::Imu>("/imu0", 1000);
};

class OurNodelets : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    const ros::NodeHandle parameters("~");
    const auto config = parameters.param<std::string>("config_file", "");
    for (const std::string& name : Nodelets::All()) ros::param::set(name + "/config_file", config);
    ros::param::set("/vins_estimator/trajectory_file", TrajectoryFile());
    feed_ = std::make_unique<Feed>(parameters.param<std::string>("bag", ""));
    are_loaded_ = ros::service::waitForService("/manager/load_nodelet", ros::Duration(kTimeout)) &&
                  Nodelets::LoadAll() && feed_->WaitForSubscribers(kProcesses);
  }
  static void TearDownTestSuite() { feed_.reset(); }

  // Asserted here, since failures in SetUpTestSuite() only skip the tests, which rostest counts as
  // success.
  void SetUp() override { ASSERT_TRUE(are_loaded_) << "the nodelets do not receive anything"; }

  static std::string TrajectoryFile() {
    return ros::param::param<std::string>("~output", ".") + "/nodelets_trajectory.tum";
  }

  // Images and IMU samples are sent to the manager, once for all nodelets, and to the two nodes.
  static constexpr uint32_t kProcesses = 3;
  static std::unique_ptr<Feed> feed_;
  static bool are_loaded_;
};
std::unique_ptr<Feed> OurNodelets::feed_;
bool OurNodelets::are_loaded_ = false;

TEST_F(OurNodelets, GiveTheSameFeaturesAsTheNodes) {
  const Features points("/feature_tracker/feature");
  const Features node_points("/nodes/feature_tracker/feature");
  const Features lines("/linefeature_tracker/linefeature");
  const Features node_lines("/nodes/linefeature_tracker/linefeature");
  ASSERT_TRUE(SpinUntil(kTimeout, [&] {
    return points.subscriber.getNumPublishers() && node_points.subscriber.getNumPublishers() &&
           lines.subscriber.getNumPublishers() && node_lines.subscriber.getNumPublishers();
  }));
  for (int i = 0; i < 40; ++i) {
    const ros::Time stamp = feed_->PublishImage();
    ASSERT_TRUE(SpinUntil(kTimeout,
                          [&] {
                            return points.Has(stamp) && node_points.Has(stamp) &&
                                   lines.Has(stamp) && node_lines.Has(stamp);
                          }))
        << "image " << i;
    EXPECT_EQ(points.newest->points, node_points.newest->points) << "image " << i;
    EXPECT_EQ(points.newest->channels, node_points.newest->channels) << "image " << i;
    EXPECT_EQ(lines.newest->points, node_lines.newest->points) << "image " << i;
    EXPECT_EQ(lines.newest->channels, node_lines.newest->channels) << "image " << i;
  }
  EXPECT_GT(points.newest->points.size(), 50U);
  EXPECT_GT(lines.newest->points.size(), 5U);
}

// The images of the previous test suffice for the initialization.
TEST_F(OurNodelets, EstimateAndSaveWhatTheyHaveWhenUnloaded) {
  std::filesystem::remove(TrajectoryFile());
  nav_msgs::Odometry newest;
  const ros::Subscriber subscriber = ros::NodeHandle().subscribe<nav_msgs::Odometry>(
      "/vins_estimator/odometry", 100, [&](const auto& message) { newest = *message; });
  ASSERT_TRUE(SpinUntil(kTimeout, [&] { return subscriber.getNumPublishers() > 0; }));
  const ros::Time stamp = feed_->PublishImage();
  EXPECT_TRUE(SpinUntil(kTimeout, [&] { return newest.header.stamp == stamp; }));
  EXPECT_TRUE(Nodelets::Unload("/vins_estimator"));
  EXPECT_GT(std::filesystem::file_size(TrajectoryFile()), 100U);
  EXPECT_TRUE(Nodelets::Load("/vins_estimator", "plm_vins/VinsEstimator"));
}

TEST_F(OurNodelets, ReportUnderTheirOwnNames) {
  std::string names;
  const auto add_names = [&](const diagnostic_msgs::DiagnosticArray& array) {
    for (const auto& status : array.status) names += status.name + "\n";
  };
  const ros::Subscriber subscriber = ros::NodeHandle().subscribe<diagnostic_msgs::DiagnosticArray>(
      "/diagnostics", 100, [&](const auto& array) { add_names(*array); });
  for (const std::string name :
       {"\nfeature_tracker: point tracking\n", "\nlinefeature_tracker: line tracking\n",
        "\nvins_estimator: odometry\n"}) {
    EXPECT_TRUE(SpinUntil(kTimeout, [&] { return ("\n" + names).find(name) != std::string::npos; }))
        << name << " is not among\n"
        << names;
  }
}

// Images with an unknown encoding, with a size beyond their data and any memory, and of another
// time.
TEST_F(OurNodelets, ContinueAfterImpossibleImages) {
  const Features points("/feature_tracker/feature");
  const Features node_lines("/nodes/linefeature_tracker/linefeature");
  ASSERT_TRUE(SpinUntil(kTimeout, [&] {
    return points.subscriber.getNumPublishers() && node_lines.subscriber.getNumPublishers();
  }));
  sensor_msgs::Image image;
  image.header.stamp = feed_->PublishImage() + ros::Duration(1e-3);
  image.encoding = "secret";
  image.width = image.height = image.step = 4;
  image.data.resize(16);
  feed_->Publish(image);
  image.encoding = "mono8";
  image.width = image.height = image.step = 4'294'967'295;
  feed_->Publish(image);
  image.width = image.height = image.step = 4;
  image.header.stamp = ros::Time(4'294'967'295, 0);
  feed_->Publish(image);
  const ros::Time stamp = feed_->PublishImage();
  EXPECT_TRUE(SpinUntil(kTimeout, [&] { return points.Has(stamp) && node_lines.Has(stamp); }));
}

TEST_F(OurNodelets, AreUnloadedWhileImagesArriveAndLoadedAgain) {
  std::atomic<bool> stop = false;
  std::thread images([&] {
    for (int i = 0; i < 80 && !stop; ++i) {  // the bag has twice as many
      feed_->PublishImage();
      ros::WallDuration(0.03).sleep();
    }
  });
  for (int i = 0; i < 4; ++i) {
    ros::WallDuration(0.1).sleep();
    for (const std::string& name : Nodelets::All()) EXPECT_TRUE(Nodelets::Unload(name));
    EXPECT_TRUE(Nodelets::LoadAll());
  }
  stop = true;
  images.join();
  EXPECT_EQ(Nodelets::List(), Nodelets::All());

  ASSERT_TRUE(feed_->WaitForSubscribers(kProcesses));
  const Features points("/feature_tracker/feature");
  ASSERT_TRUE(SpinUntil(kTimeout, [&] { return points.subscriber.getNumPublishers() > 0; }));
  const ros::Time stamp = feed_->PublishImage();
  EXPECT_TRUE(SpinUntil(kTimeout, [&] { return points.Has(stamp); }));
}

TEST_F(OurNodelets, ReportAFaultyConfigurationAndAreNotLoaded) {
  std::string log;
  const ros::Subscriber subscriber = ros::NodeHandle().subscribe<rosgraph_msgs::Log>(
      "/rosout", 1000, [&](const rosgraph_msgs::LogConstPtr& line) {
        if (line->level == rosgraph_msgs::Log::FATAL) log += line->msg + "\n";
      });
  ASSERT_TRUE(SpinUntil(kTimeout, [&] { return subscriber.getNumPublishers() >= kProcesses; }));
  ros::param::set("/faulty/config_file", "/no/such/file.yaml");
  EXPECT_FALSE(Nodelets::Load("/faulty", "plm_vins/FeatureTracker"));
  EXPECT_FALSE(Nodelets::Load("/without_file", "plm_vins/LineFeatureTracker"));
  const auto says = [&](const char* text) {
    return SpinUntil(kTimeout, [&] { return log.find(text) != std::string::npos; });
  };
  EXPECT_TRUE(says("/no/such/file.yaml")) << log;
  EXPECT_TRUE(says("/without_file/config_file")) << log;
  EXPECT_EQ(Nodelets::List(), Nodelets::All()) << "the others go on";
}

// Invalid ROS names, and a topic that the manager knows with another type.
TEST_F(OurNodelets, ContinueIfAnotherNodeletCannotSubscribe) {
  std::string log;
  const ros::Subscriber subscriber = ros::NodeHandle().subscribe<rosgraph_msgs::Log>(
      "/rosout", 1000, [&](const rosgraph_msgs::LogConstPtr& line) { log += line->msg + "\n"; });
  ASSERT_TRUE(SpinUntil(kTimeout, [&] { return subscriber.getNumPublishers() >= kProcesses; }));
  ros::param::set("/graph/config_file", ros::param::param<std::string>("~config_file", ""));
  ros::param::set("/graph/set/imu_topic", "/another_imu");
  ros::param::set("/graph/set/loop_closure", "1");
  for (const std::string topic : {"/cam-0", "~private", "/imu0"}) {
    ros::param::set("/graph/set/image_topic", topic);
    EXPECT_FALSE(Nodelets::Load("/graph", "plm_vins/PoseGraph")) << topic;
    EXPECT_EQ(Nodelets::List(), Nodelets::All()) << topic;
  }
  EXPECT_TRUE(SpinUntil(kTimeout, [&] {
    return log.find("image_topic: \"/cam-0\" is not a valid topic name") != std::string::npos;
  })) << log;
  ros::param::del("/graph/set/imu_topic");
  ros::param::del("/graph/set/image_topic");
  EXPECT_TRUE(Nodelets::Load("/graph", "plm_vins/PoseGraph"));
  EXPECT_TRUE(Nodelets::Unload("/graph"));
}

}  // namespace
}  // namespace plm_vins
