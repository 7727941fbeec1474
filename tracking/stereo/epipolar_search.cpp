// SPDX-License-Identifier: BSD-3-Clause
#include "tracking/stereo/epipolar_search.h"

#include <algorithm>
#include <cmath>
#include <opencv2/core/fast_math.hpp>
#include <vector>

#include "tracking/stereo/correlation_window.h"

namespace plm_vins {
namespace {

constexpr float kMinCorrelation = 0.75F;  // at whole pixels; the alignment requires more
constexpr float kUniqueness = 1.3F;       // the next best place must be worse by this factor
constexpr float kNoise = 0.01F;   // places that are worse than perfect by less are equally good
constexpr int kPeakWidth_px = 3;  // points farther from the best one count as others
constexpr double kBandStep_px = 1.5;
constexpr double kNoBand_px = 0.5;    // correlation windows match up to this far off the curve
constexpr size_t kWarpInterval = 32;  // points of a curve that share a warp

struct Candidate {
  CurvePoint place;
  float correlation = -1;
};

// Evaluates the points along the curve and across it.
class Search {
 public:
  Search(const cv::Mat& image, const std::vector<CurvePoint>& curve, double band_px)
      : image_(image),
        curve_(curve),
        steps_(static_cast<int>(std::ceil((band_px - kNoBand_px) / kBandStep_px))) {
    candidates_.reserve(curve.size());
  }

  void Compare(const CorrelationWindow& window, size_t begin, size_t end) {
    for (size_t i = begin; i < end; ++i) {
      const cv::Point whole(cvRound(curve_[i].pixel.x()), cvRound(curve_[i].pixel.y()));
      if (whole == last_) continue;
      last_ = whole;
      candidates_.push_back(BestAcross(window, i));
    }
  }

  // Returns the best candidate, or nullopt if another point is about as good.
  std::optional<CurvePoint> Unique() const {
    const auto is_worse = [](const Candidate& a, const Candidate& b) {
      return a.correlation < b.correlation;
    };
    const auto best = std::max_element(candidates_.begin(), candidates_.end(), is_worse);
    if (best == candidates_.end() || best->correlation < kMinCorrelation) return std::nullopt;
    const float least_worse = std::max(kUniqueness * (1 - best->correlation), kNoise);
    for (const Candidate& other : candidates_) {
      const Eigen::Vector2d apart = other.place.pixel - best->place.pixel;
      if (apart.cwiseAbs().maxCoeff() < kPeakWidth_px) continue;
      if (1 - other.correlation < least_worse) return std::nullopt;
    }
    return best->place;
  }

 private:
  Candidate BestAcross(const CorrelationWindow& window, size_t i) const {
    const size_t previous = i > 0 ? i - 1 : 0, next = std::min(i + 1, curve_.size() - 1);
    const Eigen::Vector2d along = (curve_[next].pixel - curve_[previous].pixel).normalized();
    Candidate best{curve_[i]};
    for (int k = -steps_; k <= steps_; ++k) {
      const Eigen::Vector2d pixel =
          curve_[i].pixel + k * kBandStep_px * Eigen::Vector2d(-along.y(), along.x());
      const cv::Point whole(cvRound(pixel.x()), cvRound(pixel.y()));
      if (!CorrelationWindow::IsInside(image_, whole)) continue;
      const float correlation = window.Correlate(image_, whole);
      if (correlation <= best.correlation) continue;
      best.correlation = correlation;
      best.place.pixel = {static_cast<double>(whole.x), static_cast<double>(whole.y)};
    }
    return best;
  }

  const cv::Mat& image_;
  const std::vector<CurvePoint>& curve_;
  int steps_;
  cv::Point last_ = {-1, -1};
  std::vector<Candidate> candidates_;
};

}  // namespace

std::optional<CurvePoint> SearchAlongCurve(const CameraPair& pair, const cv::Mat& first,
                                           const SearchedPoint& point, const cv::Mat& second,
                                           const SearchRange& range) {
  const std::vector<CurvePoint> curve = pair.Curve(point.xy, range.from, range.to);
  const auto window_at = [&](double inverse_depth) {
    const auto warp = pair.Warp(point.xy, inverse_depth);
    return warp ? CorrelationWindow::Cut(first, point.pixel, *warp) : std::nullopt;
  };
  Search search(second, curve, range.band_px);
  for (size_t begin = 0; begin < curve.size(); begin += kWarpInterval) {
    const size_t end = std::min(begin + kWarpInterval, curve.size());
    const auto window = window_at(curve[(begin + end) / 2].inverse_depth);
    if (window) search.Compare(*window, begin, end);
  }
  auto place = search.Unique();
  const auto window = place ? window_at(place->inverse_depth) : std::nullopt;
  if (!window) return std::nullopt;
  place->pixel = window->Climb(second, place->pixel);
  return place;
}

}  // namespace plm_vins
