// SPDX-License-Identifier: BSD-3-Clause
#include "feature_tracker/following/optical_flow.h"

#include <opencv2/video/tracking.hpp>

namespace plm_vins {
namespace {

constexpr int kMaxIterations = 30;
constexpr double kConverged_px = 0.03;
constexpr int kBackwardLevels = 0;  // the way back begins at its expected end

bool IsInside(const cv::Mat& image, const cv::Point2f& point) {
  return point.x >= 0 && point.y >= 0 && point.x <= static_cast<float>(image.cols - 1) &&
         point.y <= static_cast<float>(image.rows - 1);
}

}  // namespace

OpticalFlow::Pyramid OpticalFlow::BuildPyramid(const cv::Mat& image, Pyramid unused) const {
  cv::buildOpticalFlowPyramid(image, unused, {config_.klt_window, config_.klt_window},
                              config_.klt_levels);
  return unused;
}

std::vector<FlowResult> OpticalFlow::Track(const Pyramid& previous, const Pyramid& current,
                                           const std::vector<cv::Point2f>& points,
                                           const std::vector<cv::Point2f>& predicted) const {
  if (points.empty()) return {};
  std::vector<cv::Point2f> forward = predicted;
  std::vector<cv::Point2f> backward = points;
  const auto found = Search(previous, current, points, config_.klt_levels, &forward);
  const auto returned = Search(current, previous, forward, kBackwardLevels, &backward);

  std::vector<FlowResult> results(points.size());
  for (size_t i = 0; i < points.size(); ++i) {
    results[i].position = forward[i];
    if (!found[i] || !IsInside(current.front(), forward[i])) continue;
    const bool consistent =
        returned[i] && cv::norm(backward[i] - points[i]) <= config_.forward_backward;
    results[i].status =
        consistent ? FlowResult::Status::kTracked : FlowResult::Status::kInconsistent;
  }
  return results;
}

// `found` holds the first guess and takes the result. True where the search succeeded.
std::vector<bool> OpticalFlow::Search(const Pyramid& from, const Pyramid& to,
                                      const std::vector<cv::Point2f>& points, int levels,
                                      std::vector<cv::Point2f>* found) const {
  const cv::TermCriteria criteria(cv::TermCriteria::COUNT | cv::TermCriteria::EPS, kMaxIterations,
                                  kConverged_px);
  std::vector<uint8_t> status;
  cv::calcOpticalFlowPyrLK(from, to, points, *found, status, cv::noArray(),
                           {config_.klt_window, config_.klt_window}, levels, criteria,
                           cv::OPTFLOW_USE_INITIAL_FLOW);
  return {status.begin(), status.end()};
}

}  // namespace plm_vins
