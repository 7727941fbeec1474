// SPDX-License-Identifier: BSD-3-Clause
#include "linefeature_tracker/detection/line_finder.h"

#include <algorithm>
#include <utility>

#include "linefeature_tracker/detection/line_orientation.h"
#include "linefeature_tracker/detection/segment_merging.h"
#include "linefeature_tracker/segments/segment_sampler.h"

namespace plm_vins {
namespace {

constexpr double kMinFragment = 0.7;  // minimum length of fragments, relative to that of lines

}  // namespace

LineFinder::LineFinder(const LineTrackerConfig& config, std::shared_ptr<const CameraModel> camera)
    : config_(config),
      camera_(std::move(camera)),
      detector_(LineDetector::Create(config.line_detector)),
      min_length_px_(config.min_length *
                     std::min(camera_->parameters().width, camera_->parameters().height)) {}

std::vector<FoundLine> LineFinder::Find(const std::vector<cv::Mat>& pyramid, int* fragments) {
  const int level = config_.half_resolution ? 1 : 0;
  const double scale = 1 << level;
  const auto fragments_px =
      detector_->Detect(pyramid[level], kMinFragment * min_length_px_ / scale);
  *fragments = static_cast<int>(fragments_px.size());
  SegmentMergingLimits limits;
  limits.gap /= camera_->FocalLength();
  limits.distance /= camera_->FocalLength();
  const std::vector<LineSegment> segments =
      JoinFragments(Undistort(pyramid[level], fragments_px, scale), limits);
  std::vector<FoundLine> lines;
  for (const LineSegment& segment : segments) {
    const auto segment_px = ProjectSegment(*camera_, segment);
    if (segment_px && segment_px->Length() >= min_length_px_)
      lines.push_back({segment, *segment_px});
  }
  std::stable_sort(lines.begin(), lines.end(), [](const FoundLine& a, const FoundLine& b) {
    return a.segment_px.Length() > b.segment_px.Length();
  });
  return lines;
}

// Fragments close to the border are dropped: the border cuts them off differently in each image.
std::vector<LineSegment> LineFinder::Undistort(const cv::Mat& image,
                                               const std::vector<LineSegment>& fragments_px,
                                               double scale) const {
  std::vector<LineSegment> segments;
  for (const LineSegment& fragment : fragments_px) {
    const LineSegment oriented = OrientByBrightness(image, fragment);
    const LineSegment full_px{scale * oriented.start, scale * oriented.end};
    if (!camera_->IsInImage(full_px.Midpoint(), kLineBorder_px)) continue;
    const auto segment = UnprojectSegment(*camera_, full_px);
    if (segment) segments.push_back(*segment);
  }
  return segments;
}

}  // namespace plm_vins
