// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/geometry/plucker.h"

#include <cmath>
#include <stdexcept>

#include "common/geometry/so3.h"

namespace plm_vins {
namespace {

using ConstQuaternionMap = Eigen::Map<const Eigen::Quaterniond>;
using QuaternionMap = Eigen::Map<Eigen::Quaterniond>;

}  // namespace

PluckerLine LineThrough(const Eigen::Vector3d& start, const Eigen::Vector3d& end) {
  return {start.cross(end), end - start};
}

PluckerLine Intersection(const Eigen::Vector3d& a, double alpha, const Eigen::Vector3d& b,
                         double beta) {
  return {beta * a - alpha * b, a.cross(b)};
}

PluckerLine operator*(const Rigid3d& T_A_B, const PluckerLine& line_B) {
  const Eigen::Vector3d direction = T_A_B.rotation * line_B.direction;
  return {T_A_B.rotation * line_B.moment + T_A_B.translation.cross(direction), direction};
}

Eigen::Vector3d NearestToOrigin(const PluckerLine& line) {
  return line.direction.cross(line.moment) / line.direction.squaredNorm();
}

Eigen::Vector3d PointInPlane(const PluckerLine& line, const Eigen::Vector3d& normal) {
  return normal.cross(line.moment) / normal.dot(line.direction);
}

OrthonormalLine ToOrthonormal(const PluckerLine& line) {
  const double moment = line.moment.norm(), direction = line.direction.norm();
  if (!(moment > 0 && direction > 0)) throw std::invalid_argument("line through the origin");
  Eigen::Matrix3d U;
  U.col(0) = line.moment / moment;
  U.col(2) = U.col(0).cross(line.direction).normalized();
  U.col(1) = U.col(2).cross(U.col(0));
  OrthonormalLine result;
  QuaternionMap(result.data()) = Eigen::Quaterniond(U);
  result[4] = std::atan2(direction, moment);
  return result;
}

PluckerLine ToPlucker(const double* line) {
  const Eigen::Matrix3d U = ConstQuaternionMap(line).toRotationMatrix();
  return {std::cos(line[4]) * U.col(0), std::sin(line[4]) * U.col(1)};
}

void LinePlus(const double* x, const double* delta, double* x_plus_delta) {
  const Eigen::Quaterniond turn = SO3Exp(Eigen::Map<const Eigen::Vector3d>(delta));
  QuaternionMap{x_plus_delta} = (ConstQuaternionMap(x) * turn).normalized();
  x_plus_delta[4] = x[4] + delta[3];
}

void LineMinus(const double* y, const double* x, double* y_minus_x) {
  const Eigen::Quaterniond turn = ConstQuaternionMap(x).conjugate() * ConstQuaternionMap(y);
  Eigen::Map<Eigen::Vector3d>{y_minus_x} = SO3Log(turn);
  y_minus_x[3] = y[4] - x[4];
}

PluckerJacobian ToPluckerJacobian(const double* line) {
  const Eigen::Matrix3d U = ConstQuaternionMap(line).toRotationMatrix();
  const double c = std::cos(line[4]), s = std::sin(line[4]);
  PluckerJacobian J;
  J.d_moment << Eigen::Vector3d::Zero(), -c * U.col(2), c * U.col(1), -s * U.col(0);
  J.d_direction << s * U.col(2), Eigen::Vector3d::Zero(), -s * U.col(0), c * U.col(1);
  return J;
}

}  // namespace plm_vins
