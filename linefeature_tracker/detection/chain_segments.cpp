// SPDX-License-Identifier: BSD-3-Clause
#include "linefeature_tracker/detection/chain_segments.h"

#include <cmath>

namespace plm_vins {
namespace {

Eigen::Vector2d ToVector(const cv::Point& pixel) { return {pixel.x, pixel.y}; }

struct Line {
  Eigen::Vector2d point, direction;

  static Line Through(const cv::Point& a, const cv::Point& b) {
    return {ToVector(a), (ToVector(b) - ToVector(a)).normalized()};
  }

  double Distance(const cv::Point& pixel) const {
    const Eigen::Vector2d way = ToVector(pixel) - point;
    return std::abs(direction.x() * way.y() - direction.y() * way.x());
  }

  Eigen::Vector2d Foot(const cv::Point& pixel) const {
    return point + direction.dot(ToVector(pixel) - point) * direction;
  }
};

// Total least squares fit of a line to pixels, from exact running sums.
class LineFit {
 public:
  void Add(const cv::Point& pixel) {
    const Eigen::Vector2d xy = ToVector(pixel);
    ++count_;
    sum_ += xy;
    squares_ += xy.cwiseAbs2();
    product_ += xy.x() * xy.y();
  }

  Line Solve() const {
    const Eigen::Vector2d mean = sum_ / count_;
    const Eigen::Vector2d variance = squares_ / count_ - mean.cwiseAbs2();
    const double covariance = product_ / count_ - mean.x() * mean.y();
    const double angle = 0.5 * std::atan2(2 * covariance, variance.x() - variance.y());
    return {mean, {std::cos(angle), std::sin(angle)}};
  }

 private:
  double count_ = 0, product_ = 0;
  Eigen::Vector2d sum_ = Eigen::Vector2d::Zero(), squares_ = Eigen::Vector2d::Zero();
};

class ChainCutter {
 public:
  ChainCutter(const EdgeChain& chain, const StraightnessLimits& limits)
      : chain_(chain), limits_(limits) {}

  bool IsStraightFrom(size_t first) const {
    const size_t last = first + limits_.min_steps;
    const Line line = Line::Through(chain_[first], chain_[last]);
    for (size_t i = first + 1; i < last; ++i) {
      if (!IsNear(line, chain_[i])) return false;
    }
    return true;
  }

  // Returns the segment that begins at `first`; `next` is set to the first pixel after it.
  LineSegment SegmentFrom(size_t first, size_t* next) const {
    LineFit fit;
    size_t end = first;
    for (; end <= first + limits_.min_steps; ++end) fit.Add(chain_[end]);
    Line line = fit.Solve();
    for (; end < chain_.size(); ++end) {
      if (!IsNear(line, chain_[end])) {
        line = fit.Solve();
        if (!IsNear(line, chain_[end])) break;
      }
      fit.Add(chain_[end]);
    }
    *next = end;
    line = fit.Solve();
    return {line.Foot(chain_[first]), line.Foot(chain_[end - 1])};
  }

 private:
  bool IsNear(const Line& line, const cv::Point& pixel) const {
    return line.Distance(pixel) <= limits_.max_deviation_px;
  }

  const EdgeChain& chain_;
  const StraightnessLimits& limits_;
};

}  // namespace

void AppendSegments(const EdgeChain& chain, const StraightnessLimits& limits,
                    std::vector<LineSegment>* segments) {
  const ChainCutter cutter(chain, limits);
  for (size_t first = 0; first + limits.min_steps < chain.size();) {
    if (cutter.IsStraightFrom(first)) {
      segments->push_back(cutter.SegmentFrom(first, &first));
    } else {
      ++first;
    }
  }
}

}  // namespace plm_vins
