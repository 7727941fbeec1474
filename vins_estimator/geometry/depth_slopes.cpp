// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/geometry/depth_slopes.h"

#include <cmath>

#include "common/geometry/symmetric_system.h"

namespace plm_vins {
namespace {

constexpr double kRadius = 0.25;  // of the points nearby, normalized
constexpr int kLeastPoints = 5;
constexpr double kLeastSpread = 0.04;  // of the points across any direction, normalized
constexpr double kFlat = 0.03;         // largest rms distance from the plane, relative

// Returns the slope of the plane through the points near one of them.
Eigen::Vector2d SlopeAt(const PointObservation& at, const PointFrame& frame) {
  Eigen::Matrix3d squares = Eigen::Matrix3d::Zero();
  Eigen::Vector3d products = Eigen::Vector3d::Zero();
  double sum = 0;
  int count = 0;
  for (const PointObservation& point : frame.points) {
    const Eigen::Vector2d difference = point.xy - at.xy;
    if (!point.depth || point.camera != at.camera || difference.norm() > kRadius) continue;
    const Eigen::Vector3d row(difference.x(), difference.y(), 1);
    const double value = 1 / *point.depth - 1 / *at.depth;
    squares += row * row.transpose();
    products += value * row;
    sum += value * value;
    ++count;
  }
  if (count < kLeastPoints) return Eigen::Vector2d::Zero();
  const Eigen::Matrix2d scatter =
      (squares.topLeftCorner<2, 2>() -
       squares.topRightCorner<2, 1>() * squares.topRightCorner<2, 1>().transpose() / count) /
      count;
  const double least =
      0.5 * (scatter.trace() - std::hypot(scatter(0, 0) - scatter(1, 1), 2 * scatter(0, 1)));
  if (least < kLeastSpread * kLeastSpread) return Eigen::Vector2d::Zero();
  const Eigen::Vector3d plane = SolveSymmetric(squares, products);
  const double distance = sum - plane.dot(products);
  if (distance > std::pow(kFlat / *at.depth, 2) * (count - 3)) return Eigen::Vector2d::Zero();
  return plane.head<2>();
}

}  // namespace

std::vector<Eigen::Vector2d> DepthSlopes(const PointFrame& frame) {
  std::vector<Eigen::Vector2d> slopes(frame.points.size(), Eigen::Vector2d::Zero());
  for (size_t i = 0; i < slopes.size(); ++i) {
    if (frame.points[i].depth) slopes[i] = SlopeAt(frame.points[i], frame);
  }
  return slopes;
}

}  // namespace plm_vins
