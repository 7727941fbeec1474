// SPDX-License-Identifier: BSD-3-Clause
#include "linefeature_tracker/detection/line_detector.h"

#include <gtest/gtest.h>

#include "test/linefeature_tracker/line_scene.h"

namespace plm_vins {
namespace {

class LineDetectorTest : public testing::TestWithParam<LineDetectorType> {
 protected:
  void SetUp() override {
    if (!LineDetector::IsAvailable(GetParam())) GTEST_SKIP() << "not in this OpenCV";
    detector_ = LineDetector::Create(GetParam());
  }

  std::unique_ptr<LineDetector> detector_;
};

TEST_P(LineDetectorTest, FindsTheEdgesOfABar) {
  LineScene scene(PlainParameters(), 60);
  scene.AddBar({200, 150}, {500, 300}, 60, 200);
  const auto found = detector_->Detect(scene.View(), 30);
  for (const LineSegment& edge : scene.Edges()) {
    const auto edge_px = LineSegment{458 * edge.start + Eigen::Vector2d(375.5, 239.5),
                                     458 * edge.end + Eigen::Vector2d(375.5, 239.5)};
    const bool is_found = std::any_of(found.begin(), found.end(), [&](const LineSegment& line) {
      return Relate(edge_px, line).overlap > 0.5 && NormalErrorInPixels(edge_px, line, 1) < 2.5;
    });
    EXPECT_TRUE(is_found) << "from " << edge_px.start.transpose();
  }
}

TEST_P(LineDetectorTest, HonoursTheLeastLength) {
  LineScene scene(PlainParameters(), 60);
  scene.AddBar({200, 150}, {500, 300}, 60, 200);
  const auto found = detector_->Detect(scene.View(), 100);
  EXPECT_FALSE(found.empty());
  for (const LineSegment& line : found) EXPECT_GE(line.Length(), 100);
}

TEST_P(LineDetectorTest, FindsNothingInUniformImages) {
  for (const int gray : {0, 128, 255})
    EXPECT_TRUE(detector_->Detect(cv::Mat(480, 752, CV_8UC1, cv::Scalar(gray)), 20).empty());
}

INSTANTIATE_TEST_SUITE_P(All, LineDetectorTest,
                         testing::Values(LineDetectorType::kFld, LineDetectorType::kLsd,
                                         LineDetectorType::kEdLines));

}  // namespace
}  // namespace plm_vins
