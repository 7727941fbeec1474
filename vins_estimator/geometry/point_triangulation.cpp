// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/geometry/point_triangulation.h"

#include <algorithm>
#include <cmath>

#include "common/geometry/symmetric_system.h"
#include "vins_estimator/geometry/depth_limits.h"

namespace plm_vins {
namespace {

constexpr int kRefinements = 3;  // the point nearest to all rays is a good initial value

Eigen::Vector3d RayInWorld(const PosedPointObservation& observation) {
  return (observation.T_W_C.rotation * observation.xy.homogeneous()).normalized();
}

// Returns the greatest angle between the first ray and any other.
double GreatestAngle(const std::vector<PosedPointObservation>& observations) {
  const Eigen::Vector3d first = RayInWorld(observations.front());
  double greatest = 0;
  for (const PosedPointObservation& observation : observations) {
    greatest = std::max(greatest, first.cross(RayInWorld(observation)).norm());
  }
  return std::asin(std::min(1.0, greatest));
}

// Returns the point with the least sum of squared distances to all rays.
Eigen::Vector3d ClosestPoint(const std::vector<PosedPointObservation>& observations) {
  Eigen::Matrix3d A = Eigen::Matrix3d::Zero();
  Eigen::Vector3d b = Eigen::Vector3d::Zero();
  for (const PosedPointObservation& observation : observations) {
    const Eigen::Vector3d ray = RayInWorld(observation);
    const Eigen::Matrix3d across = Eigen::Matrix3d::Identity() - ray * ray.transpose();
    A += across;
    b += across * observation.T_W_C.translation;
  }
  return SolveSymmetric(A, b);
}

// Refines the point by Gauss-Newton on the reprojection errors.
Eigen::Vector3d RefineOnImages(const std::vector<PosedPointObservation>& observations,
                               Eigen::Vector3d p_W) {
  for (int iteration = 0; iteration < kRefinements; ++iteration) {
    Eigen::Matrix3d H = Eigen::Matrix3d::Zero();
    Eigen::Vector3d g = Eigen::Vector3d::Zero();
    for (const PosedPointObservation& observation : observations) {
      const Eigen::Matrix3d R_C_W = observation.T_W_C.R().transpose();
      const Eigen::Vector3d p_C = R_C_W * (p_W - observation.T_W_C.translation);
      if (p_C.z() < kMinTriangulatedDepth) return p_W;
      Eigen::Matrix<double, 2, 3> J;
      J << 1, 0, -p_C.x() / p_C.z(), 0, 1, -p_C.y() / p_C.z();
      J = J * R_C_W / p_C.z();
      H += J.transpose() * J;
      g += J.transpose() * (p_C.hnormalized() - observation.xy);
    }
    p_W -= SolveSymmetric(H, g);
  }
  return p_W;
}

bool IsInFrontOfAll(const std::vector<PosedPointObservation>& observations,
                    const Eigen::Vector3d& p_W) {
  return std::all_of(observations.begin(), observations.end(),
                     [&p_W](const PosedPointObservation& observation) {
                       return (observation.T_W_C.Inverse() * p_W).z() > kMinTriangulatedDepth;
                     });
}

}  // namespace

std::optional<Eigen::Vector3d> TriangulatePoint(
    const std::vector<PosedPointObservation>& observations, double min_angle) {
  if (observations.size() < 2 || GreatestAngle(observations) < min_angle) return std::nullopt;
  const Eigen::Vector3d p_W = RefineOnImages(observations, ClosestPoint(observations));
  if (!p_W.allFinite() || !IsInFrontOfAll(observations, p_W)) return std::nullopt;
  return p_W;
}

}  // namespace plm_vins
