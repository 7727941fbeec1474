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

using Found = std::vector<std::optional<cv::Point2f>>;

class OpticalFlowTest : public testing::Test {
 protected:
  Found Track(const cv::Mat& image0, const cv::Mat& image1,
              const std::vector<cv::Point2f>& predicted) const {
    return flow_.Track(flow_.BuildPyramid(image0), flow_.BuildPyramid(image1), Starts(predicted));
  }

  std::vector<FlowStart> Starts(const std::vector<cv::Point2f>& predicted) const {
    std::vector<FlowStart> starts;
    for (size_t i = 0; i < points_.size(); ++i) starts.push_back({points_[i], predicted[i], false});
    return starts;
  }

  // Returns the sorted errors of the tracked points.
  std::vector<double> Errors(const Found& results, const cv::Matx33d& H) const {
    std::vector<double> errors;
    for (size_t i = 0; i < results.size(); ++i) {
      if (!results[i]) continue;
      errors.push_back(cv::norm(Move(H, points_[i]) - cv::Point2d(*results[i])));
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
  const Found ours = Track(image0, image1, points_);
  int agreeing = 0, tracked = 0;
  for (size_t i = 0; i < points_.size(); ++i) {
    if (!ours[i] || found[i] == 0) continue;
    ++tracked;
    if (cv::norm(*ours[i] - theirs[i]) < 0.02) ++agreeing;
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

TEST_F(OpticalFlowTest, ACloseStartNeedsNoCoarseLevels) {
  const auto from = flow_.BuildPyramid(scene_.View());
  const auto count_found = [&](float motion) {
    const cv::Matx33d H = Translation(motion, 0);
    std::vector<FlowStart> starts = Starts(points_);
    for (FlowStart& start : starts) start.is_close = true;
    const auto errors = Errors(flow_.Track(from, flow_.BuildPyramid(scene_.View(H)), starts), H);
    const auto good = std::count_if(errors.begin(), errors.end(), [](double e) { return e < 0.3; });
    return static_cast<double>(good) / static_cast<double>(points_.size());
  };
  EXPECT_GT(count_found(5), 0.97);
  EXPECT_LT(count_found(40), 0.3);
}

TEST_F(OpticalFlowTest, LosesPointsThatLeaveTheImage) {
  const cv::Matx33d H = Translation(kWidth - 80, 0);
  std::vector<cv::Point2f> predicted;
  for (const cv::Point2f& point : points_) predicted.emplace_back(Move(H, point));
  const auto results = Track(scene_.View(), scene_.View(H), predicted);
  for (size_t i = 0; i < results.size(); ++i) {
    if (predicted[i].x <= kWidth + 1) continue;
    EXPECT_FALSE(results[i]);
  }
}

TEST_F(OpticalFlowTest, LeadsBackOnlyFromTheSamePoint) {
  const auto from = flow_.BuildPyramid(scene_.View());
  const auto count = [&](const cv::Mat& image) {
    const auto to = flow_.BuildPyramid(image);
    const Found found = flow_.Track(from, to, Starts(points_));
    int leading_back = 0;
    for (size_t i = 0; i < found.size(); ++i) {
      leading_back += found[i] && flow_.LeadsBack(from, to, points_[i], *found[i]) ? 1 : 0;
    }
    return leading_back / static_cast<double>(points_.size());
  };
  EXPECT_GT(count(scene_.View(Translation(5.3, -3.7))), 0.99);
  EXPECT_LT(count(TexturedScene(99).View()), 0.2);
}

TEST_F(OpticalFlowTest, LosesEverythingInBlankImages) {
  for (const int gray : {0, 255}) {
    const cv::Mat blank(kHeight, kWidth, CV_8UC1, cv::Scalar(gray));
    for (const auto& found : Track(blank, scene_.View(), points_)) EXPECT_FALSE(found);
    const Found found = Track(scene_.View(), blank, points_);
    const auto from = flow_.BuildPyramid(scene_.View()), to = flow_.BuildPyramid(blank);
    for (size_t i = 0; i < found.size(); ++i) {
      if (!found[i]) continue;
      EXPECT_FALSE(flow_.LeadsBack(from, to, points_[i], *found[i]));
    }
  }
}

TEST_F(OpticalFlowTest, TakesNoPoints) {
  const auto pyramid = flow_.BuildPyramid(scene_.View());
  EXPECT_TRUE(flow_.Track(pyramid, pyramid, {}).empty());
}

}  // namespace
}  // namespace plm_vins
