// SPDX-License-Identifier: BSD-3-Clause
#include "simulator/recording/recorder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rosbag/bag.h>
#include <rosbag/view.h>
#include <sys/resource.h>

#include <csignal>
#include <filesystem>
#include <map>

#include "common/ros/geometry_conversion.h"
#include "common/ros/image_conversion.h"
#include "common/ros/msg_conversion.h"
#include "test/testing/message_of.h"

namespace plm_vins::simulator {
namespace {

constexpr int64_t kStart = 1'600'000'000'000'000'000;

// Limits the size of files during its lifetime, like a full disk.
class FileSizeLimit {
 public:
  explicit FileSizeLimit(rlim_t bytes) : handler_(std::signal(SIGXFSZ, SIG_IGN)) {
    getrlimit(RLIMIT_FSIZE, &before_);
    const rlimit limit = {bytes, before_.rlim_max};
    setrlimit(RLIMIT_FSIZE, &limit);
  }
  ~FileSizeLimit() {
    setrlimit(RLIMIT_FSIZE, &before_);
    std::signal(SIGXFSZ, handler_);
  }

 private:
  rlimit before_ = {};
  sighandler_t handler_;
};

// The destructor of a bag throws if the disk is full, which would abort the program. Buffered data
// may fail only at the end.
TEST(BagRecorder, NoticesAFullDisk) {
  const std::string file = ::testing::TempDir() + "plm_vins_bag_too_large.bag";
  for (const rlim_t limit : {4200, 100'000}) {
    const auto recorder = MakeBagRecorder(file, SensorConfig());
    const FileSizeLimit full(limit);
    EXPECT_THROW(
        {
          for (int i = 0; i < 5; ++i) {
            recorder->WriteImage(0, ImageSample{kStart + i, cv::Mat1b(100, 300, uchar(77))});
          }
          recorder->Finish();
        },
        std::runtime_error)
        << limit;
  }
  std::filesystem::remove(file);
}

TEST(BagRecorder, WritesTheTopicsOfTheConfiguration) {
  const std::string file = ::testing::TempDir() + "plm_vins_bag_recorder_test.bag";
  SensorConfig sensors;
  sensors.cameras[0].image_topic = "camera/image";
  sensors.imu_topic = "camera/imu";
  const auto recorder = MakeBagRecorder(file, sensors);
  recorder->Write(ImuSample{kStart, {0.1, 0.2, 0.3}, {1, 2, 9.8}});
  recorder->WriteImage(0, ImageSample{kStart + 5'000'000, cv::Mat1b(6, 8, uchar(77))});
  recorder->Write(ImuSample{kStart + 7'000'000, {0.4, 0.5, 0.6}, {1, 2, 9.9}});
  recorder->Finish();
  {
    rosbag::Bag bag(file);
    std::vector<ImuSample> imu;
    std::vector<ImageSample> images;
    for (const rosbag::MessageInstance& message : rosbag::View(bag)) {
      if (message.getTopic() == "/camera/imu") {
        imu.push_back(ToImuSample(*message.instantiate<sensor_msgs::Imu>()));
      } else if (message.getTopic() == "/camera/image") {
        images.push_back(ToImageSample(*message.instantiate<sensor_msgs::Image>()));
      }
    }
    ASSERT_EQ(imu.size(), 2u);
    ASSERT_EQ(images.size(), 1u);
    EXPECT_EQ(imu[1].t_ns, kStart + 7'000'000);
    EXPECT_EQ(imu[1].gyro, Eigen::Vector3d(0.4, 0.5, 0.6));
    EXPECT_EQ(images[0].t_ns, kStart + 5'000'000);
    EXPECT_EQ(images[0].gray.at<uchar>(5, 7), 77);
  }
  std::filesystem::remove(file);
}

TEST(BagRecorder, WritesTheSecondCameraAndDepth) {
  const std::string file = ::testing::TempDir() + "plm_vins_bag_second_camera.bag";
  SensorConfig sensors;
  sensors.cameras.emplace_back().image_topic = "camera/right";
  sensors.depth.emplace().topic = "camera/depth";
  const auto recorder = MakeBagRecorder(file, sensors);
  recorder->WriteImage(1, ImageSample{kStart, cv::Mat1b(6, 8, uchar(77))});
  recorder->WriteDepth(kStart, cv::Mat1w(6, 8, ushort(5432)));
  recorder->Finish();
  {
    rosbag::Bag bag(file);
    std::map<std::string, sensor_msgs::ImageConstPtr> images;
    for (const rosbag::MessageInstance& message : rosbag::View(bag)) {
      images[message.getTopic()] = message.instantiate<sensor_msgs::Image>();
    }
    ASSERT_EQ(images.size(), 2u);
    EXPECT_EQ(images["/camera/right"]->encoding, "mono8");
    EXPECT_EQ(images["/camera/right"]->data[0], 77);
    const sensor_msgs::Image& depth = *images["/camera/depth"];
    EXPECT_EQ(depth.encoding, "16UC1");
    EXPECT_EQ(depth.data[0] + 256 * depth.data[1], 5432);
    EXPECT_EQ(ToNanoseconds(depth.header.stamp), kStart);
  }
  std::filesystem::remove(file);
}

TEST(BagRecorder, ErrorNamesTheFile) {
  EXPECT_THAT(testing::MessageOf([] { MakeBagRecorder("/nowhere/a.bag", SensorConfig()); }),
              ::testing::HasSubstr("/nowhere/a.bag"));
}

}  // namespace
}  // namespace plm_vins::simulator
