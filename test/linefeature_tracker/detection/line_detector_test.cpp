// SPDX-License-Identifier: BSD-3-Clause
#include "linefeature_tracker/detection/line_detector.h"

#include <gtest/gtest.h>

#include <opencv2/ximgproc/fast_line_detector.hpp>

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

// Half the sum of the endpoints' distances, independent of the direction of the segments.
double EndErrorInPixels(const LineSegment& a, const LineSegment& b) {
  return 0.5 * std::min((a.start - b.start).norm() + (a.end - b.end).norm(),
                        (a.start - b.end).norm() + (a.end - b.start).norm());
}

// OpenCV takes twice as long and rounds one endpoint to pixels; its versions start chains
// differently.
TEST(FastLineDetector, FindsWhatThatOfOpenCvFinds) {
  LineScene scene(PlainParameters(), 60);
  for (int i = 0; i < 12; ++i) {
    const double x = 60.0 * i + 30;
    scene.AddBar({x, 60.0 + 5 * i}, {x + 7.0 * i - 30, 420.0 - 9 * i}, 20, 150 + 8 * i);
  }
  const cv::Mat image = scene.View(Eigen::Matrix3d::Identity(), 4);
  const auto found = LineDetector::Create(LineDetectorType::kFld)->Detect(image, 30);
  std::vector<cv::Vec4f> lines;
  cv::ximgproc::createFastLineDetector(30, 1.414F, 50, 100, 3, false)->detect(image, lines);
  ASSERT_GT(lines.size(), 20u);
  size_t alike = 0;
  for (const cv::Vec4f& line : lines) {
    const LineSegment expected = {{line[0], line[1]}, {line[2], line[3]}};
    alike += std::any_of(found.begin(), found.end(), [&](const LineSegment& segment) {
      return EndErrorInPixels(expected, segment) < 0.1;
    });
  }
  EXPECT_GE(alike, lines.size() * 90 / 100);
  EXPECT_LE(found.size(), lines.size() * 110 / 100);
}

INSTANTIATE_TEST_SUITE_P(All, LineDetectorTest,
                         testing::Values(LineDetectorType::kFld, LineDetectorType::kLsd,
                                         LineDetectorType::kEdLines));

}  // namespace
}  // namespace plm_vins
