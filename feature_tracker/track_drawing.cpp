// SPDX-License-Identifier: BSD-3-Clause
#include "feature_tracker/track_drawing.h"

#include <opencv2/imgproc.hpp>

#include "tracking/age_color.h"

namespace plm_vins {
namespace {

constexpr int kDiscRadius_px = 3;
constexpr float kMotionScale = 4;  // enlarges the short motions between images

}  // namespace

cv::Mat DrawPointTracks(const cv::Mat& gray, const std::vector<PointTrack>& tracks) {
  if (gray.empty()) return {};
  cv::Mat image;
  cv::cvtColor(gray, image, cv::COLOR_GRAY2BGR);
  for (const PointTrack& track : tracks) {
    const cv::Scalar color = AgeColor(track.length);
    cv::circle(image, track.uv_px, kDiscRadius_px, color, cv::FILLED, cv::LINE_AA);
    cv::line(image, track.uv_px, track.uv_px + kMotionScale * track.motion_px, color, 1,
             cv::LINE_AA);
  }
  return image;
}

}  // namespace plm_vins
