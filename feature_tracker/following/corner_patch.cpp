// SPDX-License-Identifier: BSD-3-Clause
#include "feature_tracker/following/corner_patch.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "tracking/images/image_sampling.h"

namespace plm_vins {
namespace {

constexpr float kSigma_px = 5.0F;  // width of the weights: distant pixels may differ in depth
constexpr int kMaxSteps = 12;
constexpr double kAligned_px = 0.03;
constexpr double kMaxShift_px = 1.5;      // largest distance from the result of the flow
constexpr float kMinCorrelation = 0.85F;  // least correlation of the aligned pixels with the patch
constexpr double kMaxGrowth = 3.0;        // largest change of the patch's area, as a factor
constexpr float kMinGain = 0.3F;
constexpr double kMinPivot = 1e-6;  // pivot of the normal equations; flat patches have less

// Returns whether the patch, with a margin of one pixel for derivatives, is inside the image.
bool IsInside(const cv::Mat& image, const PatchPose& pose, int radius) {
  const Eigen::Vector2d reach =
      radius * (pose.linear.col(0).cwiseAbs() + pose.linear.col(1).cwiseAbs());
  const Eigen::Vector2f least = (pose.center - reach).cast<float>();
  const Eigen::Vector2f most = (pose.center + reach).cast<float>();
  return IsInterpolable(image, least.x(), least.y(), 1) &&
         IsInterpolable(image, most.x(), most.y(), 1);
}

}  // namespace

const CornerPatch::Pixels& CornerPatch::Weights() {
  static const Pixels weights = [] {
    Pixels w = Pixels::Zero();
    for (int y = 0; y < kSide; ++y) {
      for (int x = 0; x < kSide; ++x) {
        const Eigen::Vector2f p(x - kRadius, y - kRadius);
        w(x, y) = std::exp(-p.squaredNorm() / (2 * kSigma_px * kSigma_px));
      }
    }
    return Pixels(w / w.sum());
  }();
  return weights;
}

std::optional<CornerPatch::Pixels> CornerPatch::Sample(const cv::Mat& image,
                                                       const PatchPose& pose) {
  if (!IsInside(image, pose, kRadius)) return std::nullopt;
  return SampleInside(image, pose);
}

CornerPatch::Pixels CornerPatch::SampleInside(const cv::Mat& image, const PatchPose& pose) {
  const Eigen::Matrix2f linear = pose.linear.cast<float>();
  const Eigen::Vector2f center = pose.center.cast<float>();
  Pixels pixels;
  for (int y = 0; y < kSide; ++y) {
    const Eigen::Vector2f start = center + linear * Eigen::Vector2f(-kRadius, y - kRadius);
    InterpolateRow<kStride>(image, {start.x(), start.y()}, {linear(0, 0), linear(1, 0)}, kSide,
                            pixels.col(y).data());
  }
  return pixels;
}

// Gradient of half the weighted squared error: J W difference.
CornerPatch::Parameters CornerPatch::Gradient(const Pixels& difference) const {
  constexpr int kLanes = 4;
  const Pixels& weights = Weights();
  using Lanes = Eigen::Matrix<float, kLanes, 1>;
  Parameters gradient = Parameters::Zero();
  for (int x = 0; x < kStride; x += kLanes) {
    Lanes by_x = Lanes::Zero(), by_x_y = Lanes::Zero(), by_y = Lanes::Zero(),
          by_y_y = Lanes::Zero(), by_gain = Lanes::Zero(), by_offset = Lanes::Zero();
    for (int y = 0; y < kSide; ++y) {
      const Lanes d = difference.block<kLanes, 1>(x, y);
      const Lanes dx = d.cwiseProduct(d_pixels_dx_.block<kLanes, 1>(x, y));
      const Lanes dy = d.cwiseProduct(d_pixels_dy_.block<kLanes, 1>(x, y));
      const Lanes weighted = d.cwiseProduct(weights.block<kLanes, 1>(x, y));
      by_x += dx;
      by_y += dy;
      by_x_y += dx * static_cast<float>(y - kRadius);
      by_y_y += dy * static_cast<float>(y - kRadius);
      by_gain += weighted.cwiseProduct(pixels_.block<kLanes, 1>(x, y));
      by_offset += weighted;
    }
    const Lanes column = Lanes::LinSpaced(x - kRadius, x - kRadius + kLanes - 1);
    gradient += (Parameters() << by_x.dot(column), by_x_y.sum(), by_y.dot(column), by_y_y.sum(),
                 by_x.sum(), by_y.sum(), by_gain.sum(), by_offset.sum())
                    .finished();
  }
  return gradient;
}

std::optional<CornerPatch> CornerPatch::Cut(const cv::Mat& image, const Eigen::Vector2d& center) {
  const Eigen::Matrix2d identity = Eigen::Matrix2d::Identity();
  const auto pixels = Sample(image, {identity, center});
  if (!pixels) return std::nullopt;
  const auto slope = [&](const Eigen::Vector2d& half) -> Pixels {
    return (SampleInside(image, {identity, center + half}) -
            SampleInside(image, {identity, center - half})) /
           2;
  };
  const Pixels dx = slope(Eigen::Vector2d::UnitX());
  const Pixels dy = slope(Eigen::Vector2d::UnitY());
  CornerPatch patch;
  patch.pixels_ = *pixels;
  patch.d_pixels_dx_ = dx.cwiseProduct(Weights());
  patch.d_pixels_dy_ = dy.cwiseProduct(Weights());

  const Eigen::DiagonalMatrix<float, kStride> x(
      Eigen::Matrix<float, kStride, 1>::LinSpaced(-kRadius, kRadius + 1));
  const Eigen::DiagonalMatrix<float, kSide> y(
      Eigen::Matrix<float, kSide, 1>::LinSpaced(-kRadius, kRadius));
  Eigen::Matrix<float, kParameters, kParameters> H;  // J W J^T, column by column of J^T
  H << patch.Gradient(x * dx), patch.Gradient(dx * y), patch.Gradient(x * dy),
      patch.Gradient(dy * y), patch.Gradient(dx), patch.Gradient(dy), patch.Gradient(*pixels),
      patch.Gradient(Pixels::Ones());
  const Eigen::LDLT<Information> factor(H.cast<double>());
  if (!(factor.vectorD().minCoeff() > kMinPivot)) return std::nullopt;
  patch.covariance_ = factor.solve(Information::Identity());
  return patch;
}

std::optional<PatchPose> CornerPatch::Align(const cv::Mat& image, const PatchPose& start) const {
  PatchPose pose = start;
  for (int i = 0; i < kMaxSteps; ++i) {
    const auto pixels = Sample(image, pose);
    if (!pixels) return std::nullopt;
    const Parameters step =
        (covariance_ * Gradient(*pixels - pixels_).cast<double>()).cast<float>();
    // A gain scales the image gradients, and so the step.
    const Eigen::Matrix<double, 6, 1> warp =
        step.head<6>().cast<double>() / std::max(1 + step[6], kMinGain);
    Eigen::Matrix2d deformation;
    deformation << 1 + warp[0], warp[1], warp[2], 1 + warp[3];
    pose.linear = pose.linear * deformation.inverse();
    const Eigen::Vector2d shift = pose.linear * warp.tail<2>();
    pose.center -= shift;
    const double growth = pose.linear.determinant();
    if (!(growth < kMaxGrowth && growth > 1 / kMaxGrowth)) return std::nullopt;
    if (!((pose.center - start.center).norm() < kMaxShift_px)) return std::nullopt;
    if (shift.norm() > kAligned_px) continue;
    return LooksLike(*pixels) ? std::optional(pose) : std::nullopt;
  }
  return std::nullopt;
}

// Compares by weighted correlation, which is invariant to gain and offset.
bool CornerPatch::LooksLike(const Pixels& pixels) const {
  const auto product_of = [](const Pixels& a, const Pixels& b) {
    return a.cwiseProduct(Weights()).cwiseProduct(b).sum();
  };
  const Pixels a = pixels.array() - pixels.cwiseProduct(Weights()).sum();
  const Pixels b = pixels_.array() - pixels_.cwiseProduct(Weights()).sum();
  const float product = product_of(a, b);
  const float squares = product_of(a, a) * product_of(b, b);
  return product > 0 && product * product > kMinCorrelation * kMinCorrelation * squares;
}

}  // namespace plm_vins
