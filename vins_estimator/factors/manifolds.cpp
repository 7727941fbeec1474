// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/factors/manifolds.h"

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cmath>

#include "common/geometry/so3.h"
#include "common/geometry/tangent_basis.h"

namespace plm_vins {
namespace {

using ConstVector3 = Eigen::Map<const Eigen::Vector3d>;
using ConstQuaternion = Eigen::Map<const Eigen::Quaterniond>;

}  // namespace

void PosePlus(const double* x, const double* delta, double* x_plus_delta) {
  Eigen::Map<Eigen::Vector3d> position(x_plus_delta);
  Eigen::Map<Eigen::Quaterniond> rotation(x_plus_delta + 3);
  position = ConstVector3(x) + ConstVector3(delta);
  rotation = (ConstQuaternion(x + 3) * SO3Exp(ConstVector3(delta + 3))).normalized();
}

void PoseMinus(const double* y, const double* x, double* y_minus_x) {
  Eigen::Map<Eigen::Vector3d> position(y_minus_x);
  Eigen::Map<Eigen::Vector3d> rotation(y_minus_x + 3);
  position = ConstVector3(y) - ConstVector3(x);
  rotation = SO3Log(ConstQuaternion(x + 3).conjugate() * ConstQuaternion(y + 3));
}

void MountingPlus(const double* x, const double* delta, double* x_plus_delta) {
  const Eigen::Vector3d t = ConstVector3(x);
  const Eigen::Vector3d turn =
      TangentBasis(t.normalized()) * Eigen::Map<const Eigen::Vector2d>(delta);
  Eigen::Map<Eigen::Vector3d> baseline(x_plus_delta);
  Eigen::Map<Eigen::Quaterniond> rotation(x_plus_delta + 3);
  baseline = std::exp(delta[2]) * (SO3Exp(turn) * t);
  rotation = (ConstQuaternion(x + 3) * SO3Exp(ConstVector3(delta + 3))).normalized();
}

void MountingMinus(const double* y, const double* x, double* y_minus_x) {
  const Eigen::Vector3d from = ConstVector3(x), to = ConstVector3(y);
  Eigen::Map<Eigen::Vector2d> direction(y_minus_x);
  Eigen::Map<Eigen::Vector3d> rotation(y_minus_x + 3);
  direction = TangentBasis(from.normalized()).transpose() * SO3Log(ShortestRotation(from, to));
  y_minus_x[2] = std::log(to.norm() / from.norm());
  rotation = SO3Log(ConstQuaternion(x + 3).conjugate() * ConstQuaternion(y + 3));
}

Eigen::Matrix3d BaselineByTangent(const Eigen::Vector3d& baseline) {
  Eigen::Matrix3d derivative;
  derivative << -Skew(baseline) * TangentBasis(baseline.normalized()), baseline;
  return derivative;
}

}  // namespace plm_vins
