// SPDX-License-Identifier: BSD-3-Clause
#include "pose_graph/description/corner_selection.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <map>
#include <opencv2/features2d.hpp>
#include <opencv2/imgproc.hpp>
#include <set>
#include <utility>
#include <vector>

#include "simulator/random.h"

namespace plm_vins {
namespace {

// Bright squares on black: four corners each, at most two of which share a cell.
cv::Mat Squares(const std::vector<cv::Point>& places, const std::vector<int>& brightness) {
  cv::Mat gray(240, 320, CV_8UC1, cv::Scalar(0));
  for (size_t i = 0; i < places.size(); ++i) {
    cv::rectangle(gray, cv::Rect(places[i], cv::Size(12, 12)), cv::Scalar(brightness[i]), -1);
  }
  cv::GaussianBlur(gray, gray, cv::Size(3, 3), 0.7);  // otherwise neighbors are equally strong
  return gray;
}

TEST(SelectCorners, SelectsTheStrongestOfEachCell) {
  const cv::Mat gray = Squares({{70, 70}, {134, 134}}, {100, 200});
  const auto corners = SelectCorners(CornerSelectionOptions(), gray, {});
  ASSERT_EQ(corners.size(), 2u);
  EXPECT_NEAR(corners[0].x(), 140, 8);
  EXPECT_NEAR(corners[1].x(), 76, 8);
}

TEST(SelectCorners, SkipsOccupiedCells) {
  const cv::Mat gray = Squares({{70, 70}, {134, 134}}, {100, 200});
  const auto corners = SelectCorners(CornerSelectionOptions(), gray, {{140, 140}});
  ASSERT_EQ(corners.size(), 1u);
  EXPECT_NEAR(corners[0].x(), 76, 8);
}

TEST(SelectCorners, StopsAtTheMaximumIncludingKnownCorners) {
  const cv::Mat gray = Squares({{70, 70}, {134, 134}}, {100, 200});
  CornerSelectionOptions options;
  options.max_corners = 2;
  EXPECT_EQ(SelectCorners(options, gray, {{200, 200}}).size(), 1u);
  options.max_corners = 1;
  EXPECT_THAT(SelectCorners(options, gray, {{200, 200}, {210, 30}}), ::testing::IsEmpty());
}

TEST(SelectCorners, KeepsDistanceFromTheBorder) {
  EXPECT_THAT(SelectCorners(CornerSelectionOptions(), Squares({{5, 5}}, {200}), {}),
              ::testing::IsEmpty());
}

// Selects the corners in a single pass over the whole image.
std::vector<Eigen::Vector2f> SelectInOnePass(const CornerSelectionOptions& options,
                                             const cv::Mat& gray,
                                             const std::vector<Eigen::Vector2f>& known_px) {
  const auto cell_of = [&](float u, float v) {
    return std::pair(static_cast<int>(v) / options.cell_px, static_cast<int>(u) / options.cell_px);
  };
  std::set<std::pair<int, int>> taken;
  for (const Eigen::Vector2f& uv : known_px) taken.insert(cell_of(uv.x(), uv.y()));
  std::vector<cv::KeyPoint> found;
  cv::FAST(gray, found, options.fast_threshold);
  cv::KeyPointsFilter::runByImageBorder(found, gray.size(), options.border_px);
  std::map<std::pair<int, int>, cv::KeyPoint> strongest;
  for (const cv::KeyPoint& corner : found) {
    const auto cell = cell_of(corner.pt.x, corner.pt.y);
    if (taken.count(cell) > 0) continue;
    cv::KeyPoint& best = strongest.try_emplace(cell, corner).first->second;
    if (corner.response > best.response) best = corner;
  }
  std::multimap<float, Eigen::Vector2f, std::greater<>> by_strength;
  for (const auto& [cell, corner] : strongest) {
    by_strength.emplace(corner.response, Eigen::Vector2f(corner.pt.x, corner.pt.y));
  }
  std::vector<Eigen::Vector2f> selected;
  for (const auto& [strength, uv] : by_strength) {
    if (selected.size() + known_px.size() < static_cast<size_t>(options.max_corners)) {
      selected.push_back(uv);
    }
  }
  return selected;
}

// Noise of two scales with amplitude increasing to the right: the cells contain no corners, only
// weak ones, or many strong ones.
cv::Mat Texture(const cv::Size& size, simulator::Random* random) {
  cv::Mat fine(size, CV_32FC1), coarse;
  for (float& value : cv::Mat_<float>(fine)) value = static_cast<float>(random->Normal());
  cv::GaussianBlur(fine, coarse, {}, 3.0);
  cv::GaussianBlur(fine, fine, {}, 0.8);
  cv::Mat gray(size, CV_8UC1);
  for (int v = 0; v < size.height; ++v) {
    for (int u = 0; u < size.width; ++u) {
      const float contrast = 60.0F * static_cast<float>(u) / static_cast<float>(size.width);
      const float noise = fine.at<float>(v, u) + 4 * coarse.at<float>(v, u);
      gray.at<uint8_t>(v, u) = cv::saturate_cast<uint8_t>(128 + contrast * noise);
    }
  }
  return gray;
}

std::vector<Eigen::Vector2f> RandomPlaces(int count, const cv::Size& size,
                                          simulator::Random* random) {
  std::vector<Eigen::Vector2f> places;
  places.reserve(count);
  for (int i = 0; i < count; ++i) {
    places.emplace_back(static_cast<float>(random->Index(10 * size.width)) / 10,
                        static_cast<float>(random->Index(10 * size.height)) / 10);
  }
  return places;
}

TEST(SelectCorners, SelectsTheSameAsInOnePass) {
  simulator::Random random(1);
  for (int image = 0; image < 12; ++image) {
    const cv::Size size(300 + 17 * image, 240 + 11 * image);
    const cv::Mat gray = Texture(size, &random);
    CornerSelectionOptions options;
    if (image % 3 == 1) options.cell_px = 20;
    if (image % 3 == 2) options.border_px = 2;
    for (const int known_count : {0, 25}) {
      const auto known_px = RandomPlaces(known_count, size, &random);
      for (const int most : {30, 60, 1000}) {
        options.max_corners = most;
        const auto selected = SelectCorners(options, gray, known_px);
        EXPECT_GE(selected.size(), 5u);
        EXPECT_EQ(selected, SelectInOnePass(options, gray, known_px)) << image << ", " << most;
      }
    }
  }
}

TEST(SelectCorners, FindsNoneInsideTheBorder) {
  simulator::Random random(1);
  EXPECT_THAT(SelectCorners(CornerSelectionOptions(), Texture({300, 48}, &random), {}),
              ::testing::IsEmpty());
}

}  // namespace
}  // namespace plm_vins
