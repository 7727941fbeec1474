// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/factors/manifolds.h"

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "common/geometry/so3.h"

namespace plm_vins {
namespace {

using ConstVector3 = Eigen::Map<const Eigen::Vector3d>;
using ConstQuaternion = Eigen::Map<const Eigen::Quaterniond>;

void SetIdentity(int rows, int columns, double* jacobian) {
  using RowMajorMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  Eigen::Map<RowMajorMatrix>(jacobian, rows, columns).setIdentity();
}

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

bool TangentManifold::Plus(const double* x, const double* delta, double* x_plus_delta) const {
  plus_(x, delta, x_plus_delta);
  return true;
}

#if PLM_CERES_HAS_MANIFOLD
bool TangentManifold::PlusJacobian(const double* /*x*/, double* jacobian) const {
  SetIdentity(ambient_size_, tangent_size_, jacobian);
  return true;
}

bool TangentManifold::Minus(const double* y, const double* x, double* y_minus_x) const {
  minus_(y, x, y_minus_x);
  return true;
}

bool TangentManifold::MinusJacobian(const double* /*x*/, double* jacobian) const {
  SetIdentity(tangent_size_, ambient_size_, jacobian);
  return true;
}

void SetManifold(ceres::Problem* problem, double* values, const TangentManifold& manifold) {
  problem->SetManifold(values, new TangentManifold(manifold));  // the problem takes ownership
}
#else
bool TangentManifold::ComputeJacobian(const double* /*x*/, double* jacobian) const {
  SetIdentity(ambient_size_, tangent_size_, jacobian);
  return true;
}

void SetManifold(ceres::Problem* problem, double* values, const TangentManifold& manifold) {
  problem->SetParameterization(values, new TangentManifold(manifold));  // ... takes ownership
}
#endif

}  // namespace plm_vins
