// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/solver/ceres_manifold.h"

#include <Eigen/Core>

namespace plm_vins {
namespace {

void SetIdentity(int rows, int columns, double* jacobian) {
  using RowMajorMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  Eigen::Map<RowMajorMatrix>(jacobian, rows, columns).setIdentity();
}

}  // namespace

bool TangentManifold::Plus(const double* x, const double* delta, double* x_plus_delta) const {
  type_.plus(x, delta, x_plus_delta);
  return true;
}

#if PLM_CERES_HAS_MANIFOLD
bool TangentManifold::PlusJacobian(const double* /*x*/, double* jacobian) const {
  SetIdentity(type_.ambient_size, type_.tangent_size, jacobian);
  return true;
}

bool TangentManifold::Minus(const double* y, const double* x, double* y_minus_x) const {
  type_.minus(y, x, y_minus_x);
  return true;
}

bool TangentManifold::MinusJacobian(const double* /*x*/, double* jacobian) const {
  SetIdentity(type_.tangent_size, type_.ambient_size, jacobian);
  return true;
}

void SetManifold(ceres::Problem* problem, double* values, const VariableType& type) {
  problem->SetManifold(values, new TangentManifold(type));  // the problem takes ownership
}
#else
bool TangentManifold::ComputeJacobian(const double* /*x*/, double* jacobian) const {
  SetIdentity(type_.ambient_size, type_.tangent_size, jacobian);
  return true;
}

void SetManifold(ceres::Problem* problem, double* values, const VariableType& type) {
  problem->SetParameterization(values, new TangentManifold(type));  // the problem takes ownership
}
#endif

}  // namespace plm_vins
