// SPDX-License-Identifier: BSD-3-Clause
#include "feature_tracker/corner_patch.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "tracking/image_sampling.h"

namespace plm_vins {
namespace {

constexpr float kSigma_px = 5.0F;  // of the weights: what is far from the corner may be elsewhere
constexpr int kMaxIterations = 12;
constexpr double kConverged_px = 0.03;
constexpr double kMaxShift_px = 1.5;      // from where the flow ended; else one of them is wrong
constexpr float kMinCorrelation = 0.85F;  // of what is seen with the patch
constexpr double kMaxGrowth = 3.0;        // of its area, or one over it
constexpr float kMinGain = 0.3F;
constexpr double kMinPivot = 1e-6;  // of the normal equations; less of a flat patch

// With one pixel more around it, for derivatives.
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
    Pixels w;
    for (int i = 0; i < kCount; ++i) {
      const Eigen::Vector2f p(i % kSide - kRadius, i / kSide - kRadius);
      w[i] = std::exp(-p.squaredNorm() / (2 * kSigma_px * kSigma_px));
    }
    return Pixels(w / w.sum());
  }();
  return weights;
}

std::optional<CornerPatch::Pixels> CornerPatch::Sample(const cv::Mat& image,
                                                       const PatchPose& pose) {
  if (!IsInside(image, pose, kRadius)) return std::nullopt;
  const Eigen::Matrix2f linear = pose.linear.cast<float>();
  const Eigen::Vector2f center = pose.center.cast<float>();
  Pixels pixels;
  for (int y = -kRadius, i = 0; y <= kRadius; ++y) {
    Eigen::Vector2f point = center + linear * Eigen::Vector2f(-kRadius, y);
    for (int x = -kRadius; x <= kRadius; ++x, ++i, point += linear.col(0)) {
      pixels[i] = Interpolate(image, point.x(), point.y());
    }
  }
  return pixels;
}

CornerPatch::ByParameter CornerPatch::Derivatives(const cv::Mat& image,
                                                  const Eigen::Vector2d& center,
                                                  const Pixels& pixels) {
  ByParameter J;
  for (int y = -kRadius, i = 0; y <= kRadius; ++y) {
    for (int x = -kRadius; x <= kRadius; ++x, ++i) {
      const float u = static_cast<float>(center.x()) + x;
      const float v = static_cast<float>(center.y()) + y;
      const float gx = (Interpolate(image, u + 1, v) - Interpolate(image, u - 1, v)) / 2;
      const float gy = (Interpolate(image, u, v + 1) - Interpolate(image, u, v - 1)) / 2;
      J.col(i) << gx * x, gx * y, gy * x, gy * y, gx, gy, pixels[i], 1;
    }
  }
  return J;
}

std::optional<CornerPatch> CornerPatch::Cut(const cv::Mat& image, const Eigen::Vector2d& center) {
  const auto pixels = Sample(image, {Eigen::Matrix2d::Identity(), center});
  if (!pixels) return std::nullopt;
  const ByParameter J = Derivatives(image, center, *pixels);
  const ByParameter weighted = J * Weights().asDiagonal();
  const Eigen::Matrix<double, kParameters, kParameters> H =
      (weighted * J.transpose()).cast<double>();
  const Eigen::LDLT<Eigen::Matrix<double, kParameters, kParameters>> factor(H);
  if (!(factor.vectorD().minCoeff() > kMinPivot)) return std::nullopt;
  CornerPatch patch;
  patch.pixels_ = *pixels;
  patch.step_from_difference_ = factor.solve(weighted.cast<double>()).cast<float>();
  return patch;
}

std::optional<PatchPose> CornerPatch::Align(const cv::Mat& image, const PatchPose& start) const {
  PatchPose pose = start;
  for (int i = 0; i < kMaxIterations; ++i) {
    const auto pixels = Sample(image, pose);
    if (!pixels) return std::nullopt;
    const Parameters step = step_from_difference_ * (*pixels - pixels_);
    // Gain scales the gradients as well.
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
    if (shift.norm() > kConverged_px) continue;
    return LooksLike(*pixels) ? std::optional(pose) : std::nullopt;
  }
  return std::nullopt;
}

// By the weighted correlation, which gain and offset do not change.
bool CornerPatch::LooksLike(const Pixels& pixels) const {
  const Pixels& weights = Weights();
  const Pixels a = pixels.array() - pixels.dot(weights);
  const Pixels b = pixels_.array() - pixels_.dot(weights);
  const Pixels weighted = a.cwiseProduct(weights);
  const float product = weighted.dot(b);
  const float squares = weighted.dot(a) * b.cwiseProduct(weights).dot(b);
  return product > 0 && product * product > kMinCorrelation * kMinCorrelation * squares;
}

}  // namespace plm_vins
