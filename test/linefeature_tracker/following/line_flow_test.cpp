// SPDX-License-Identifier: BSD-3-Clause
#include "linefeature_tracker/following/line_flow.h"

#include <gtest/gtest.h>

#include "test/linefeature_tracker/bar_scene.h"

namespace plm_vins {
namespace {

constexpr double kFocal = 458;

Eigen::Matrix3d Motion(double angle, double x_px, double y_px) {
  Eigen::Matrix3d H = Eigen::AngleAxisd(angle, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  H(0, 2) = x_px / kFocal;
  H(1, 2) = y_px / kFocal;
  return H;
}

class LineFlowTest : public testing::Test {
 protected:
  // Tracks the long edge of a single bar through the motion, which is not predicted.
  std::optional<LineFlowResult> Follow(const Eigen::Matrix3d& H, double gain = 1, double bias = 0) {
    cv::Mat moved;
    scene_.View(H).convertTo(moved, CV_8U, gain, bias);
    const LineSegment edge = scene_.Edges()[0];
    return flow_.Track(LineFlow::BuildPyramid(scene_.View()), LineFlow::BuildPyramid(moved), edge,
                       edge);
  }

  double ErrorInPixels(const Eigen::Matrix3d& H, const LineSegment& found) const {
    return NormalErrorInPixels(scene_.Edges(H)[0], found, kFocal);
  }

  LineScene scene_ = [] {
    LineScene scene(PlainParameters(), 60);
    scene.AddBar({250, 300}, {480, 200}, 70, 200);
    return scene;
  }();
  LineFlow flow_{scene_.camera()};
};

TEST_F(LineFlowTest, FindsSmallAndLargeMotions) {
  const std::vector<Eigen::Matrix3d> motions = {Motion(0, 0, 0), Motion(0, 1, -2), Motion(0, 3, 8),
                                                Motion(0.03, -4, 12), Motion(0, 0, -25)};
  for (const Eigen::Matrix3d& H : motions) {
    const auto found = Follow(H);
    ASSERT_TRUE(found);
    EXPECT_LT(ErrorInPixels(H, found->segment), 0.5) << H;
    EXPECT_GT(found->correlation, 0.95);
  }
}

TEST_F(LineFlowTest, ChangesOfExposureDoNotMatter) {
  const Eigen::Matrix3d H = Motion(0, 2, 5);
  const auto found = Follow(H, 0.8, 15);
  ASSERT_TRUE(found);
  EXPECT_LT(ErrorInPixels(H, found->segment), 1);
  EXPECT_GT(found->correlation, 0.95);
}

TEST_F(LineFlowTest, LowCorrelationWhereTheLineIsGone) {
  cv::Mat noise(480, 752, CV_8UC1);
  cv::RNG(5).fill(noise, cv::RNG::UNIFORM, 0, 255);
  const LineSegment edge = scene_.Edges()[0];
  const auto found =
      flow_.Track(LineFlow::BuildPyramid(scene_.View()), LineFlow::BuildPyramid(noise), edge, edge);
  EXPECT_TRUE(!found || found->correlation < 0.5);
}

TEST_F(LineFlowTest, FindsNothingOutsideTheImage) {
  const auto pyramid = LineFlow::BuildPyramid(scene_.View());
  const LineSegment outside{{2.0, 0.0}, {2.2, 0.1}};
  EXPECT_FALSE(flow_.Track(pyramid, pyramid, scene_.Edges()[0], outside));
}

}  // namespace
}  // namespace plm_vins
