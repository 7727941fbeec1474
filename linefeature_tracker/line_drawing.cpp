// SPDX-License-Identifier: BSD-3-Clause
#include "linefeature_tracker/line_drawing.h"

#include <opencv2/imgproc.hpp>
#include <string>

#include "tracking/age_color.h"

namespace plm_vins {
namespace {

constexpr int kThickness_px = 2;
constexpr double kFontScale = 0.35;

cv::Point2d ToOpenCv(const Eigen::Vector2d& point) { return {point.x(), point.y()}; }

}  // namespace

cv::Mat DrawLineTracks(const cv::Mat& gray, const std::vector<LineTrack>& tracks) {
  if (gray.empty()) return {};
  cv::Mat image;
  cv::cvtColor(gray, image, cv::COLOR_GRAY2BGR);
  for (const LineTrack& track : tracks) {
    const cv::Scalar color = AgeColor(track.length);
    cv::line(image, ToOpenCv(track.segment_px.start), ToOpenCv(track.segment_px.end), color,
             kThickness_px, cv::LINE_AA);
    cv::putText(image, std::to_string(track.id), ToOpenCv(track.segment_px.Midpoint()),
                cv::FONT_HERSHEY_SIMPLEX, kFontScale, color, 1, cv::LINE_AA);
  }
  return image;
}

}  // namespace plm_vins
