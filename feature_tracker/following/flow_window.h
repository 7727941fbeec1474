// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <opencv2/core.hpp>
#include <optional>
#include <vector>

namespace plm_vins {

// A square window around a point of one image, to be found in another: one step of Lucas-Kanade
// flow [Lucas1981, Bouguet2001]. Pixels are sampled in fixed point, of which SIMD processes eight
// at once. Gradients are computed from these samples: gradient images computed in advance would
// have left the caches by the time they are used.
//
// The images are CV_8UC1 regions of larger images, with a border on each side.
class FlowWindow {
 public:
  static int Border(int side);  // smallest border that images need [px]

  explicit FlowWindow(int side);

  // Extracts the window around `center` [px]. Returns false if it is entirely outside the image, or
  // if its texture does not constrain both directions of motion.
  bool Cut(const cv::Mat& image, const cv::Point2f& center);

  // Returns the first-order step from `center` [px] in another image toward the window. Returns
  // nullopt if the window is entirely outside the image.
  std::optional<cv::Point2f> Step(const cv::Mat& image, const cv::Point2f& center);

 private:
  bool ShowsImage(const cv::Mat& image, const cv::Point2f& corner) const;
  cv::Point2f CornerOf(const cv::Point2f& center) const;
  void TakeSlopes();
  void Center(std::vector<int16_t>* slopes) const;
  bool InvertInformation();

  int side_;
  int columns_;                    // row length in memory: the side, rounded up to the SIMD width
  int wide_columns_;               // row length with a margin of one pixel
  std::vector<int16_t> wide_;      // samples of the window with a margin of one pixel
  std::vector<int16_t> samples_;   // samples of the other image
  std::vector<int16_t> slopes_x_;  // minus their mean; zero beyond the side
  std::vector<int16_t> slopes_y_;
  Eigen::Matrix2f covariance_;  // covariance of a step, for unit noise of the samples
};

}  // namespace plm_vins
