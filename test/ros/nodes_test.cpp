// SPDX-License-Identifier: BSD-3-Clause
// Records the output of the nodes while a short bag is played, and checks it. Run by nodes.test.
#include <diagnostic_msgs/DiagnosticArray.h>
#include <gtest/gtest.h>
#include <nav_msgs/Odometry.h>
#include <nav_msgs/Path.h>
#include <ros/ros.h>
#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/Image.h>
#include <sensor_msgs/Imu.h>
#include <sensor_msgs/PointCloud.h>
#include <std_srvs/Trigger.h>
#include <tf2_ros/buffer.h>
#include <tf2_ros/transform_listener.h>
#include <visualization_msgs/Marker.h>
#include <visualization_msgs/MarkerArray.h>

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <vector>

namespace {

// All messages of a topic.
template <typename Message>
class Listener {
 public:
  explicit Listener(const std::string& topic)
      : subscriber_(ros::NodeHandle().subscribe(topic, 100000, &Listener::Add, this)) {}

  std::vector<Message> messages;

  std::vector<ros::Time> Stamps() const {
    std::vector<ros::Time> stamps;
    for (const Message& message : messages) stamps.push_back(message.header.stamp);
    return stamps;
  }

 private:
  void Add(const Message& message) { messages.push_back(message); }

  ros::Subscriber subscriber_;
};

struct Listeners {
  Listener<sensor_msgs::Image> image{"/cam0/image_raw"};
  Listener<sensor_msgs::Imu> imu{"/imu0"};
  Listener<sensor_msgs::PointCloud> feature{"/feature_tracker/feature"};
  Listener<sensor_msgs::Image> feature_img{"/feature_tracker/feature_img"};
  Listener<sensor_msgs::PointCloud> linefeature{"/linefeature_tracker/linefeature"};
  Listener<sensor_msgs::Image> linefeature_img{"/linefeature_tracker/linefeature_img"};
  Listener<nav_msgs::Odometry> odometry{"/vins_estimator/odometry"};
  Listener<nav_msgs::Odometry> imu_propagate{"/vins_estimator/imu_propagate"};
  Listener<nav_msgs::Path> path{"/vins_estimator/path"};
  Listener<nav_msgs::Odometry> camera_pose{"/vins_estimator/camera_pose"};
  Listener<nav_msgs::Odometry> extrinsic{"/vins_estimator/extrinsic"};
  Listener<sensor_msgs::CameraInfo> camera_info{"/vins_estimator/camera_info"};
  Listener<sensor_msgs::PointCloud> point_cloud{"/vins_estimator/point_cloud"};
  Listener<sensor_msgs::PointCloud> history_cloud{"/vins_estimator/history_cloud"};
  Listener<visualization_msgs::Marker> key_poses{"/vins_estimator/key_poses"};
  Listener<visualization_msgs::MarkerArray> camera_pose_visual{
      "/vins_estimator/camera_pose_visual"};
  Listener<diagnostic_msgs::DiagnosticArray> diagnostics{"/diagnostics"};
  tf2_ros::Buffer tf_buffer{ros::Duration(1000)};
  tf2_ros::TransformListener tf_listener{tf_buffer};
};

void Spin(double seconds) {
  const ros::WallTime end = ros::WallTime::now() + ros::WallDuration(seconds);
  while (ros::ok() && ros::WallTime::now() < end) {
    ros::spinOnce();
    ros::WallDuration(0.005).sleep();
  }
}

// The message and the values of a status, by key.
using Status = std::map<std::string, std::string>;

// Returns the statuses of this name, oldest first.
std::vector<Status> Statuses(const Listener<diagnostic_msgs::DiagnosticArray>& log,
                             const std::string& name) {
  std::vector<Status> statuses;
  for (const auto& array : log.messages) {
    for (const auto& status : array.status) {
      if (status.name != name || status.values.empty()) continue;  // still starting
      statuses.push_back({{"message", status.message}});
      for (const auto& value : status.values) statuses.back()[value.key] = value.value;
    }
  }
  return statuses;
}

// Returns the last status whose message begins with this text; empty if there is none.
Status LastStatus(const std::vector<Status>& statuses, const std::string& message) {
  const auto found = std::find_if(statuses.rbegin(), statuses.rend(), [&](const Status& status) {
    return status.at("message").rfind(message, 0) == 0;
  });
  return found == statuses.rend() ? Status() : *found;
}

// All tests check the same run of the nodes.
class Nodes : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    log_ = std::make_unique<Listeners>();
    for (int i = 0; i < 60 && log_->odometry.messages.empty(); ++i) Spin(1.0);
    size_t seen = 0;
    while (seen < log_->odometry.messages.size() + log_->feature.messages.size()) {
      seen = log_->odometry.messages.size() + log_->feature.messages.size();
      Spin(3.0);
    }
  }
  static void TearDownTestSuite() { log_.reset(); }

  static std::unique_ptr<Listeners> log_;
};
std::unique_ptr<Listeners> Nodes::log_;

TEST_F(Nodes, TrackEveryImage) {
  ASSERT_GT(log_->image.messages.size(), 100u);
  EXPECT_EQ(log_->feature.Stamps(), log_->image.Stamps());
  for (const auto& frame : log_->feature.messages) {
    EXPECT_GT(frame.points.size(), 20u);
  }
  EXPECT_FALSE(log_->feature_img.messages.empty());
  EXPECT_EQ(log_->feature_img.messages.back().encoding, "bgr8");
}

// VINS-Mono reads channels by position, rounds the ids, treats two points of the same id as a
// stereo pair, and aborts if z is not 1. It ignores the first message.
TEST_F(Nodes, PublishPointsInTheLayoutOfVinsMono) {
  for (const auto& frame : log_->feature.messages) {
    ASSERT_GE(frame.channels.size(), 5u);
    for (const auto& channel : frame.channels) {
      ASSERT_EQ(channel.values.size(), frame.points.size());
    }
    std::set<int> ids;
    for (size_t i = 0; i < frame.points.size(); ++i) {
      EXPECT_EQ(frame.points[i].z, 1);
      const float id = frame.channels[0].values[i];
      EXPECT_EQ(id, std::floor(id));
      EXPECT_TRUE(ids.insert(static_cast<int>(id)).second) << "twice: " << id;
      EXPECT_TRUE(frame.channels[1].values[i] >= 0 && frame.channels[1].values[i] < 752);
      EXPECT_TRUE(frame.channels[2].values[i] >= 0 && frame.channels[2].values[i] < 480);
    }
  }
}

// A slow line tracker may drop images, but only complete ones.
TEST_F(Nodes, FollowLines) {
  const std::vector<ros::Time> images = log_->image.Stamps();
  const std::vector<ros::Time> lines = log_->linefeature.Stamps();
  EXPECT_GT(2 * lines.size(), images.size());
  EXPECT_TRUE(std::includes(images.begin(), images.end(), lines.begin(), lines.end()));
  for (const auto& frame : log_->linefeature.messages) {
    ASSERT_EQ(frame.channels.size(), 3u);
    EXPECT_EQ(frame.channels[0].name, "id");
    EXPECT_EQ(frame.channels[1].name, "x_end");
    EXPECT_EQ(frame.channels[2].name, "y_end");
    EXPECT_GT(frame.points.size(), 5u);
  }
  EXPECT_FALSE(log_->linefeature_img.messages.empty());
}

TEST_F(Nodes, PublishAPoseForEveryImage) {
  const std::vector<ros::Time> images = log_->image.Stamps();
  const std::vector<ros::Time> poses = log_->odometry.Stamps();
  ASSERT_FALSE(poses.empty());
  EXPECT_LT((poses.front() - images.front()).toSec(), 4.0);
  const auto first = std::find(images.begin(), images.end(), poses.front());
  const auto missing = std::distance(first, images.end()) - static_cast<int>(poses.size());
  EXPECT_LE(missing, 1) << "only the last image may wait for an IMU sample that never comes";
  EXPECT_TRUE(std::equal(poses.begin(), poses.end(), first));
}

TEST_F(Nodes, PublishPlausiblePosesWithCovariance) {
  for (const auto& odometry : log_->odometry.messages) {
    EXPECT_EQ(odometry.header.frame_id, "world");
    EXPECT_EQ(odometry.child_frame_id, "body");
    const auto& q = odometry.pose.pose.orientation;
    EXPECT_NEAR(Eigen::Vector4d(q.x, q.y, q.z, q.w).norm(), 1.0, 1e-6);
    const Eigen::Matrix<double, 6, 6> covariance =
        Eigen::Map<const Eigen::Matrix<double, 6, 6, Eigen::RowMajor>>(
            odometry.pose.covariance.data());
    EXPECT_TRUE((covariance.llt().info() == Eigen::Success)) << covariance;
    EXPECT_GT(odometry.twist.covariance[0], 0);
  }
}

TEST_F(Nodes, PropagateAtTheRateOfTheImu) {
  ASSERT_FALSE(log_->odometry.messages.empty());
  const ros::Time first_pose = log_->odometry.Stamps().front();
  const std::vector<ros::Time> imu = log_->imu.Stamps();
  const std::vector<ros::Time> propagated = log_->imu_propagate.Stamps();
  const auto after =
      std::count_if(imu.begin(), imu.end(), [&](const ros::Time& t) { return t > first_pose; });
  EXPECT_GT(static_cast<double>(propagated.size()), 0.8 * static_cast<double>(after));
  EXPECT_TRUE(std::is_sorted(propagated.begin(), propagated.end()));
  EXPECT_GT(log_->imu_propagate.messages.back().pose.covariance[0], 0);
}

// The last image has passed long ago.
TEST_F(Nodes, LatchThePath) {
  const Listener<nav_msgs::Path> late("/vins_estimator/path");
  for (int i = 0; i < 50 && late.messages.empty(); ++i) Spin(0.1);
  ASSERT_EQ(late.messages.size(), 1u);
  EXPECT_EQ(late.messages[0].poses.size(), log_->path.messages.back().poses.size());
}

// The log does not subscribe to these, since a process has only one connection to a topic.
TEST_F(Nodes, LatchPastLines) {
  const Listener<visualization_msgs::Marker> late("/vins_estimator/history_lines_cloud");
  for (int i = 0; i < 50 && late.messages.empty(); ++i) Spin(0.1);
  Spin(0.5);  // all arrive together
  ASSERT_FALSE(late.messages.empty());
  std::set<int> ids;
  for (const auto& marker : late.messages) {
    EXPECT_FALSE(marker.points.empty());
    EXPECT_TRUE(ids.insert(marker.id).second) << marker.id;
  }
}

TEST_F(Nodes, PublishPathCameraAndMap) {
  EXPECT_FALSE(log_->path.messages.empty());
  EXPECT_FALSE(log_->key_poses.messages.empty());
  EXPECT_FALSE(log_->history_cloud.messages.empty());
  ASSERT_FALSE(log_->camera_pose_visual.messages.empty());
  EXPECT_EQ(log_->camera_pose_visual.messages.back().markers.size(), 1u);
  ASSERT_FALSE(log_->point_cloud.messages.empty());
  EXPECT_GT(log_->point_cloud.messages.back().points.size(), 10u);
  ASSERT_FALSE(log_->camera_pose.messages.empty());
  EXPECT_EQ(log_->camera_pose.messages.back().child_frame_id, "camera");
  ASSERT_FALSE(log_->extrinsic.messages.empty());
  EXPECT_NEAR(log_->extrinsic.messages.back().pose.pose.position.y, -0.0647, 0.02);
  ASSERT_FALSE(log_->camera_info.messages.empty());
  EXPECT_EQ(log_->camera_info.messages.back().header.frame_id, "camera");
  EXPECT_GT(log_->camera_info.messages.back().K[0], 100);
}

TEST_F(Nodes, PublishTransformsFromWorldToCamera) {
  ASSERT_FALSE(log_->camera_pose.messages.empty());
  const auto& camera = log_->camera_pose.messages.back();
  const auto transform = log_->tf_buffer.lookupTransform("world", "camera", camera.header.stamp);
  EXPECT_NEAR(transform.transform.translation.x, camera.pose.pose.position.x, 1e-6);
  EXPECT_TRUE(log_->tf_buffer.canTransform("world", "body", camera.header.stamp));
}

TEST_F(Nodes, ReportStateAndWhatTheyWaitFor) {
  const auto estimator = Statuses(log_->diagnostics, "vins_estimator: odometry");
  EXPECT_FALSE(LastStatus(estimator, "waiting: no messages on /imu0").empty());
  Status tracking = LastStatus(estimator, "tracking");
  ASSERT_FALSE(tracking.empty());
  EXPECT_EQ(tracking["frames_dropped_full"], "0");
  EXPECT_EQ(tracking["resets"], "0");
  EXPECT_GT(std::stoi(tracking["points_in_window"]), 10);

  const auto tracker = Statuses(log_->diagnostics, "feature_tracker: point tracking");
  EXPECT_FALSE(LastStatus(tracker, "tracking").empty());
  Status end = LastStatus(tracker, "waiting: no messages on /cam0/image_raw");
  EXPECT_EQ(end["images"], std::to_string(log_->image.messages.size()));
}

// The bag is played in its own time, which is the reference of delays.
TEST_F(Nodes, ReportRatesAndDelays) {
  const auto statuses = Statuses(log_->diagnostics, "vins_estimator: odometry");
  std::map<std::string, double> greatest;
  for (Status status : statuses) {
    for (const auto& stream : {"imu", "points", "lines", "odometry"}) {
      const std::string rate = std::string(stream) + "_rate_hz";
      ASSERT_TRUE(status.count(rate)) << rate;
      greatest[stream] = std::max(greatest[stream], std::stod(status[rate]));
    }
  }
  const double speed = ros::NodeHandle("~").param("rate", 1.0);
  EXPECT_GT(greatest["imu"], 100 * speed);
  EXPECT_GT(greatest["points"], 10 * speed);
  EXPECT_GT(greatest["lines"], 5 * speed);
  EXPECT_GT(greatest["odometry"], 10 * speed);
  Status tracking = LastStatus(statuses, "tracking");
  EXPECT_GT(std::stod(tracking["odometry_delay_ms"]), -100);
  EXPECT_LT(std::stod(tracking["odometry_delay_ms"]), 5000);
}

// Runs last, since it ends the run.
TEST_F(Nodes, SaveTheTrajectoryAndResetByService) {
  std_srvs::Trigger save;
  ASSERT_TRUE(ros::service::call("/vins_estimator/save_trajectory", save));
  EXPECT_TRUE(save.response.success) << save.response.message;
  std::string file;
  ros::param::get("/vins_estimator/trajectory_file", file);
  std::ifstream stream(file);
  const auto rows = std::count(std::istreambuf_iterator<char>(stream), {}, '\n');
  EXPECT_EQ(static_cast<size_t>(rows), log_->odometry.messages.size());

  std_srvs::Trigger reset;
  ASSERT_TRUE(ros::service::call("/vins_estimator/reset", reset));
  EXPECT_TRUE(reset.response.success);
  Spin(2.5);
  const auto statuses = Statuses(log_->diagnostics, "vins_estimator: odometry");
  EXPECT_EQ(statuses.back().at("resets"), "1");
}

}  // namespace
