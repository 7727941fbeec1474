// SPDX-License-Identifier: BSD-3-Clause
#include "pose_graph/ros/loop_drawing.h"

#include <gtest/gtest.h>

#include "test/pose_graph/two_visits.h"

namespace plm_vins {
namespace {

constexpr int kEarlierGray = 40;
constexpr int kLaterGray = 90;

// Two visits of the camera of two_visits.h, with 752 x 480 px and a focal length of 460 px; the
// halves of the drawing are 376 x 240 px. The earlier camera is 1 m above the origin of its world
// and looks along z.
class LoopDrawingTest : public ::testing::Test {
 protected:
  LoopDrawingTest() { observations_.T_O1_C.translation = {0, 0, 1}; }

  cv::Mat Draw() const { return DrawLoop({camera_}, observations_, earlier_, later_); }

  // Returns whether the drawing is colored at the pixel.
  static bool IsColored(const cv::Mat& picture, int x, int y) {
    const auto& color = picture.at<cv::Vec3b>(y, x);
    return color[0] != color[1] || color[1] != color[2];
  }

  std::shared_ptr<const CameraModel> camera_ = testing::SimpleCamera();
  cv::Mat earlier_{240, 376, CV_8UC1, cv::Scalar(kEarlierGray)};  // at half resolution, as stored
  cv::Mat later_{480, 752, CV_8UC1, cv::Scalar(kLaterGray)};
  LoopObservations observations_;
};

TEST_F(LoopDrawingTest, HasTheEarlierImageOnTheLeft) {
  const cv::Mat picture = Draw();
  ASSERT_EQ(picture.size(), cv::Size(752, 240));
  ASSERT_EQ(picture.type(), CV_8UC3);
  EXPECT_EQ(picture.at<cv::Vec3b>(120, 375), cv::Vec3b::all(kEarlierGray));
  EXPECT_EQ(picture.at<cv::Vec3b>(120, 376), cv::Vec3b::all(kLaterGray));
}

TEST_F(LoopDrawingTest, DrawsAnUnknownEarlierImageBlack) {
  earlier_ = cv::Mat();
  const cv::Mat picture = Draw();
  EXPECT_EQ(picture.at<cv::Vec3b>(120, 100), cv::Vec3b::all(0));
  EXPECT_EQ(picture.at<cv::Vec3b>(120, 500), cv::Vec3b::all(kLaterGray));
}

TEST_F(LoopDrawingTest, JoinsALandmarkWithItsCorner) {
  // 92 px above the center of the earlier image, 92 px below the center of the later one.
  observations_.of_earlier = {{{0, -0.4, 3}, {0, 0.2}}};
  const cv::Mat picture = Draw();
  EXPECT_TRUE(IsColored(picture, 188 - 2, 120 - 46));  // left of the line: the disc
  EXPECT_TRUE(IsColored(picture, 376 + 188 + 2, 120 + 46));
  EXPECT_TRUE(IsColored(picture, 376, 120));  // halfway
  EXPECT_FALSE(IsColored(picture, 188, 120 + 46));
}

TEST_F(LoopDrawingTest, IgnoresLandmarksOutsideTheEarlierImage) {
  observations_.of_earlier = {{{0, 0, 0.5}, {0, 0}}, {{5, 0, 2}, {0, 0}}};  // behind, outside
  EXPECT_FALSE(IsColored(Draw(), 376 + 188, 120));
}

TEST_F(LoopDrawingTest, DrawsALineInBothImages) {
  SeenSegment upright;
  upright.line = {{0.4, -0.4, 3}, {0.4, 0.4, 3}};
  upright.segment.start = {-0.2, -0.2};
  upright.segment.end = {-0.2, 0.2};
  observations_.lines = {upright};
  const cv::Mat picture = Draw();
  for (const int y : {80, 120, 160}) {
    EXPECT_TRUE(IsColored(picture, 188 + 46, y));
    EXPECT_TRUE(IsColored(picture, 376 + 188 - 46, y));
    EXPECT_FALSE(IsColored(picture, 376, y));  // lines are not connected
  }
  EXPECT_FALSE(IsColored(picture, 188 + 46, 120 + 60));
}

}  // namespace
}  // namespace plm_vins
