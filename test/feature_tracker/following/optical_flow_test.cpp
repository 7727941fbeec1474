// SPDX-License-Identifier: BSD-3-Clause
#include "feature_tracker/following/optical_flow.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <opencv2/video/tracking.hpp>

#include "test/feature_tracker/textured_scene.h"

namespace plm_vins {
namespace {

std::vector<cv::Point2f> GridPoints() {
  std::vector<cv::Point2f> points;
  for (int y = 60; y <= kHeight - 60; y += 20) {
    for (int x = 60; x <= kWidth - 60; x += 20) points.emplace_back(x + 0.25F, y - 0.4F);
  }
  return points;
}

Eigen::Quaterniond Turn(double about_axis) {
  return Eigen::Quaterniond(Eigen::AngleAxisd(about_axis, Eigen::Vector3d::UnitZ()));
}

class OpticalFlowTest : public testing::Test {
 protected:
  std::vector<FlowResult> Track(const cv::Mat& image0, const cv::Mat& image1,
                                const std::vector<cv::Point2f>& predicted) const {
    return flow_.Track(flow_.BuildPyramid(image0), flow_.BuildPyramid(image1), points_, predicted);
  }

  // Returns the sorted errors of the tracked points.
  std::vector<double> Errors(const std::vector<FlowResult>& results, const cv::Matx33d& H) const {
    std::vector<double> errors;
    for (size_t i = 0; i < results.size(); ++i) {
      if (results[i].status != FlowResult::Status::kTracked) continue;
      errors.push_back(cv::norm(Move(H, points_[i]) - cv::Point2d(results[i].position)));
    }
    std::sort(errors.begin(), errors.end());
    return errors;
  }

  TexturedScene scene_;
  std::vector<cv::Point2f> points_ = GridPoints();
  OpticalFlow flow_{PointTrackerConfig()};
};

TEST_F(OpticalFlowTest, FollowsTranslationToSubpixels) {
  const cv::Matx33d H = Translation(5.3, -3.7);
  const auto errors = Errors(Track(scene_.View(), scene_.View(H), points_), H);
  EXPECT_EQ(errors.size(), points_.size());
  EXPECT_LT(errors[errors.size() / 2], 0.03);
  EXPECT_LT(errors.back(), 0.2);
}

// Comparison with an independent implementation, which computes gradients of whole images.
TEST_F(OpticalFlowTest, AgreesWithOpenCv) {
  const PointTrackerConfig config;
  const cv::Mat image0 = scene_.View();
  const cv::Mat image1 = scene_.View(Translation(6.4, 2.3) * RotationHomography(Turn(0.02)));
  const cv::TermCriteria criteria(cv::TermCriteria::COUNT | cv::TermCriteria::EPS, 30, 0.03);
  std::vector<cv::Point2f> theirs;
  std::vector<uint8_t> found;
  cv::calcOpticalFlowPyrLK(image0, image1, points_, theirs, found, cv::noArray(),
                           {config.klt_window, config.klt_window}, config.klt_levels, criteria);
  const std::vector<FlowResult> ours = Track(image0, image1, points_);
  int agreeing = 0, tracked = 0;
  for (size_t i = 0; i < points_.size(); ++i) {
    if (ours[i].status != FlowResult::Status::kTracked || found[i] == 0) continue;
    ++tracked;
    if (cv::norm(ours[i].position - theirs[i]) < 0.02) ++agreeing;
  }
  EXPECT_GT(tracked, static_cast<int>(0.9 * static_cast<double>(points_.size())));
  EXPECT_GT(agreeing, 0.98 * tracked);
}

TEST_F(OpticalFlowTest, PredictionReachesFartherThanThePyramid) {
  const cv::Matx33d H = Translation(110, 0);
  std::vector<cv::Point2f> predicted;
  for (const cv::Point2f& point : points_) predicted.push_back(point + cv::Point2f(104, 4));
  const auto without = Errors(Track(scene_.View(), scene_.View(H), points_), H);
  const auto with = Errors(Track(scene_.View(), scene_.View(H), predicted), H);
  const auto is_good = [](double error) { return error < 0.3; };
  const auto good_without = std::count_if(without.begin(), without.end(), is_good);
  const auto good_with = std::count_if(with.begin(), with.end(), is_good);
  EXPECT_GT(static_cast<double>(good_with), 0.5 * static_cast<double>(points_.size()));
  EXPECT_LT(static_cast<double>(good_without), 0.1 * static_cast<double>(points_.size()));
}

TEST_F(OpticalFlowTest, LosesPointsThatLeaveTheImage) {
  const cv::Matx33d H = Translation(kWidth - 80, 0);
  std::vector<cv::Point2f> predicted;
  for (const cv::Point2f& point : points_) predicted.emplace_back(Move(H, point));
  const auto results = Track(scene_.View(), scene_.View(H), predicted);
  for (size_t i = 0; i < results.size(); ++i) {
    if (predicted[i].x <= kWidth + 1) continue;
    EXPECT_NE(results[i].status, FlowResult::Status::kTracked);
  }
}

TEST_F(OpticalFlowTest, DoesNotTrackToADifferentScene) {
  const auto results = Track(scene_.View(), TexturedScene(99).View(), points_);
  const auto tracked = std::count_if(results.begin(), results.end(), [](const FlowResult& result) {
    return result.status == FlowResult::Status::kTracked;
  });
  const auto inconsistent = std::count_if(results.begin(), results.end(), [](const FlowResult& r) {
    return r.status == FlowResult::Status::kInconsistent;
  });
  EXPECT_LT(static_cast<double>(tracked), 0.2 * static_cast<double>(points_.size()));
  EXPECT_GT(static_cast<double>(inconsistent), 0.3 * static_cast<double>(points_.size()));
}

TEST_F(OpticalFlowTest, LosesEverythingInBlankImages) {
  for (const int gray : {0, 255}) {
    const cv::Mat blank(kHeight, kWidth, CV_8UC1, cv::Scalar(gray));
    for (const FlowResult& result : Track(blank, scene_.View(), points_)) {
      EXPECT_EQ(result.status, FlowResult::Status::kLost);
    }
    for (const FlowResult& result : Track(scene_.View(), blank, points_)) {
      EXPECT_NE(result.status, FlowResult::Status::kTracked);
    }
  }
}

TEST_F(OpticalFlowTest, TakesNoPoints) {
  const auto pyramid = flow_.BuildPyramid(scene_.View());
  EXPECT_TRUE(flow_.Track(pyramid, pyramid, {}, {}).empty());
}

}  // namespace
}  // namespace plm_vins
