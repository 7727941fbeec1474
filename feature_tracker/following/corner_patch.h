// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <opencv2/core.hpp>
#include <optional>

namespace plm_vins {

// Where a patch lies in an image: its pixel p, from its centre, at  linear * p + center.
struct PatchPose {
  Eigen::Matrix2d linear = Eigen::Matrix2d::Identity();
  Eigen::Vector2d center = Eigen::Vector2d::Zero();  // [px]
};

// What a corner looked like when it was found. Aligning every image with that, rather than each
// with the one before, keeps the errors of the flow from adding up, and follows how the patch
// turns, grows and shears, which flow takes for motion.
class CornerPatch {
 public:
  // The pixels around `center` of a grey image of 8 bits. Nothing where they leave the image, or
  // do not fix an affine warp.
  static std::optional<CornerPatch> Cut(const cv::Mat& image, const Eigen::Vector2d& center);

  // Where the patch lies in another image, beginning at `start`: the least squares over an affine
  // warp, gain and offset, by the inverse compositional algorithm [Baker2004]. Nothing where it
  // leaves the image, does not converge near `start`, or what is there looks different.
  std::optional<PatchPose> Align(const cv::Mat& image, const PatchPose& start) const;

 private:
  static constexpr int kRadius = 7;  // [px]
  static constexpr int kSide = 2 * kRadius + 1;
  static constexpr int kStride = kSide + 1;  // of rows in memory, for the processor's vectors
  static constexpr int kParameters = 8;      // linear, by rows; shift; gain; offset

  // A column for each row of the patch. The last row holds nothing and has no weight.
  using Pixels = Eigen::Matrix<float, kStride, kSide>;
  using Parameters = Eigen::Matrix<float, kParameters, 1>;
  using Information = Eigen::Matrix<double, kParameters, kParameters>;

  static const Pixels& Weights();
  static std::optional<Pixels> Sample(const cv::Mat& image, const PatchPose& pose);
  static Pixels SampleInside(const cv::Mat& image, const PatchPose& pose);
  Parameters Gradient(const Pixels& difference) const;
  bool LooksLike(const Pixels& pixels) const;

  Pixels pixels_;
  Pixels d_pixels_dx_;  // with their weights
  Pixels d_pixels_dy_;
  Information covariance_;  // (J W J^T)^-1
};

}  // namespace plm_vins
