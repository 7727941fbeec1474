// SPDX-License-Identifier: BSD-3-Clause
#include "linefeature_tracker/detection/line_finder.h"

#include <algorithm>
#include <utility>

#include "linefeature_tracker/detection/segment_merging.h"
#include "linefeature_tracker/segments/segment_sampler.h"
#include "tracking/images/image_sampling.h"

namespace plm_vins {
namespace {

constexpr float kReach_px = 2;           // samples reach this far to each side
constexpr double kSampleSpacing_px = 4;  // between samples
constexpr double kMaxSamples = 16;       // for long lines

constexpr double kMinFragment = 0.7;  // minimum length of fragments, relative to that of lines

}  // namespace

LineSegment OrientByBrightness(const cv::Mat& image, const LineSegment& segment_px) {
  const Eigen::Vector2f side = kReach_px * segment_px.Normal().cast<float>();
  const int count =
      static_cast<int>(std::min(segment_px.Length() / kSampleSpacing_px, kMaxSamples)) + 1;
  float rise = 0;
  for (int i = 0; i < count; ++i) {
    const double share = (i + 0.5) / count;
    const Eigen::Vector2f center =
        (segment_px.start + share * (segment_px.end - segment_px.start)).cast<float>();
    if (!IsInterpolable(image, center.x(), center.y(), kReach_px)) continue;
    rise += Interpolate(image, center.x() + side.x(), center.y() + side.y()) -
            Interpolate(image, center.x() - side.x(), center.y() - side.y());
  }
  return rise < 0 ? segment_px.Reversed() : segment_px;
}

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
