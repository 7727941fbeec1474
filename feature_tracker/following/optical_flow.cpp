// SPDX-License-Identifier: BSD-3-Clause
#include "feature_tracker/following/optical_flow.h"

#include <algorithm>
#include <cmath>
#include <opencv2/video/tracking.hpp>
#include <optional>

#include "feature_tracker/following/flow_window.h"

namespace plm_vins {
namespace {

constexpr int kMaxFlowIterations = 30;
constexpr double kFlowConverged_px = 0.03;
constexpr float kStandstill_px = 0.01F;  // a step that reverts the previous one oscillates
constexpr int kBackwardLevels = 0;  // coarsest level of the backward search, whose end is known
constexpr double kMaxReturnError_px = 0.5;  // of the forward and backward search together

bool IsInside(const cv::Mat& image, const cv::Point2f& point) {
  return point.x >= 0 && point.y >= 0 && point.x <= static_cast<float>(image.cols - 1) &&
         point.y <= static_cast<float>(image.rows - 1);
}

// Moves `point` of a pyramid level to the window's position; returns false if it leaves the image.
bool Converge(const cv::Mat& level, FlowWindow* window, cv::Point2f* point) {
  cv::Point2f before;
  for (int i = 0; i < kMaxFlowIterations; ++i) {
    const auto step = window->Step(level, *point);
    if (!step) return false;
    *point += *step;
    if (step->dot(*step) <= kFlowConverged_px * kFlowConverged_px) return true;
    const cv::Point2f both = *step + before;
    if (i > 0 && std::abs(both.x) < kStandstill_px && std::abs(both.y) < kStandstill_px) {
      *point -= *step / 2;
      return true;
    }
    before = *step;
  }
  return true;
}

// Tracks `point` of `from` in `to`, from level `levels` to the finest, beginning at `start`.
// Returns nullopt if it is not found at the finest level.
std::optional<cv::Point2f> Search(const OpticalFlow::Pyramid& from, const OpticalFlow::Pyramid& to,
                                  int levels, const cv::Point2f& point, const cv::Point2f& start,
                                  FlowWindow* window) {
  cv::Point2f found = start;
  bool is_found = false;
  for (int level = std::min(levels, static_cast<int>(to.size()) - 1); level >= 0; --level) {
    const float scale = 1.0F / static_cast<float>(1 << level);
    cv::Point2f in_level = found * scale;
    is_found = window->Cut(from[level], point * scale) && Converge(to[level], window, &in_level);
    found = in_level / scale;
  }
  return is_found ? std::optional(found) : std::nullopt;
}

}  // namespace

OpticalFlow::Pyramid OpticalFlow::BuildPyramid(const cv::Mat& image, Pyramid unused) const {
  constexpr bool kWithDerivatives = false;
  const int border = FlowWindow::Border(config_.klt_window);
  cv::buildOpticalFlowPyramid(image, unused, {border, border}, config_.klt_levels,
                              kWithDerivatives);
  return unused;
}

std::vector<FlowResult> OpticalFlow::Track(const Pyramid& previous, const Pyramid& current,
                                           const std::vector<cv::Point2f>& points,
                                           const std::vector<cv::Point2f>& predicted) const {
  FlowWindow window(config_.klt_window);
  std::vector<FlowResult> results(points.size());
  for (size_t i = 0; i < points.size(); ++i) {
    const auto there =
        Search(previous, current, config_.klt_levels, points[i], predicted[i], &window);
    if (!there || !IsInside(current.front(), *there)) continue;
    const auto back = Search(current, previous, kBackwardLevels, *there, points[i], &window);
    const bool consistent = back && cv::norm(*back - points[i]) <= kMaxReturnError_px;
    results[i] = {*there,
                  consistent ? FlowResult::Status::kTracked : FlowResult::Status::kInconsistent};
  }
  return results;
}

}  // namespace plm_vins
