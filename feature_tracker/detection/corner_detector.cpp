// SPDX-License-Identifier: BSD-3-Clause
#include "feature_tracker/detection/corner_detector.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <utility>

#include "feature_tracker/detection/corner_refinement.h"
#include "tracking/images/image_mask.h"

namespace plm_vins {
namespace {

// White noise of 2 gray levels stays below this threshold even when CLAHE amplifies it; corners of
// a lit scene reach 0.1 (gradients are in units of the full gray range).
constexpr float kMinEigenvalue = 5e-4F;
constexpr int kCornersPerRegion = 8;  // mean number for each region of RegionQueue

cv::Mat HalfImage(const std::vector<cv::Mat>& pyramid) {
  if (pyramid.size() > 1) return pyramid[1];
  cv::Mat half;
  cv::pyrDown(pyramid.front(), half);
  return half;
}

// Returns the smallest eigenvalue [Shi1994] or Harris' measure of the gradient covariance.
cv::Mat Response(const cv::Mat& image, CornerDetectorType type) {
  constexpr int kBlock = 3, kAperture = 3;
  constexpr double kHarrisK = 0.04;
  cv::Mat response;
  if (type == CornerDetectorType::kHarris) {
    cv::cornerHarris(image, response, kBlock, kAperture, kHarrisK);
  } else {
    cv::cornerMinEigenVal(image, response, kBlock, kAperture);
  }
  return response;
}

}  // namespace

RegionQueue::RegionQueue(const cv::Size& image_size, int region_count)
    : region_size_(std::sqrt(static_cast<double>(image_size.area()) / region_count)),
      columns_(static_cast<int>(image_size.width / region_size_) + 1),
      queue_(static_cast<size_t>(columns_) *
             (static_cast<int>(image_size.height / region_size_) + 1)) {}

size_t RegionQueue::RegionOf(const cv::Point2f& position) const {
  const int column = static_cast<int>(position.x / region_size_);
  const int row = static_cast<int>(position.y / region_size_);
  return static_cast<size_t>(row) * columns_ + column;
}

CornerDetector::CornerDetector(const PointTrackerConfig& config, cv::Mat mask)
    : config_(config), mask_(std::move(mask)) {}

std::vector<cv::Point2f> CornerDetector::Detect(const std::vector<cv::Mat>& pyramid,
                                                const std::vector<cv::Point2f>& existing,
                                                int max_count, const cv::Mat& moving) const {
  if (max_count <= 0) return {};
  const cv::Mat& image = pyramid.front();
  SpacingGrid occupied(image.size(), config_.min_dist);
  RegionQueue queue(image.size(), config_.max_cnt / kCornersPerRegion + 1);
  for (const cv::Point2f& point : existing) {
    occupied.Add(point);
    queue.CountPoint(point);
  }
  for (const Candidate& candidate : FindCandidates(pyramid, occupied, moving)) {
    queue.AddCandidate(candidate.position);
  }
  std::vector<cv::Point2f> corners;
  while (static_cast<int>(corners.size()) < max_count) {
    const auto candidate = queue.Pop();
    if (!candidate) break;
    if (!occupied.IsFree(*candidate)) continue;
    const auto corner = config_.corner_subpixel ? RefineCorner(image, *candidate) : candidate;
    if (!corner || !IsAllowed(*corner, image.size()) || !occupied.IsFree(*corner)) continue;
    occupied.Add(*corner);
    queue.CountPoint(*corner);
    corners.push_back(*corner);
  }
  return corners;
}

// Returns the local maxima of the response, strongest first; equal ones in order of position.
std::vector<CornerDetector::Candidate> CornerDetector::FindCandidates(
    const std::vector<cv::Mat>& pyramid, const SpacingGrid& occupied, const cv::Mat& moving) const {
  const cv::Size image_size = pyramid.front().size();
  const cv::Mat response = Response(HalfImage(pyramid), config_.corner_detector);
  cv::Mat local_maximum;
  cv::dilate(response, local_maximum, cv::Mat());
  const float min_response = MinResponse(response);

  std::vector<Candidate> candidates;
  for (int y = 0; y < response.rows; ++y) {
    const auto* values = response.ptr<float>(y);
    const auto* maxima = local_maximum.ptr<float>(y);
    for (int x = 0; x < response.cols; ++x) {
      if (values[x] < min_response || values[x] < maxima[x]) continue;
      const cv::Point2f position(2.0F * static_cast<float>(x), 2.0F * static_cast<float>(y));
      if (!IsAllowed(position, image_size) || !MaskAllows(moving, position)) continue;
      if (!occupied.IsFree(position)) continue;
      candidates.push_back({position, values[x]});
    }
  }
  std::stable_sort(candidates.begin(), candidates.end(),
                   [](const auto& a, const auto& b) { return a.response > b.response; });
  return candidates;
}

// The thresholds are squared for Harris, whose response is a product of two eigenvalues.
float CornerDetector::MinResponse(const cv::Mat& response) const {
  double best = 0;
  cv::minMaxLoc(response, nullptr, &best);
  const auto quality = static_cast<float>(config_.quality_level);
  const auto best_response = static_cast<float>(best);
  if (config_.corner_detector == CornerDetectorType::kHarris) {
    return std::max(kMinEigenvalue * kMinEigenvalue, quality * quality * best_response);
  }
  return std::max(kMinEigenvalue, quality * best_response);
}

bool CornerDetector::IsAllowed(const cv::Point2f& position, const cv::Size& image_size) const {
  return IsRefinementWindowInside(image_size, position) && MaskAllows(mask_, position);
}

}  // namespace plm_vins
