// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/factors/manifolds.h"

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "common/geometry/so3.h"

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

}  // namespace plm_vins
