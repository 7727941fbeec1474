// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <opencv2/core.hpp>
#include <optional>

namespace plm_vins {

// Pose of a patch in an image: the patch pixel p, relative to its center, is at linear * p +
// center.
struct PatchPose {
  Eigen::Matrix2d linear = Eigen::Matrix2d::Identity();
  Eigen::Vector2d center = Eigen::Vector2d::Zero();  // [px]
};

// Appearance of a corner at its detection. Aligning each image with this patch instead of the
// previous image keeps the errors of the flow from accumulating, and models rotation, scale and
// shear of the patch, which flow would confuse with translation.
class CornerPatch {
 public:
  // Extracts the patch around `center` from a CV_8UC1 image. Returns nullopt if it leaves the image
  // or its texture does not constrain an affine warp.
  static std::optional<CornerPatch> Cut(const cv::Mat& image, const Eigen::Vector2d& center);

  // Finds the patch in another image, starting at `start`: least squares over an affine warp, gain
  // and offset by the inverse compositional algorithm [Baker2004]. Returns nullopt if it leaves the
  // image, does not converge near `start`, or looks different there.
  std::optional<PatchPose> Align(const cv::Mat& image, const PatchPose& start) const;

 private:
  static constexpr int kRadius = 7;  // [px]
  static constexpr int kSide = 2 * kRadius + 1;
  static constexpr int kStride = kSide + 1;  // row length in memory, a multiple of the SIMD width
  static constexpr int kParameters = 8;      // linear (row-major), shift, gain, offset

  // Each column is a row of the patch. The last matrix row is padding with zero weight.
  using Pixels = Eigen::Matrix<float, kStride, kSide>;
  using Parameters = Eigen::Matrix<float, kParameters, 1>;
  using Information = Eigen::Matrix<double, kParameters, kParameters>;

  static const Pixels& Weights();
  static std::optional<Pixels> Sample(const cv::Mat& image, const PatchPose& pose);
  static Pixels SampleInside(const cv::Mat& image, const PatchPose& pose);
  Parameters Gradient(const Pixels& difference) const;
  bool LooksLike(const Pixels& pixels) const;

  Pixels pixels_;
  Pixels d_pixels_dx_;  // multiplied by the weights
  Pixels d_pixels_dy_;
  Information covariance_;  // (J W J^T)^-1
};

}  // namespace plm_vins
