// SPDX-License-Identifier: BSD-3-Clause
#include "pose_graph/keyframes/keyframe_assembly.h"

#include <gtest/gtest.h>

#include <array>
#include <memory>
#include <utility>

namespace plm_vins {
namespace {

constexpr int64_t kPeriod = 50'000'000;  // of images

class KeyframeAssemblyTest : public ::testing::Test {
 protected:
  void AddImage(int64_t t_ns) {
    assembly_.AddImage(0, {t_ns, cv::Mat(4, 4, CV_8UC1, cv::Scalar(7))});
  }
  void AddPose(int64_t t_ns) {
    assembly_.AddPose(t_ns, {Eigen::Quaterniond::Identity(), {1.0 * t_ns, 0, 0}},
                      Eigen::Matrix<double, 6, 6>::Identity());
  }
  void AddAllButLines(int64_t t_ns) {
    AddImage(t_ns);
    AddPose(t_ns);
    assembly_.AddCorners(t_ns, std::vector<TrackedCorner>(3));
  }

  void AddTheRest(int64_t t_ns) {
    assembly_.AddCorners(t_ns, {});
    assembly_.AddSegments(t_ns, {});
  }

  KeyframeAssembly assembly_{/*stamp_tolerance=*/0.002};
};

TEST_F(KeyframeAssemblyTest, JoinsEqualStampsInAnyOrder) {
  assembly_.AddSegments(5, std::vector<TrackedSegment>(2));
  assembly_.AddCorners(5, std::vector<TrackedCorner>(3));
  AddPose(5);
  EXPECT_FALSE(assembly_.Pop());
  AddImage(4);
  EXPECT_FALSE(assembly_.Pop());
  AddImage(5);
  const auto frame = assembly_.Pop();
  ASSERT_TRUE(frame);
  EXPECT_EQ(frame->t_ns, 5);
  EXPECT_EQ(frame->T_O_B.translation.x(), 5);
  EXPECT_EQ(frame->corners.size(), 3u);
  EXPECT_EQ(frame->segments.size(), 2u);
  EXPECT_EQ(frame->images.at(0).gray.at<uchar>(0, 0), 7);
  EXPECT_FALSE(assembly_.Pop());
}

TEST_F(KeyframeAssemblyTest, PairsImagesOfFurtherCameras) {
  const auto gray = [](int value) { return cv::Mat(4, 4, CV_8UC1, cv::Scalar(value)); };
  assembly_.AddImage(1, {kPeriod - 5'000'000, gray(1)});
  assembly_.AddImage(1, {kPeriod + 1'000'000, gray(2)});
  assembly_.AddImage(2, {kPeriod + 3'000'000, gray(3)});  // belongs to another time
  AddImage(kPeriod);
  AddPose(kPeriod);
  AddTheRest(kPeriod);
  const auto frame = assembly_.Pop();
  ASSERT_TRUE(frame);
  ASSERT_EQ(frame->images.size(), 2u);
  EXPECT_EQ(frame->images.at(1).gray.at<uchar>(0, 0), 2);
}

// Under ROS the pixels belong to the message.
TEST_F(KeyframeAssemblyTest, KeepsTheOwnerOfThePixelsWithTheFrame) {
  auto pixels = std::make_shared<std::array<uint8_t, 16>>();
  assembly_.AddImage(0, {5, cv::Mat(4, 4, CV_8UC1, pixels->data()), pixels});
  AddPose(5);
  AddTheRest(5);
  auto frame = assembly_.Pop();
  ASSERT_TRUE(frame);
  EXPECT_EQ(frame->images.at(0).gray.data, pixels->data());
  const std::weak_ptr<const void> alive = std::exchange(pixels, nullptr);
  EXPECT_FALSE(alive.expired());
  frame.reset();
  EXPECT_TRUE(alive.expired());
}

TEST_F(KeyframeAssemblyTest, WaitsForLinesUntilTheNextIsComplete) {
  AddAllButLines(1);
  EXPECT_FALSE(assembly_.Pop());
  AddAllButLines(2);
  EXPECT_EQ(assembly_.Pop()->t_ns, 1);
  EXPECT_FALSE(assembly_.Pop());
}

TEST_F(KeyframeAssemblyTest, AStampInTheFutureDropsOneImage) {
  for (int i = 0; i < 100; ++i) {
    const int64_t t_ns = (100 + i) * kPeriod;
    AddPose(t_ns);
    AddTheRest(t_ns);
    AddImage(i == 50 ? t_ns + 2'000'000'000 : t_ns);
    const auto frame = assembly_.Pop();
    ASSERT_EQ(frame.has_value(), i != 50) << i;
    if (frame) {
      EXPECT_EQ(frame->t_ns, t_ns);
    }
  }
}

TEST_F(KeyframeAssemblyTest, ContinuesAfterAPause) {
  AddImage(kPeriod);
  const int64_t later_ns = 60'000'000'000;
  AddImage(later_ns);
  AddAllButLines(later_ns + kPeriod);
  AddTheRest(later_ns + kPeriod);
  const auto frame = assembly_.Pop();
  ASSERT_TRUE(frame);
  EXPECT_EQ(frame->t_ns, later_ns + kPeriod);
}

TEST_F(KeyframeAssemblyTest, DropsPartsAfterTheTimeout) {
  AddImage(kPeriod);
  AddPose(kPeriod);
  for (int i = 2; i < 100; ++i) AddImage(i * kPeriod);
  AddTheRest(kPeriod);
  EXPECT_FALSE(assembly_.Pop());
  EXPECT_EQ(assembly_.without_image(), 0);
}

// Images may be missing if they are published compressed, but subscribed raw.
TEST_F(KeyframeAssemblyTest, DropsPartsWithoutImages) {
  AddImage(kPeriod);
  for (int i = 2; i < 100; ++i) {
    AddPose(i * kPeriod);
    assembly_.AddCorners(i * kPeriod, {});
  }
  AddPose(kPeriod);
  AddTheRest(kPeriod);
  EXPECT_FALSE(assembly_.Pop());
  EXPECT_EQ(assembly_.without_image(), 99 - 60);
}

TEST_F(KeyframeAssemblyTest, CountsAKeyframeWhoseImageWasLostOnTheWay) {
  AddImage(kPeriod);  // of no keyframe
  AddPose(2 * kPeriod);
  AddTheRest(2 * kPeriod);
  AddPose(3 * kPeriod);  // its corners are lost as well
  AddAllButLines(4 * kPeriod);
  assembly_.AddSegments(4 * kPeriod, {});
  EXPECT_TRUE(assembly_.Pop());
  EXPECT_EQ(assembly_.without_image(), 1);
}

TEST_F(KeyframeAssemblyTest, TimeoutDoesNotDependOnTheRate) {
  constexpr int64_t kFast = kPeriod / 10;
  AddAllButLines(kFast);
  for (int i = 2; i < 250; ++i) AddImage(i * kFast);
  assembly_.AddSegments(kFast, {});
  EXPECT_TRUE(assembly_.Pop());
}

TEST_F(KeyframeAssemblyTest, HasABoundAtAnyRate) {
  AddPose(1);
  for (int i = 2; i < 400; ++i) AddImage(i);
  AddImage(1);
  AddTheRest(1);
  EXPECT_FALSE(assembly_.Pop());
}

TEST_F(KeyframeAssemblyTest, DeliversTheOldestFirst) {
  for (int i = 100; i < 200; ++i) AddPose(i * kPeriod);
  AddAllButLines(kPeriod);
  assembly_.AddSegments(kPeriod, {});
  const auto frame = assembly_.Pop();
  ASSERT_TRUE(frame);
  EXPECT_EQ(frame->t_ns, kPeriod);
}

TEST_F(KeyframeAssemblyTest, RestartsIfImagesJumpBack) {
  for (int i = 100; i < 200; ++i) AddImage(i * kPeriod);
  AddAllButLines(200 * kPeriod);
  for (int i = 1; i < 30; ++i) AddImage(i * kPeriod);
  AddPose(20 * kPeriod);
  AddTheRest(20 * kPeriod);
  const auto frame = assembly_.Pop();
  ASSERT_TRUE(frame);
  EXPECT_EQ(frame->t_ns, 20 * kPeriod);
  assembly_.AddSegments(200 * kPeriod, {});
  EXPECT_FALSE(assembly_.Pop());
}

TEST_F(KeyframeAssemblyTest, ToleratesSwappedImagesAndOneWrongStamp) {
  AddAllButLines(20 * kPeriod);
  AddImage(19 * kPeriod);
  AddImage(20'000 * kPeriod);
  AddImage(21 * kPeriod);
  assembly_.AddSegments(20 * kPeriod, {});
  const auto frame = assembly_.Pop();
  ASSERT_TRUE(frame);
  EXPECT_EQ(frame->t_ns, 20 * kPeriod);
}

TEST_F(KeyframeAssemblyTest, StartsOverWhenCleared) {
  AddAllButLines(2);
  assembly_.Clear();
  assembly_.AddSegments(2, {});
  EXPECT_FALSE(assembly_.Pop());
  AddPose(1);
  assembly_.AddCorners(1, {});
  assembly_.AddSegments(1, {});
  AddImage(1);
  EXPECT_TRUE(assembly_.Pop()) << "it goes back behind what is forgotten";
}

}  // namespace
}  // namespace plm_vins
