// SPDX-License-Identifier: BSD-3-Clause
// The pose graph's node with keyframes of ended worlds, with missing or compressed images, and with
// displays that are opened later. Run by pose_graph.test.
#include <diagnostic_msgs/DiagnosticArray.h>
#include <gtest/gtest.h>
#include <nav_msgs/Path.h>
#include <std_srvs/Trigger.h>

#include <cstdlib>
#include <map>
#include <memory>
#include <string>
#include <utility>

#include "test/ros/keyframe_source.h"

namespace plm_vins {
namespace {

using testing::Camera;
using testing::KeyframeSource;
using testing::SpinUntil;

constexpr double kPatience = 20;  // [s]

// Keeps the newest message of a topic.
template <typename Message>
class Newest {
 public:
  explicit Newest(const std::string& topic)
      : subscriber_(ros::NodeHandle().subscribe<Message>(
            topic, 1000, [this](const boost::shared_ptr<const Message>& message) {
              message_ = message;
              ++count_;
            })) {}

  const Message* operator->() const { return message_.get(); }
  bool has() const { return message_ != nullptr; }
  int count() const { return count_; }
  void Forget() {
    message_.reset();
    count_ = 0;
  }
  bool WaitForPublisher() const {
    return SpinUntil(kPatience, [&] { return subscriber_.getNumPublishers() > 0; });
  }

 private:
  boost::shared_ptr<const Message> message_;
  int count_ = 0;
  ros::Subscriber subscriber_;
};

// The last diagnostics of a node, by key; its text is "message".
class Status {
 public:
  explicit Status(std::string name) : name_(std::move(name)) {}

  // Waits until the value contains the text.
  bool WaitFor(const std::string& key, const std::string& text) {
    return SpinUntil(kPatience, [&] { return values_[key].find(text) != std::string::npos; });
  }
  const std::string& Value(const std::string& key) { return values_[key]; }

  // Waits for the current count, since the next status may have been in transit already.
  int Count(const std::string& key) {
    const int seen = statuses_;
    EXPECT_TRUE(SpinUntil(kPatience, [&] { return statuses_ >= seen + 2; }));
    return std::atoi(Value(key).c_str());
  }

 private:
  void Add(const diagnostic_msgs::DiagnosticArray& array) {
    for (const auto& status : array.status) {
      if (status.name != name_) continue;
      values_ = {{"message", status.message}};
      for (const auto& value : status.values) values_[value.key] = value.value;
      ++statuses_;
    }
  }

  std::string name_;
  int statuses_ = 0;
  std::map<std::string, std::string> values_;
  ros::Subscriber subscriber_ =
      ros::NodeHandle().subscribe("/diagnostics", 100, &Status::Add, this);
};

bool Reset(const std::string& node) {
  std_srvs::Trigger reset;
  return ros::service::waitForService(node + "/reset", ros::Duration(kPatience)) &&
         ros::service::call(node + "/reset", reset) && reset.response.success;
}

cv::Mat Blank() { return {480, 752, CV_8UC1, cv::Scalar(100)}; }

// An image with many corners, which takes long to describe.
cv::Mat Noise() {
  cv::Mat noise(480, 752, CV_8UC1);
  cv::randu(noise, 0, 256);
  return noise;
}

class PoseGraphNodeTest : public ::testing::Test {
 protected:
  void SetUp() override {
    Start();
    ASSERT_TRUE(camera_.WaitForSubscriber() && path_.WaitForPublisher() &&
                in_map_.WaitForPublisher());
    estimator_->PublishPose(KeyframeSource::Pose(0));
    EXPECT_EQ(CountInMap(0.3), 0);
    ASSERT_TRUE(Reset("/pose_graph"));
  }

  // Replaces the estimator by a new one.
  void Start() {
    estimator_.reset();
    estimator_ = std::make_unique<KeyframeSource>("/vins_estimator/");
    ASSERT_TRUE(estimator_->WaitForSubscriber());
  }

  // Publishes keyframes from `begin` to before `end` and waits until the node has the last one.
  void Fly(int begin, int end) {
    for (int i = begin; i < end; ++i) {
      estimator_->Publish(i, camera_, Blank());
      ros::WallDuration(0.02).sleep();
    }
    ASSERT_TRUE(WaitForKeyframe(end - 1)) << status_.Value("message");
  }

  // Ends the current world, the `worlds`-th, and waits until the node has noticed.
  void Restart(int worlds) {
    estimator_->PublishRestart();
    ASSERT_TRUE(status_.WaitFor("worlds", std::to_string(worlds + 1)));
  }

  bool WaitForKeyframe(int number) {
    return SpinUntil(kPatience, [&] {
      return path_.has() && path_->header.stamp == KeyframeSource::Stamp(number);
    });
  }

  // Counts odometry messages in the map during this time.
  int CountInMap(double seconds) {
    in_map_.Forget();
    SpinUntil(seconds, [&] {
      estimator_->PublishOdometry(50);
      return false;
    });
    return in_map_.count();
  }

  Camera camera_{"raw"};
  std::unique_ptr<KeyframeSource> estimator_;
  Newest<nav_msgs::Path> path_{"/pose_graph/path"};
  Newest<nav_msgs::Odometry> in_map_{"/pose_graph/odometry"};
  Status status_{"pose_graph: map"};
};

TEST_F(PoseGraphNodeTest, OrdersKeyframesAndTransformsOdometryToTheMap) {
  Fly(0, 4);
  EXPECT_EQ(path_->poses.size(), 4u);
  EXPECT_GT(CountInMap(0.5), 0);
  EXPECT_EQ(in_map_->header.frame_id, "map");
}

// The new estimator does not announce its new world.
TEST_F(PoseGraphNodeTest, RestartedEstimatorBeginsANewWorld) {
  Fly(0, 4);
  EXPECT_GT(CountInMap(0.5), 0);
  Start();
  EXPECT_EQ(CountInMap(0.5), 0) << "by the place of the world before";
  Fly(10, 14);
  EXPECT_EQ(path_->poses.size(), 4u) << "7 or 8: joined with the world before";
  EXPECT_EQ(CountInMap(0.5), 0);
}

// A recording without odometry. The first keyframe is lost if its pose arrives after its points.
TEST_F(PoseGraphNodeTest, AnotherPublisherBeginsANewWorld) {
  Fly(0, 4);
  Start();
  Fly(10, 14);
  EXPECT_GE(path_->poses.size(), 3u);
  EXPECT_LE(path_->poses.size(), 4u) << "joined with the world before";
}

TEST_F(PoseGraphNodeTest, RestartMessageBeginsANewWorld) {
  Fly(0, 4);
  Restart(status_.Count("worlds"));
  Fly(10, 14);
  EXPECT_EQ(path_->poses.size(), 4u);
  EXPECT_EQ(CountInMap(0.5), 0);
}

TEST_F(PoseGraphNodeTest, KeyframesOfThePreviousWorldDoNotLocateANewOne) {
  const int worlds = status_.Count("worlds");
  const cv::Mat noise = Noise();
  for (int i = 0; i < 40; ++i) estimator_->Publish(i, camera_, noise);
  ASSERT_TRUE(SpinUntil(kPatience, [&] { return path_.has() && !path_->poses.empty(); }));
  Restart(worlds);  // while keyframes of the previous world wait
  EXPECT_EQ(CountInMap(1.5), 0);
}

TEST_F(PoseGraphNodeTest, ResetDropsIncompleteKeyframes) {
  camera_.Publish(KeyframeSource::Stamp(0), Blank());
  estimator_->PublishPoints(0);
  estimator_->PublishPose(KeyframeSource::Pose(0));
  ros::WallDuration(0.3).sleep();
  ASSERT_TRUE(Reset("/pose_graph"));
  estimator_->PublishLines(0);
  Fly(1, 3);
  EXPECT_EQ(path_->poses.size(), 2u);
  EXPECT_GT(CountInMap(0.5), 0) << "the map is that of the odometry";
}

TEST_F(PoseGraphNodeTest, ReportsKeyframesWithoutImages) {
  EXPECT_TRUE(SpinUntil(kPatience, [&] {
    estimator_->PublishPose(KeyframeSource::Pose(0));
    ros::WallDuration(0.1).sleep();
    return status_.Value("message").find("no images on /cam0/image_raw") != std::string::npos;
  })) << status_.Value("message");
}

TEST_F(PoseGraphNodeTest, ReportsUnusableImages) {
  camera_.PublishDepth(KeyframeSource::Stamp(0));
  EXPECT_TRUE(status_.WaitFor("images_unreadable", "1"));
  EXPECT_EQ(status_.Value("internal_errors"), "0");
  int i = 1;
  EXPECT_TRUE(SpinUntil(kPatience, [&] {
    camera_.PublishDepth(KeyframeSource::Stamp(i++));
    estimator_->PublishPose(KeyframeSource::Pose(0));
    ros::WallDuration(0.1).sleep();
    return status_.Value("message").find("no usable images on /cam0/image_raw") !=
           std::string::npos;
  })) << status_.Value("message");
}

TEST_F(PoseGraphNodeTest, ReportsTheFullPathOfItsMap) {
  std_srvs::Trigger save;
  ASSERT_TRUE(ros::service::call("/pose_graph/save_map", save));
  const std::string& message = save.response.message;
  EXPECT_FALSE(save.response.success);
  const size_t file = message.find("; /");
  ASSERT_NE(file, std::string::npos) << message;
  EXPECT_NE(message.find("/pose_graph.plm is unchanged", file), std::string::npos) << message;
  EXPECT_EQ(message.find("/./"), std::string::npos) << message;
}

// The node runs in a namespace, and nothing subscribes to its output before.
TEST(PoseGraphOfARobot, AcceptsCompressedImagesAndLatchesItsPath) {
  const std::string node = "/robot/pose_graph";
  const Camera camera("compressed");
  const KeyframeSource estimator("/robot/vins_estimator/");
  ASSERT_TRUE(camera.WaitForSubscriber() && estimator.WaitForSubscriber());
  Status status("robot/pose_graph: map");
  for (int i = 0; i < 3; ++i) estimator.Publish(i, camera, Blank());
  ASSERT_TRUE(status.WaitFor("keyframes", "3")) << status.Value("message");
  {
    const Newest<nav_msgs::Path> path(node + "/path");
    ASSERT_TRUE(SpinUntil(kPatience, [&] { return path.has(); }));
    EXPECT_EQ(path->poses.size(), 3u);
  }
  ASSERT_TRUE(Reset(node));
  const Newest<nav_msgs::Path> path(node + "/path");
  ASSERT_TRUE(SpinUntil(kPatience, [&] { return path.has(); }));
  EXPECT_TRUE(path->poses.empty());
}

}  // namespace
}  // namespace plm_vins
