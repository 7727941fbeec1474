// SPDX-License-Identifier: BSD-3-Clause
#include "tracking/image_queue.h"

#include <gtest/gtest.h>

#include <optional>
#include <vector>

#include "common/geometry/so3.h"
#include "test/testing/still_scene.h"

namespace plm_vins {
namespace {

using testing::StillConfig;
using testing::StillImu;
using testing::StillPicture;

constexpr int64_t kMillisecond = 1'000'000;
constexpr int64_t kStart = 1403636579763555584;

class ImageQueueTest : public ::testing::Test {
 protected:
  void AddImage(int milliseconds) { AddImage(milliseconds, picture_); }
  void AddImage(int milliseconds, const cv::Mat& picture) {
    queue_.AddImage(0, {kStart + milliseconds * kMillisecond, picture});
  }

  // Adds IMU samples every 5 ms.
  void AddImu(int from, int to, const Eigen::Vector3d& gyro = Eigen::Vector3d::Zero()) {
    for (int t = from; t <= to; t += 5) {
      ImuSample sample = StillImu(kStart + t * kMillisecond);
      sample.gyro = gyro;
      queue_.AddImu(sample);
    }
  }

  // Returns the timestamps of ready images [ms].
  std::vector<int> Pop() {
    return Take([this] { return queue_.Pop(); });
  }
  std::vector<int> Flush() {
    return Take([this] { return queue_.Flush(); });
  }

  template <typename Next>
  std::vector<int> Take(const Next& next) {
    std::vector<int> stamps;
    while (const auto ready = next()) {
      stamps.push_back(static_cast<int>((ready->images[0].t_ns - kStart) / kMillisecond));
      last_ = *ready;
    }
    return stamps;
  }

  const cv::Mat picture_ = StillPicture();
  ImageQueue queue_{StillConfig()};
  ReadyImage last_;
};

TEST_F(ImageQueueTest, AnImageWaitsForTheGyro) {
  AddImu(-10, 40);
  AddImage(0);
  EXPECT_EQ(Pop(), (std::vector<int>{0}));
  EXPECT_FALSE(last_.R_now_then) << "there is no image before";
  AddImage(50);
  EXPECT_TRUE(Pop().empty());
  AddImu(45, 50);
  EXPECT_EQ(Pop(), (std::vector<int>{50}));
  EXPECT_TRUE(last_.R_now_then);
  EXPECT_EQ(queue_.counts().without_gyro, 0);
}

TEST_F(ImageQueueTest, GivesTheRotationSinceThePreviousImage) {
  AddImu(-10, 100, {0, 0, 1});
  AddImage(0);
  AddImage(50);
  EXPECT_EQ(Pop().size(), 2u);
  const Eigen::Vector3d turn = SO3Log(*last_.R_now_then);
  EXPECT_NEAR(turn.z(), -0.05, 1e-9) << "the image turns against the camera";
  EXPECT_NEAR(turn.norm(), 0.05, 1e-9);
}

TEST_F(ImageQueueTest, AnImageWaitsForTwoNewerOnesAtMost) {
  AddImage(0);
  AddImage(50);
  EXPECT_TRUE(Pop().empty());
  AddImage(100);
  EXPECT_EQ(Pop(), (std::vector<int>{0}));
  EXPECT_FALSE(queue_.empty());
  EXPECT_EQ(Flush(), (std::vector<int>{50, 100}));
  EXPECT_TRUE(queue_.empty());
  EXPECT_EQ(queue_.counts().without_gyro, 2);
}

// A network stalls, and then delivers the images before the IMU samples.
TEST_F(ImageQueueTest, AStallChangesNothing) {
  AddImu(-10, 0);
  AddImage(0);
  EXPECT_EQ(Pop().size(), 1u);
  for (int t = 50; t <= 500; t += 50) AddImage(t);
  EXPECT_TRUE(Pop().empty());
  AddImu(5, 500);
  EXPECT_EQ(Pop().size(), 10u);
  EXPECT_EQ(queue_.counts().without_gyro, 0);
}

TEST_F(ImageQueueTest, DropsWhatIsTooLateWhileNewerImagesWait) {
  queue_ = ImageQueue(StillConfig(), /*max_wait=*/0.5);
  AddImu(-10, 1000);
  for (int t = 0; t <= 950; t += 50) AddImage(t);
  EXPECT_EQ(Pop().front(), 500);
  EXPECT_EQ(queue_.counts().too_late, 10);
  AddImu(1005, 2000);
  AddImage(1000);
  EXPECT_EQ(Pop(), (std::vector<int>{1000})) << "there is no newer one";
  EXPECT_EQ(queue_.counts().too_late, 10);
}

TEST_F(ImageQueueTest, DropsWhatIsTooLateWithoutAGyro) {
  queue_ = ImageQueue(StillConfig(), /*max_wait=*/0.5);
  for (int t = 0; t <= 3000; t += 50) AddImage(t);
  EXPECT_EQ(Pop().front(), 2000);
  EXPECT_EQ(queue_.counts().too_late, 40);
}

TEST_F(ImageQueueTest, AGyroThatEndsDelaysNoLongerThanHalfASecondOnce) {
  AddImu(-10, 0);
  AddImage(0);
  EXPECT_EQ(Pop().size(), 1u);
  std::vector<int> delays;
  for (int t = 50; t <= 1500; t += 50) {
    AddImage(t);
    for (const int stamp : Pop()) delays.push_back(t - stamp);
  }
  ASSERT_GT(delays.size(), 10u);
  EXPECT_EQ(delays.front(), 550);
  EXPECT_EQ(delays.back(), 100);
}

TEST_F(ImageQueueTest, DropsStampsThatRepeatOrGoBack) {
  for (const int t : {0, 50, 50, 20, 100}) AddImage(t);
  EXPECT_EQ(Flush(), (std::vector<int>{0, 50, 100}));
  EXPECT_EQ(queue_.counts().images, 5);
  EXPECT_EQ(queue_.counts().out_of_order, 2);
  EXPECT_EQ(queue_.counts().restarts, 0);
}

TEST_F(ImageQueueTest, RestartsWithTheRecording) {
  for (int t = 5000; t < 5500; t += 50) AddImage(t);
  EXPECT_EQ(Flush().size(), 10u);
  EXPECT_FALSE(last_.restart);
  for (int t = 0; t < 550; t += 50) AddImage(t);  // ten are rejected, the next restarts the queue
  EXPECT_EQ(Flush(), (std::vector<int>{500}));
  EXPECT_TRUE(last_.restart);
  EXPECT_EQ(queue_.counts().restarts, 1);
  AddImu(500, 600);  // the history of the gyroscope restarts as well
  AddImage(550);
  EXPECT_EQ(Pop(), (std::vector<int>{550}));
  EXPECT_FALSE(last_.restart);
  EXPECT_TRUE(last_.R_now_then);
}

TEST_F(ImageQueueTest, DropsImagesOfAnotherSizeAndReportsTheSize) {
  AddImage(0);
  AddImage(50, StillPicture({160, 120}));
  AddImage(100, cv::Mat(240, 320, CV_8UC3));
  AddImage(150, cv::Mat());
  AddImage(200);
  EXPECT_EQ(Flush(), (std::vector<int>{0, 200}));
  EXPECT_EQ(queue_.counts().wrong_format, 3);
  EXPECT_NE(queue_.counts().wrong_format_detail.find("160"), std::string::npos)
      << queue_.counts().wrong_format_detail;
}

TEST_F(ImageQueueTest, GapDropsOneImage) {
  for (const int t : {0, 50, 1200, 1250, 1300}) AddImage(t);
  EXPECT_EQ(Flush(), (std::vector<int>{0, 50, 1250, 1300}));
  EXPECT_EQ(queue_.counts().gaps, 1);
  EXPECT_EQ(queue_.counts().ahead, 1);
}

TEST_F(ImageQueueTest, AnImageAloneInTheFutureIsDropped) {
  for (const int t : {0, 50, 1'000'000, 100, 150, 1'000'000, 200}) AddImage(t);
  EXPECT_EQ(Flush(), (std::vector<int>{0, 50, 100, 150, 200}));
  EXPECT_EQ(queue_.counts().ahead, 2);
  EXPECT_EQ(queue_.counts().restarts + queue_.counts().out_of_order, 0);
}

TEST(ImageQueue, MarksImagesAtTheRateAndDeliversAll) {
  Config config = StillConfig();
  config.publish_rate = 10;
  ImageQueue queue(config);
  std::vector<bool> published;
  for (int i = 0; i < 10; ++i) {
    queue.AddImage(0, {kStart + i * 50 * kMillisecond, StillPicture()});
    published.push_back(queue.Flush()->publish);
  }
  EXPECT_FALSE(published[0]);
  for (int i = 2; i < 10; ++i) EXPECT_NE(published[i], published[i - 1]) << i;
}

// The gyroscope cannot predict while the rotation of the camera is unknown.
TEST(ImageQueue, IgnoresTheGyroIfTheCameraRotationIsUnknown) {
  Config config = StillConfig();
  config.sensor.estimate_extrinsic = SensorConfig::ExtrinsicMode::kCalibrateRotation;
  ImageQueue queue(config);
  for (int t = -50; t <= 50; t += 5) queue.AddImu(StillImu(kStart + t * kMillisecond));
  for (const int t : {0, 50, 100}) {
    queue.AddImage(0, {kStart + t * kMillisecond, StillPicture()});
    const auto ready = queue.Pop();
    ASSERT_TRUE(ready) << "waits for the gyro";
    EXPECT_FALSE(ready->R_now_then);
  }
  EXPECT_EQ(queue.counts().without_gyro, 0);
}

class OtherImages : public ::testing::Test {
 protected:
  static Config TwoCameras() {
    Config config = StillConfig();
    config.sensor.cameras.push_back(config.sensor.cameras[0]);
    config.sensor.depth.emplace();
    return config;
  }

  static int64_t At(int milliseconds) { return kStart + milliseconds * kMillisecond; }

  const cv::Mat picture_ = StillPicture();
  const cv::Mat depth_{240, 320, CV_16UC1, cv::Scalar(2000)};
  ImageQueue queue_{TwoCameras()};
};

TEST_F(OtherImages, ArePairedByStamp) {
  queue_.AddImage(1, {At(1), picture_});
  queue_.AddDepth({At(0), depth_});
  queue_.AddImage(0, {At(0), picture_});
  queue_.AddImage(0, {At(50), picture_});
  const auto first = queue_.Flush();
  ASSERT_TRUE(first);
  EXPECT_EQ(first->images[1].t_ns, At(1));
  EXPECT_EQ(first->depth.t_ns, At(0));
  const auto second = queue_.Flush();
  ASSERT_TRUE(second);
  EXPECT_TRUE(second->images[1].gray.empty());
  EXPECT_TRUE(second->depth.depth.empty());
  EXPECT_EQ(queue_.counts().others.at(0).missing.count().count, 1);
  EXPECT_EQ(queue_.counts().without_depth.count().count, 1);
}

// The cameras are stamped 2.1 ms apart.
TEST_F(OtherImages, AConstantOffsetOfStampsIsNamedAndMayBeAllowed) {
  for (const double tolerance : {0.002, 0.003}) {
    Config config = TwoCameras();
    config.sensor.stamp_tolerance = tolerance;
    ImageQueue queue(config);
    int paired = 0;
    for (int t = 0; t < 1500; t += 50) {
      queue.AddImage(0, {At(t), picture_});
      queue.AddImage(1, {At(t) + 2'100'000, picture_});
      const auto ready = queue.Flush();
      ASSERT_TRUE(ready);
      paired += !ready->images[1].gray.empty();
    }
    EXPECT_EQ(paired, tolerance < 0.0021 ? 0 : 30);
    const std::string detail = queue.counts().others.at(0).missing.count().detail;
    EXPECT_EQ(detail.find("a constant 2.1 ms later") != std::string::npos, paired == 0) << detail;
    EXPECT_EQ(detail.find("stamp_tolerance: 0.003") != std::string::npos, paired == 0) << detail;
  }
}

TEST_F(OtherImages, OfAnotherSizeAreTheCauseOfMissingOnes) {
  queue_.AddImage(1, {At(0), picture_.rowRange(0, 100)});
  queue_.AddDepth({At(0), depth_.colRange(0, 100)});
  queue_.AddImage(0, {At(0), picture_});
  ASSERT_TRUE(queue_.Flush());
  EXPECT_NE(queue_.counts().others.at(0).missing.count().detail.find("320 x 100 px"),
            std::string::npos);
  EXPECT_NE(queue_.counts().without_depth.count().detail.find("100 x 240 px"), std::string::npos);
}

TEST_F(OtherImages, NeedNoPixelsWhereTheyAreNotSearched) {
  queue_.AddImage(1, {At(0), cv::Mat()});
  queue_.AddImage(0, {At(0), picture_});
  const auto ready = queue_.Flush();
  ASSERT_TRUE(ready);
  EXPECT_TRUE(ready->images[1].gray.empty());
  EXPECT_EQ(queue_.counts().others.at(0).missing.count().count, 0);
  EXPECT_EQ(queue_.counts().others.at(0).unusable.count, 0);
}

TEST_F(OtherImages, OfAFrozenSecondCameraAreDropped) {
  const cv::Mat moved = picture_ + 1;
  const std::vector<cv::Mat> left = {picture_, moved, moved};
  const std::vector<bool> is_used = {true, false, true};  // the last pair stands still
  for (int i = 0; i < 3; ++i) {
    queue_.AddImage(1, {At(50 * i), picture_.clone()});
    queue_.AddImage(0, {At(50 * i), left[i]});
    const auto ready = queue_.Flush();
    ASSERT_TRUE(ready);
    EXPECT_EQ(!ready->images[1].gray.empty(), is_used[i]) << i;
  }
  EXPECT_EQ(queue_.counts().others.at(0).repeated.count, 1);
}

TEST_F(OtherImages, AreNotSearchedInImagesThatAreNotPublished) {
  Config config = TwoCameras();
  config.publish_rate = 10;
  ImageQueue queue(config);
  for (int i = 0; i < 20; ++i) {
    queue.AddImage(1, {At(50 * i), picture_ + i});
    queue.AddImage(0, {At(50 * i), picture_ + i});
    const auto ready = queue.Flush();
    ASSERT_TRUE(ready);
    EXPECT_EQ(!ready->images[1].gray.empty(), ready->publish) << i;
  }
}

TEST_F(OtherImages, OfAWrongFormatAreCounted) {
  queue_.AddImage(1, {At(0), depth_});
  queue_.AddDepth({At(0), picture_});
  EXPECT_EQ(queue_.counts().others.at(0).unusable.count, 1);
  EXPECT_EQ(queue_.counts().depth_unusable.count, 1);
  EXPECT_EQ(ToDropCounts(queue_.counts()).size(), ToDropCounts(ImageCounts()).size() + 2);
}

TEST_F(OtherImages, AreIgnoredIfNotConfigured) {
  ImageQueue queue(StillConfig());
  queue.AddImage(1, {At(0), picture_});
  queue.AddDepth({At(0), depth_});
  queue.AddImage(0, {At(0), picture_});
  const auto ready = queue.Flush();
  ASSERT_TRUE(ready);
  EXPECT_EQ(ready->images.size(), 1u);
  EXPECT_TRUE(ready->depth.depth.empty());
  EXPECT_TRUE(queue.counts().others.empty());
}

// A tracked camera has images between those that are published; the second one of a pair need not.
TEST_F(OtherImages, OfATrackedCameraAreAllUsed) {
  Config config = TwoCameras();
  config.sensor.stereo_pairs = "none";
  config.publish_rate = 10;
  ImageQueue queue(config);
  for (int i = 0; i < 20; ++i) {
    queue.AddImage(1, {At(50 * i), picture_ + i});
    queue.AddImage(0, {At(50 * i), picture_ + i});
    EXPECT_FALSE(queue.Flush()->images[1].gray.empty()) << i;
  }
}

TEST_F(OtherImages, OfFourCamerasArePairedByStamp) {
  Config config = StillConfig();
  config.sensor.cameras.resize(4, config.sensor.cameras[0]);
  ImageQueue queue(config);
  for (const int camera : {3, 1, 0}) queue.AddImage(camera, {At(0), picture_ + camera});
  const auto ready = queue.Flush();
  ASSERT_TRUE(ready);
  EXPECT_TRUE(ready->images[2].gray.empty());
  EXPECT_EQ(cv::norm(ready->images[3].gray, picture_ + 3, cv::NORM_INF), 0);
  EXPECT_EQ(queue.counts().others[1].missing.count().count, 1);
  EXPECT_EQ(ToDropCounts(queue.counts()).back().cause, "images_without_camera2");
}

}  // namespace
}  // namespace plm_vins
