// SPDX-License-Identifier: BSD-3-Clause
// Tracks points in views of a TexturedScene.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <memory>
#include <optional>
#include <vector>

#include "feature_tracker/point_tracker.h"
#include "test/feature_tracker/textured_scene.h"

namespace plm_vins {

inline PointTrackerConfig TestConfig() {
  PointTrackerConfig config;
  config.max_cnt = 80;
  config.min_dist = 14;
  return config;
}

inline cv::Point2d Pixel(const PointObservation& point) {
  return {point.uv_px.x(), point.uv_px.y()};
}

inline std::map<int64_t, PointObservation> ById(const PointFrame& frame) {
  std::map<int64_t, PointObservation> points;
  for (const PointObservation& point : frame.points) points[point.id] = point;
  return points;
}

// Returns the sorted distances of the points in both frames from their positions by H.
inline std::vector<double> TrackErrors(const PointFrame& frame0, const PointFrame& frame1,
                                       const cv::Matx33d& H) {
  std::vector<double> errors;
  const auto before = ById(frame0);
  for (const PointObservation& point : frame1.points) {
    const auto it = before.find(point.id);
    if (it == before.end()) continue;
    errors.push_back(cv::norm(Pixel(point) - Move(H, Pixel(it->second))));
  }
  std::sort(errors.begin(), errors.end());
  return errors;
}

class PointTrackerTest : public ::testing::Test {
 protected:
  PointFrame Track(const cv::Mat& image,
                   const std::optional<Eigen::Quaterniond>& R_now_then = std::nullopt) {
    t_ns_ += kFrame_ns;
    return tracker_->Track({t_ns_, image}, R_now_then);
  }

  void Configure(const PointTrackerConfig& config) {
    tracker_ = std::make_unique<PointTracker>(config, camera_);
  }

  std::shared_ptr<const CameraModel> camera_ = TestCamera();
  TexturedScene scene_;
  std::unique_ptr<PointTracker> tracker_ = std::make_unique<PointTracker>(TestConfig(), camera_);
  int64_t t_ns_ = 0;
};

}  // namespace plm_vins
