// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <opencv2/core.hpp>
#include <optional>

namespace plm_vins {

// The surroundings of a point in one image, warped to their expected appearance in another image.
// They are compared with whole pixels of that image by zero-mean normalized cross-correlation
// (ZNCC), which is invariant to gain and offset of the brightness.
class CorrelationWindow {
 public:
  // `warp` is d(pixel in the other image)/d(pixel in `image`, CV_8UC1). Returns nullopt if the
  // window leaves the image, the warp is not invertible, or there is no texture.
  static std::optional<CorrelationWindow> Cut(const cv::Mat& image, const Eigen::Vector2d& center,
                                              const Eigen::Matrix2d& warp);

  // Returns the ZNCC, -1 to 1, with the window around `center` in the other image, if inside it.
  float Correlate(const cv::Mat& image, const cv::Point& center) const;

  // Returns the maximum of the correlation at most a few pixels from `start`, interpolated between
  // pixels by the parabola through its neighbors.
  Eigen::Vector2d Climb(const cv::Mat& image, const Eigen::Vector2d& start) const;

  static bool IsInside(const cv::Mat& image, const cv::Point& center) {
    const cv::Point corner = center - kToCenter;
    return corner.x >= 0 && corner.y >= 0 && corner.x + kWidth <= image.cols &&
           corner.y + kHeight <= image.rows;
  }

 private:
  static constexpr int kWidth = 16;  // a multiple of the processor's vectors
  static constexpr int kHeight = 11;
  static inline const cv::Point kToCenter = {kWidth / 2, kHeight / 2};

  std::array<int16_t, kWidth * kHeight> brightness_;
  int sum_ = 0;
  float deviation_ = 0;  // root of the sum of squares about the mean
};

}  // namespace plm_vins
