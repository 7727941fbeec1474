// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <opencv2/core.hpp>
#include <optional>
#include <vector>

namespace plm_vins {

// A square window around a point of one image, which is looked for in another: one step of
// Lucas-Kanade flow [Lucas1981, Bouguet2001]. Pixels are sampled in fixed point, of which the
// processor handles eight at once. Slopes are taken of the samples; those of whole images would
// be kept from one image to the next, and by then have left the processor's caches.
//
// The images are grey, of 8 bits, and parts of larger ones, with a border on each side.
class FlowWindow {
 public:
  static int Border(int side);  // that images need at least [px]

  explicit FlowWindow(int side);

  // Takes the window around `center` [px]. False where nothing of it lies in the image, or where
  // too little texture shows both directions of motion.
  bool Cut(const cv::Mat& image, const cv::Point2f& center);

  // From `center` [px] in another image towards where the window lies, to first order. Nothing
  // where nothing of it lies in the image.
  std::optional<cv::Point2f> Step(const cv::Mat& image, const cv::Point2f& center);

 private:
  bool ShowsImage(const cv::Mat& image, const cv::Point2f& corner) const;
  cv::Point2f CornerOf(const cv::Point2f& center) const;
  void TakeSlopes();
  bool InvertInformation();

  int side_;
  int columns_;                    // of a row in memory: the side, in whole vectors
  int wide_columns_;               // of one with a pixel more on each side
  std::vector<int16_t> wide_;      // samples of the window, with a pixel more on each side
  std::vector<int16_t> samples_;   // of the other image
  std::vector<int16_t> slopes_x_;  // without weight beyond the side
  std::vector<int16_t> slopes_y_;
  Eigen::Matrix2f covariance_;  // of a step, for samples of unit noise
};

}  // namespace plm_vins
