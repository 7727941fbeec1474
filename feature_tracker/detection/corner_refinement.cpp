// SPDX-License-Identifier: BSD-3-Clause
#include "feature_tracker/detection/corner_refinement.h"

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/imgproc.hpp>

namespace plm_vins {
namespace {

constexpr int kRadius = kRefinementRadius_px;
constexpr int kMaxIterations = 20;
constexpr float kConverged_px = 0.01F;
constexpr double kMinConditioning = 1e-3;  // smallest over largest eigenvalue of the equations

// Gaussian weights, falling to 1/e at the window's edge.
std::array<float, 2 * kRadius + 1> WindowWeights() {
  std::array<float, 2 * kRadius + 1> weights{};
  for (int i = -kRadius; i <= kRadius; ++i) {
    weights[i + kRadius] = std::exp(-static_cast<float>(i * i) / (kRadius * kRadius));
  }
  return weights;
}

// Returns the correction of the corner [px] from the patch around it. `patch` has a margin of one
// pixel around the window.
std::optional<cv::Point2f> Step(const cv::Mat_<float>& patch) {
  static const auto weights = WindowWeights();
  Eigen::Matrix2d A = Eigen::Matrix2d::Zero();
  Eigen::Vector2d b = Eigen::Vector2d::Zero();
  for (int y = -kRadius; y <= kRadius; ++y) {
    for (int x = -kRadius; x <= kRadius; ++x) {
      const int row = y + kRadius + 1;
      const int column = x + kRadius + 1;
      const Eigen::Vector2d gradient(patch(row, column + 1) - patch(row, column - 1),
                                     patch(row + 1, column) - patch(row - 1, column));
      const Eigen::Matrix2d G =
          weights[x + kRadius] * weights[y + kRadius] * gradient * gradient.transpose();
      A += G;
      b += G * Eigen::Vector2d(x, y);
    }
  }
  // Eigenvalues of ratio k have the determinant k / (1 + k)^2 times the squared trace.
  constexpr double kMinDeterminant =
      kMinConditioning / ((1 + kMinConditioning) * (1 + kMinConditioning));
  if (!(A.determinant() > kMinDeterminant * A.trace() * A.trace())) return std::nullopt;
  const Eigen::Vector2d step = A.inverse() * b;
  return cv::Point2f(static_cast<float>(step.x()), static_cast<float>(step.y()));
}

float MaxNorm(const cv::Point2f& v) { return std::max(std::abs(v.x), std::abs(v.y)); }

}  // namespace

bool IsRefinementWindowInside(const cv::Size& image_size, const cv::Point2f& point) {
  constexpr float kBorder = kRadius + 1;
  return point.x >= kBorder && point.y >= kBorder &&
         point.x <= static_cast<float>(image_size.width - 1) - kBorder &&
         point.y <= static_cast<float>(image_size.height - 1) - kBorder;
}

std::optional<cv::Point2f> RefineCorner(const cv::Mat& image, const cv::Point2f& start) {
  constexpr int kPatchSize = 2 * (kRadius + 1) + 1;
  cv::Mat_<float> patch;
  cv::Point2f corner = start;
  for (int i = 0; i < kMaxIterations; ++i) {
    if (!IsRefinementWindowInside(image.size(), corner)) return std::nullopt;
    cv::getRectSubPix(image, {kPatchSize, kPatchSize}, corner, patch, CV_32F);
    const auto step = Step(patch);
    if (!step) return std::nullopt;
    corner += *step;
    if (!(MaxNorm(corner - start) <= kRadius)) return std::nullopt;
    if (MaxNorm(*step) < kConverged_px) break;
  }
  if (!IsRefinementWindowInside(image.size(), corner)) return std::nullopt;
  return corner;
}

}  // namespace plm_vins
