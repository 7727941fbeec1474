// SPDX-License-Identifier: BSD-3-Clause
#include "pose_graph/keyframes/keyframe_assembly.h"

#include <gtest/gtest.h>

namespace plm_vins {
namespace {

class KeyframeAssemblyTest : public ::testing::Test {
 protected:
  void AddImage(int64_t t_ns) { assembly_.AddImage({t_ns, cv::Mat(4, 4, CV_8UC1, cv::Scalar(7))}); }
  void AddPose(int64_t t_ns) {
    assembly_.AddPose(t_ns, {Eigen::Quaterniond::Identity(), {1.0 * t_ns, 0, 0}},
                      Eigen::Matrix<double, 6, 6>::Identity());
  }
  void AddAllButLines(int64_t t_ns) {
    AddImage(t_ns);
    AddPose(t_ns);
    assembly_.AddCorners(t_ns, std::vector<TrackedCorner>(3));
  }

  KeyframeAssembly assembly_;
};

TEST_F(KeyframeAssemblyTest, PutsTogetherWhatHasOneStampInAnyOrder) {
  assembly_.AddSegments(5, std::vector<TrackedSegment>(2), Eigen::Quaterniond(0.6, 0, 0, 0.8));
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
  EXPECT_EQ(frame->R_O_M->w(), 0.6);
  EXPECT_EQ(frame->gray.at<uchar>(0, 0), 7);
  EXPECT_FALSE(assembly_.Pop());
}

TEST_F(KeyframeAssemblyTest, WaitsForLinesUntilTheNextIsComplete) {
  AddAllButLines(1);
  EXPECT_FALSE(assembly_.Pop());
  AddAllButLines(2);
  EXPECT_EQ(assembly_.Pop()->t_ns, 1);
  EXPECT_FALSE(assembly_.Pop());
}

TEST_F(KeyframeAssemblyTest, ForgetsWhatWaitsForTooLong) {
  AddImage(1);
  AddPose(1);
  for (int64_t t = 2; t < 100; ++t) AddImage(t);
  assembly_.AddCorners(1, {});
  assembly_.AddSegments(1, {}, std::nullopt);
  EXPECT_FALSE(assembly_.Pop());
}

// As where images come compressed, and are waited for raw.
TEST_F(KeyframeAssemblyTest, ForgetsAsMuchWhereNoImagesCome) {
  AddImage(1);
  for (int64_t t = 2; t < 100; ++t) AddPose(t);
  AddPose(1);
  assembly_.AddCorners(1, {});
  assembly_.AddSegments(1, {}, std::nullopt);
  EXPECT_FALSE(assembly_.Pop());
}

TEST_F(KeyframeAssemblyTest, TakesTheOldestOfManyStamps) {
  for (int64_t t = 100; t < 200; ++t) AddPose(t);
  AddAllButLines(1);
  assembly_.AddSegments(1, {}, std::nullopt);
  const auto frame = assembly_.Pop();
  ASSERT_TRUE(frame);
  EXPECT_EQ(frame->t_ns, 1);
}

TEST_F(KeyframeAssemblyTest, BeginsAnewWhereImagesGoBack) {
  for (int64_t t = 100; t < 200; ++t) AddImage(t);
  AddAllButLines(200);
  for (int64_t t = 1; t < 30; ++t) AddImage(t);
  AddPose(1);
  assembly_.AddCorners(1, {});
  assembly_.AddSegments(1, {}, std::nullopt);
  const auto frame = assembly_.Pop();
  ASSERT_TRUE(frame);
  EXPECT_EQ(frame->t_ns, 1);
  assembly_.AddSegments(200, {}, std::nullopt);
  EXPECT_FALSE(assembly_.Pop());
}

TEST_F(KeyframeAssemblyTest, StartsOverWhenCleared) {
  AddAllButLines(2);
  assembly_.Clear();
  assembly_.AddSegments(2, {}, std::nullopt);
  EXPECT_FALSE(assembly_.Pop());
  AddPose(1);
  assembly_.AddCorners(1, {});
  assembly_.AddSegments(1, {}, std::nullopt);
  AddImage(1);
  EXPECT_TRUE(assembly_.Pop()) << "it goes back behind what is forgotten";
}

}  // namespace
}  // namespace plm_vins
