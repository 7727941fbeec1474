// SPDX-License-Identifier: BSD-3-Clause
#include "linefeature_tracker/detection/line_orientation.h"

#include "tracking/images/image_sampling.h"

namespace plm_vins {
namespace {

constexpr float kReach_px = 2;      // samples reach this far to each side
constexpr double kSpacing_px = 4;   // between samples
constexpr double kMaxSamples = 16;  // for long lines

}  // namespace

LineSegment OrientByBrightness(const cv::Mat& image, const LineSegment& segment_px) {
  const Eigen::Vector2f side = kReach_px * segment_px.Normal().cast<float>();
  const int count = static_cast<int>(std::min(segment_px.Length() / kSpacing_px, kMaxSamples)) + 1;
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

}  // namespace plm_vins
