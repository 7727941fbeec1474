// SPDX-License-Identifier: BSD-3-Clause
#include "tracking/stereo/correlation_window.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <opencv2/core/fast_math.hpp>

#include "tracking/images/image_sampling.h"

namespace plm_vins {
namespace {

constexpr int kMaxClimb = 5;  // [px]
constexpr double kMinWarpDeterminant = 0.1;
constexpr float kMinContrast = 2.0F;  // [gray levels], rms: sensor noise has about one

// Root of the sum of squares about the mean.
float Deviation(int sum, int squares, int count) {
  const float mean = static_cast<float>(sum) / static_cast<float>(count);
  return std::sqrt(std::max(static_cast<float>(squares) - static_cast<float>(sum) * mean, 0.0F));
}

// Returns the vertex of the parabola through values at -1, 0 and 1, of which the middle one is the
// largest.
double Vertex(float before, float middle, float after) {
  const float curvature = before - 2 * middle + after;
  return curvature < 0 ? 0.5 * (before - after) / curvature : 0.0;
}

}  // namespace

std::optional<CorrelationWindow> CorrelationWindow::Cut(const cv::Mat& image,
                                                        const Eigen::Vector2d& center,
                                                        const Eigen::Matrix2d& warp) {
  if (!(std::abs(warp.determinant()) > kMinWarpDeterminant)) return std::nullopt;
  const Eigen::Matrix2f unwarp = warp.inverse().cast<float>();
  const Eigen::Vector2f first =
      center.cast<float>() - unwarp * Eigen::Vector2f(kToCenter.x, kToCenter.y);
  for (const Eigen::Vector2f& corner :
       {Eigen::Vector2f(0, 0), Eigen::Vector2f(kWidth - 1, 0), Eigen::Vector2f(0, kHeight - 1),
        Eigen::Vector2f(kWidth - 1, kHeight - 1)}) {
    const Eigen::Vector2f place = first + unwarp * corner;
    if (!IsInterpolable(image, place.x(), place.y(), 0)) return std::nullopt;
  }
  CorrelationWindow window;
  int squares = 0;
  std::array<float, kWidth> row;
  for (int y = 0; y < kHeight; ++y) {
    const Eigen::Vector2f start = first + static_cast<float>(y) * unwarp.col(1);
    InterpolateRow<kWidth>(image, {start.x(), start.y()}, {unwarp(0, 0), unwarp(1, 0)}, kWidth,
                           row.data());
    for (int x = 0; x < kWidth; ++x) {
      const int brightness = cvRound(row[x]);
      window.brightness_[y * kWidth + x] = static_cast<int16_t>(brightness);
      window.sum_ += brightness;
      squares += brightness * brightness;
    }
  }
  constexpr int kCount = kWidth * kHeight;
  window.deviation_ = Deviation(window.sum_, squares, kCount);
  const float least = kMinContrast * std::sqrt(static_cast<float>(kCount));
  return window.deviation_ < least ? std::nullopt : std::optional(window);
}

float CorrelationWindow::Correlate(const cv::Mat& image, const cv::Point& center) const {
  constexpr int kCount = kWidth * kHeight;
  int sum = 0, squares = 0, products = 0;
  for (int y = 0; y < kHeight; ++y) {
    const uint8_t* row = image.ptr(center.y - kToCenter.y + y) + center.x - kToCenter.x;
    const int16_t* own = brightness_.data() + y * kWidth;
    for (int x = 0; x < kWidth; ++x) {
      const int16_t other = row[x];
      sum += other;
      squares += other * other;
      products += own[x] * other;
    }
  }
  const float deviation = Deviation(sum, squares, kCount);
  const float covariance =
      static_cast<float>(products) - static_cast<float>(sum_) * static_cast<float>(sum) / kCount;
  return deviation > 0 ? covariance / (deviation_ * deviation) : 0.0F;
}

Eigen::Vector2d CorrelationWindow::Climb(const cv::Mat& image, const Eigen::Vector2d& start) const {
  static const cv::Point kWays[] = {{-1, 0}, {1, 0}, {0, -1}, {0, 1}};
  const auto value = [&](const cv::Point& at) {
    return IsInside(image, at) ? Correlate(image, at) : -1.0F;
  };
  cv::Point top(cvRound(start.x()), cvRound(start.y()));
  float best = value(top);
  float around[4] = {};
  for (int step = 0; step < kMaxClimb; ++step) {
    for (int i = 0; i < 4; ++i) around[i] = value(top + kWays[i]);
    const auto highest = std::max_element(around, around + 4);
    if (*highest <= best) {
      return {top.x + Vertex(around[0], best, around[1]),
              top.y + Vertex(around[2], best, around[3])};
    }
    best = *highest;
    top += kWays[highest - around];
  }
  return {static_cast<double>(top.x), static_cast<double>(top.y)};
}

}  // namespace plm_vins
