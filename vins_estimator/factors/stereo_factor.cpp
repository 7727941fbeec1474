// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/factors/stereo_factor.h"

#include <cmath>

#include "vins_estimator/factors/line_chain.h"
#include "vins_estimator/factors/point_chain.h"
#include "vins_estimator/geometry/depth_limits.h"

namespace plm_vins {
namespace {

using Vector2Map = Eigen::Map<Eigen::Vector2d>;
using PointJacobian = Eigen::Map<Eigen::Matrix<double, 2, kPointSize, Eigen::RowMajor>>;

// Projects a point of the first camera into the second one.
struct RightProjection {
  RightProjection(const PoseBlock& mounting, const Eigen::Vector3d& p_C)
      : T_C_C1(mounting), p_C1(T_C_C1.R.transpose() * (p_C - T_C_C1.p)) {}

  bool IsInFront() const { return p_C1.z() > kMinProjectedDepth; }

  // Returns the derivative by p_C; writes that by the mounting unless the pointer is null.
  Matrix23d Differentiate(double weight, double* mounting_jacobian) const {
    const Matrix23d d_r_d_pC1 = ProjectionJacobian(p_C1, weight);
    const Matrix23d d_r_d_pC = d_r_d_pC1 * T_C_C1.R.transpose();
    if (mounting_jacobian) {
      SetMountingJacobian(-d_r_d_pC, d_r_d_pC1 * Skew(p_C1), T_C_C1, mounting_jacobian);
    }
    return d_r_d_pC;
  }

  const PoseBlock& T_C_C1;
  Eigen::Vector3d p_C1;
};

// Projects a line of the first camera into the second one.
struct RightLineProjection {
  RightLineProjection(const PoseBlock& mounting, const PluckerLine& line_C)
      : T_C_C1(mounting), L_C(line_C), L_C1(ToChild(T_C_C1, L_C)) {}

  bool Evaluate(const LineSegmentView& view, const Eigen::Vector2d& weights, double* residuals) {
    Eigen::Vector2d distances;
    if (!EndPointDistances(view, L_C1.moment, &distances, &d_r_d_mC1)) return false;
    Vector2Map{residuals} = weights.cwiseProduct(distances);
    d_r_d_mC1 = weights.asDiagonal() * d_r_d_mC1;
    return true;
  }

  // Returns the derivative by the line in C; writes that by the mounting unless it is null.
  LineDerivative Differentiate(double* mounting_jacobian) const {
    if (mounting_jacobian) {
      const Matrix23d d_r_d_mC = d_r_d_mC1 * T_C_C1.R.transpose();
      SetMountingJacobian(d_r_d_mC * Skew(L_C.direction), d_r_d_mC1 * Skew(L_C1.moment), T_C_C1,
                          mounting_jacobian);
    }
    return ByParent(T_C_C1, {d_r_d_mC1, Matrix23d::Zero()});
  }

  const PoseBlock& T_C_C1;
  PluckerLine L_C, L_C1;
  Matrix23d d_r_d_mC1;
};

// The inverse depth that a stream measures for a point, with its derivatives.
struct ExpectedDepth {
  ExpectedDepth(const TimedDepth& depth, double inverse_depth, const double* stream)
      : value(depth.Expected(inverse_depth, stream)),
        by_inverse_depth(std::exp(-stream[0]) *
                         (1 - 2 * stream[1] * depth.approach * inverse_depth)),
        by_delay(-std::exp(-stream[0]) * depth.approach * inverse_depth * inverse_depth) {}

  void SetStreamJacobian(double weight, double* jacobian) const {
    if (jacobian) Eigen::Map<Eigen::RowVector2d>{jacobian} << -weight * value, weight * by_delay;
  }

  double value, by_inverse_depth, by_delay;
};

}  // namespace

bool RightPointFactor::Evaluate(double const* const* parameters, double* residuals,
                                double** jacobians) const {
  const PointChain chain(parameters, parameters[5]);
  const PoseBlock T_C_C1(parameters[3]);
  const RightProjection right(T_C_C1, chain.p_Ct);
  if (!right.IsInFront()) return false;
  Vector2Map{residuals} = weight_ * (right.p_C1.hnormalized() - target_.At(parameters[4][0]));
  if (jacobians == nullptr) return true;
  chain.SetJacobians<2>(right.Differentiate(weight_, jacobians[3]), jacobians, jacobians[5]);
  if (jacobians[4]) Vector2Map{jacobians[4]} = weight_ * target_.velocity;
  return true;
}

bool RightPointHostFactor::Evaluate(double const* const* parameters, double* residuals,
                                    double** jacobians) const {
  const PoseBlock T_C_C1(parameters[0]);
  const RightProjection right(T_C_C1, PointInHost(parameters[2]));
  if (!right.IsInFront()) return false;
  Vector2Map{residuals} = weight_ * (right.p_C1.hnormalized() - host_.At(parameters[1][0]));
  if (jacobians == nullptr) return true;
  const Matrix23d d_r_d_pC = right.Differentiate(weight_, jacobians[0]);
  if (jacobians[1]) Vector2Map{jacobians[1]} = weight_ * host_.velocity;
  if (jacobians[2]) {
    PointJacobian{jacobians[2]} = d_r_d_pC * PointInHostJacobian(parameters[2]);
  }
  return true;
}

bool RightLineFactor::EvaluateWithNormal(double const* const* parameters, double* residuals,
                                         double** jacobians, Eigen::Vector2d* normal) const {
  const LineChain chain(parameters, parameters[4]);
  const PoseBlock T_C_C1(parameters[3]);
  RightLineProjection right(T_C_C1, chain.L_Ct);
  if (!right.Evaluate(view_, weights_, residuals)) return false;
  if (normal != nullptr) *normal = right.L_C1.moment.head<2>().normalized();
  if (jacobians == nullptr) return true;
  chain.SetJacobians(right.Differentiate(jacobians[3]), jacobians, jacobians[4]);
  return true;
}

bool RightLineHostFactor::EvaluateWithNormal(double const* const* parameters, double* residuals,
                                             double** jacobians, Eigen::Vector2d* normal) const {
  const PoseBlock T_C_C1(parameters[0]);
  RightLineProjection right(T_C_C1, ToPlucker(parameters[1]));
  if (!right.Evaluate(view_, weights_, residuals)) return false;
  if (normal != nullptr) *normal = right.L_C1.moment.head<2>().normalized();
  if (jacobians == nullptr) return true;
  const LineDerivative derivative = right.Differentiate(jacobians[0]);
  if (jacobians[1]) SetLineJacobian(derivative, parameters[1], jacobians[1]);
  return true;
}

bool DepthFactor::Evaluate(double const* const* parameters, double* residuals,
                           double** jacobians) const {
  const PointChain chain(parameters, parameters[4]);
  const double z = chain.p_Ct.z();
  if (!(z > kMinProjectedDepth)) return false;
  const ExpectedDepth expected(depth_, 1 / z, parameters[3]);
  residuals[0] = weight_ * (expected.value - 1 / depth_.depth);
  if (jacobians == nullptr) return true;
  chain.SetJacobians<1>(Eigen::RowVector3d(0, 0, -weight_ * expected.by_inverse_depth / (z * z)),
                        jacobians, jacobians[4]);
  expected.SetStreamJacobian(weight_, jacobians[3]);
  return true;
}

bool DepthHostFactor::Evaluate(double const* const* parameters, double* residuals,
                               double** jacobians) const {
  const ExpectedDepth expected(depth_, parameters[1][2], parameters[0]);
  residuals[0] = weight_ * (expected.value - 1 / depth_.depth);
  if (jacobians == nullptr) return true;
  expected.SetStreamJacobian(weight_, jacobians[0]);
  if (jacobians[1]) {
    Eigen::Map<Eigen::RowVector3d>{jacobians[1]} << 0, 0, weight_ * expected.by_inverse_depth;
  }
  return true;
}

}  // namespace plm_vins
