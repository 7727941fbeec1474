// SPDX-License-Identifier: BSD-3-Clause
#include "tracking/stereo/camera_pair.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <utility>

namespace plm_vins {
namespace {

// The curve is projected at nodes this far apart and is straight between them: with the strongest
// usual distortion it deviates by a hundredth of a pixel.
constexpr double kNodeDistance_px = 10.0;
constexpr double kMaxChange = 4.0;  // largest factor between successive steps of inverse depth
constexpr int kMaxNodes = 400;
constexpr double kMinBaseline = 1e-6;     // [m]
constexpr double kMinDepthRatio = 1e-3;   // ratio of the depths in the two cameras
constexpr double kMinDeterminant = 1e-6;  // determinant of the projection's derivative [px^2]

}  // namespace

CameraPair::CameraPair(std::shared_ptr<const CameraModel> first,
                       std::shared_ptr<const CameraModel> second, const Rigid3d& T_S_C,
                       const StereoPair& numbers)
    : first_(std::move(first)),
      second_(std::move(second)),
      T_S_C_(T_S_C),
      R_S_C_(T_S_C.R()),
      numbers_(numbers) {}

std::optional<Eigen::Vector2d> CameraPair::Project(const Eigen::Vector2d& xy,
                                                   double inverse_depth) const {
  return second_->Project(R_S_C_ * xy.homogeneous() + inverse_depth * T_S_C_.translation);
}

std::optional<Eigen::Vector2d> CameraPair::Transfer(const Eigen::Vector2d& xy,
                                                    double inverse_depth) const {
  const Eigen::Vector3d p_S = R_S_C_ * xy.homogeneous() + inverse_depth * T_S_C_.translation;
  if (!(p_S.z() > kMinDepthRatio)) return std::nullopt;
  return p_S.hnormalized();
}

// The point R x + rho t of S is parallel to the ray b: (R x + rho t) x b = 0.
double CameraPair::InverseDepth(const Eigen::Vector2d& xy, const Eigen::Vector2d& xy_S) const {
  const Eigen::Vector3d b = xy_S.homogeneous();
  const Eigen::Vector3d far = (R_S_C_ * xy.homogeneous()).cross(b);
  const Eigen::Vector3d per_inverse_depth = T_S_C_.translation.cross(b);
  return -far.dot(per_inverse_depth) /
         std::max(per_inverse_depth.squaredNorm(), kMinBaseline * kMinBaseline);
}

double CameraPair::InverseDepthPerPixel() const {
  return 1 / (second_->FocalLength() * std::max(T_S_C_.translation.norm(), kMinBaseline));
}

std::optional<Eigen::Matrix2d> CameraPair::Warp(const Eigen::Vector2d& xy,
                                                double inverse_depth) const {
  const Eigen::Vector3d p_S = R_S_C_ * xy.homogeneous() + inverse_depth * T_S_C_.translation;
  Eigen::Matrix<double, 2, 3> d_first_d_ray, d_second_d_point;
  if (!first_->Project(xy.homogeneous(), &d_first_d_ray)) return std::nullopt;
  if (!second_->Project(p_S, &d_second_d_point)) return std::nullopt;
  const Eigen::Matrix2d d_second_d_xy = d_second_d_point * R_S_C_.leftCols<2>();
  const Eigen::Matrix2d d_first_d_xy = d_first_d_ray.leftCols<2>();
  if (std::abs(d_first_d_xy.determinant()) < kMinDeterminant) return std::nullopt;
  return d_second_d_xy * d_first_d_xy.inverse();
}

std::vector<CurvePoint> CameraPair::Curve(const Eigen::Vector2d& xy, double from, double to) const {
  std::vector<CurvePoint> curve;
  double step = kNodeDistance_px * InverseDepthPerPixel();
  std::optional<CurvePoint> last;
  double inverse_depth = from;
  for (int i = 0; i < kMaxNodes; ++i) {
    const auto pixel = Project(xy, inverse_depth);
    if (!pixel && last) break;
    if (pixel) {
      const CurvePoint node{inverse_depth, *pixel};
      if (last) {
        const double length_px = (*pixel - last->pixel).norm();
        AppendBetween(*last, node, length_px, &curve);
        step *=
            std::clamp(kNodeDistance_px / std::max(length_px, 1e-6), 1 / kMaxChange, kMaxChange);
      }
      last = node;
    }
    if (inverse_depth >= to) break;
    inverse_depth = std::min(inverse_depth + step, to);
  }
  if (last && second_->IsInImage(last->pixel)) curve.push_back(*last);
  return curve;
}

void CameraPair::AppendBetween(const CurvePoint& from, const CurvePoint& to, double length_px,
                               std::vector<CurvePoint>* curve) const {
  const int count = std::max(static_cast<int>(std::ceil(length_px)), 1);
  for (int i = 0; i < count; ++i) {
    const double share = static_cast<double>(i) / count;
    const CurvePoint point{from.inverse_depth + share * (to.inverse_depth - from.inverse_depth),
                           from.pixel + share * (to.pixel - from.pixel)};
    if (second_->IsInImage(point.pixel)) curve->push_back(point);
  }
}

CameraPair CameraPairOf(const SensorConfig& sensor, const StereoPair& numbers) {
  const CameraSensor &first = sensor.cameras[numbers.first],
                     &second = sensor.cameras[numbers.second];
  return {CameraModel::Create(first.parameters), CameraModel::Create(second.parameters),
          second.T_B_C.Inverse() * first.T_B_C, numbers};
}

}  // namespace plm_vins
