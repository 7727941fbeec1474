// SPDX-License-Identifier: BSD-3-Clause
#include "linefeature_tracker/detection/edge_segments.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>

namespace plm_vins {
namespace {

constexpr double kMaxDistance_px = 1.4;
constexpr size_t kHeadingPixels = 6;  // over which the heading of a chain is taken

using Chain = std::vector<cv::Point>;

// Returns the neighbor with an edge that lies most ahead, or none.
std::optional<cv::Point> NextPixel(const cv::Mat& edges, const Chain& chain) {
  static const std::array<cv::Point, 8> steps = {
      {{1, 0}, {0, 1}, {-1, 0}, {0, -1}, {1, 1}, {-1, 1}, {-1, -1}, {1, -1}}};
  constexpr std::array<double, 2> kInverseLengths = {1, M_SQRT1_2};
  const cv::Rect inside({}, edges.size());
  const cv::Point heading =
      chain.back() - chain[chain.size() - std::min(chain.size(), kHeadingPixels)];
  std::optional<cv::Point> next;
  double best = chain.size() == 1 ? -1 : 0;
  for (size_t i = 0; i < steps.size(); ++i) {
    const cv::Point pixel = chain.back() + steps[i];
    if (!inside.contains(pixel) || edges.at<uint8_t>(pixel) == 0) continue;
    const double ahead = kInverseLengths[i / 4] * heading.dot(steps[i]);
    if (ahead <= best) continue;
    best = ahead;
    next = pixel;
  }
  return next;
}

// Follows an edge from one of its pixels to both ends and removes it from the image.
Chain Follow(const cv::Point& start, cv::Mat* edges) {
  Chain chain = {start};
  edges->at<uint8_t>(start) = 0;
  for (int end = 0; end < 2; ++end) {
    while (const auto next = NextPixel(*edges, chain)) {
      chain.push_back(*next);
      edges->at<uint8_t>(*next) = 0;
    }
    std::reverse(chain.begin(), chain.end());
  }
  return chain;
}

Eigen::Vector2d ToEigen(const cv::Point& point) { return {point.x, point.y}; }

// Least squares line through pixels.
class PixelLine {
 public:
  void Add(const cv::Point& pixel) {
    const Eigen::Vector2d p = ToEigen(pixel);
    ++count_;
    sum_ += p;
    squares_ += p.cwiseAbs2();
    product_ += p.x() * p.y();
  }

  // Fits the line to the pixels so far.
  void Fit() {
    center_ = sum_ / count_;
    const Eigen::Vector2d variance = squares_ / count_ - center_.cwiseAbs2();
    const double covariance = product_ / count_ - center_.x() * center_.y();
    const double angle = 0.5 * std::atan2(2 * covariance, variance.x() - variance.y());
    direction_ = {std::cos(angle), std::sin(angle)};
  }

  bool IsNear(const cv::Point& pixel) const {
    const Eigen::Vector2d offset = ToEigen(pixel) - center_;
    return std::abs(direction_.x() * offset.y() - direction_.y() * offset.x()) <= kMaxDistance_px;
  }

  Eigen::Vector2d Nearest(const cv::Point& pixel) const {
    return center_ + direction_.dot(ToEigen(pixel) - center_) * direction_;
  }

 private:
  int count_ = 0;
  Eigen::Vector2d sum_ = Eigen::Vector2d::Zero(), squares_ = Eigen::Vector2d::Zero();
  double product_ = 0;
  Eigen::Vector2d center_ = Eigen::Vector2d::Zero(), direction_ = Eigen::Vector2d::UnitX();
};

// Returns the line through `count` pixels from `first` on, or none if they are not straight.
std::optional<PixelLine> LineOf(const cv::Point* first, int count) {
  PixelLine line;
  std::for_each(first, first + count, [&](const cv::Point& pixel) { line.Add(pixel); });
  line.Fit();
  const bool is_straight =
      std::all_of(first, first + count, [&](const cv::Point& pixel) { return line.IsNear(pixel); });
  return is_straight ? std::optional(line) : std::nullopt;
}

// A part begins where the least number of steps is straight, and ends before the first pixel that
// is far from the line through all pixels before it.
void AppendStraightParts(const Chain& chain, double min_length_px,
                         std::vector<LineSegment>* segments) {
  const int min_steps = std::max(static_cast<int>(min_length_px), 1);
  const cv::Point* const end = chain.data() + chain.size();
  const cv::Point* first = chain.data();
  while (end - first > min_steps) {
    auto line = LineOf(first, min_steps + 1);
    if (!line) {
      ++first;
      continue;
    }
    const cv::Point* next = first + min_steps + 1;
    for (; next != end; ++next) {
      if (!line->IsNear(*next)) {
        line->Fit();
        if (!line->IsNear(*next)) break;
      }
      line->Add(*next);
    }
    line->Fit();
    const LineSegment segment{line->Nearest(*first), line->Nearest(next[-1])};
    if (segment.Length() >= min_length_px) segments->push_back(segment);
    first = next;
  }
}

}  // namespace

std::vector<LineSegment> FindStraightEdges(double min_length_px, cv::Mat* edges) {
  std::vector<LineSegment> segments;
  for (int y = 0; y < edges->rows; ++y) {
    for (int x = 0; x < edges->cols; ++x) {
      if (edges->at<uint8_t>(y, x) == 0) continue;
      AppendStraightParts(Follow({x, y}, edges), min_length_px, &segments);
    }
  }
  return segments;
}

}  // namespace plm_vins
