// SPDX-License-Identifier: BSD-3-Clause
#include "feature_tracker/detection/ray_mask.h"

#include <algorithm>
#include <cstdint>

#include "common/features/feature_checks.h"

namespace plm_vins {
namespace {

constexpr int kBlock = 4;  // [px]; finding that a pixel has no ray takes a hundred times as long

bool HasRay(const CameraModel& camera, int x, int y) { return RayOf(camera, {x, y}).has_value(); }

// Pixels with rays form a connected region around the principal point, so testing the border
// suffices.
bool BorderHasRays(const CameraModel& camera) {
  const int right = camera.parameters().width - 1, bottom = camera.parameters().height - 1;
  for (int x = 0; x <= right; ++x) {
    if (!HasRay(camera, x, 0) || !HasRay(camera, x, bottom)) return false;
  }
  for (int y = 0; y <= bottom; ++y) {
    if (!HasRay(camera, 0, y) || !HasRay(camera, right, y)) return false;
  }
  return true;
}

// Returns 255 in blocks whose four corners have rays, 0 elsewhere.
cv::Mat RayBlocks(const CameraModel& camera) {
  const int width = camera.parameters().width, height = camera.parameters().height;
  cv::Mat nodes((height - 1) / kBlock + 2, (width - 1) / kBlock + 2, CV_8UC1);
  for (int j = 0; j < nodes.rows; ++j) {
    for (int i = 0; i < nodes.cols; ++i) {
      const int x = std::min(kBlock * i, width - 1), y = std::min(kBlock * j, height - 1);
      nodes.at<uint8_t>(j, i) = HasRay(camera, x, y) ? 255 : 0;
    }
  }
  const cv::Rect image(0, 0, width, height);
  cv::Mat mask(height, width, CV_8UC1, cv::Scalar(0));
  for (int j = 0; j + 1 < nodes.rows; ++j) {
    for (int i = 0; i + 1 < nodes.cols; ++i) {
      if (cv::countNonZero(nodes(cv::Rect(i, j, 2, 2))) < 4) continue;
      mask(cv::Rect(kBlock * i, kBlock * j, kBlock, kBlock) & image).setTo(255);
    }
  }
  return mask;
}

}  // namespace

std::optional<Eigen::Vector2d> RayOf(const CameraModel& camera, const Eigen::Vector2d& pixel) {
  const auto xy = camera.Unproject(pixel);
  return xy && IsWithin(*xy, kMaxImageCoordinate) ? xy : std::nullopt;
}

cv::Mat WithinRays(const CameraModel& camera, const cv::Mat& mask) {
  if (BorderHasRays(camera)) return mask;
  const cv::Mat rays = RayBlocks(camera);
  return mask.empty() ? rays : cv::Mat(rays & mask);
}

}  // namespace plm_vins
