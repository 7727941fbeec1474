// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/geometry/line_fit.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <cmath>

#include "common/so3.h"

namespace plm_vins {
namespace {

constexpr int kMaxIterations = 20;
constexpr double kInitialDamping = 1e-4;
constexpr double kConverged = 1e-6;  // relative decrease of the cost

using LineJacobian = Eigen::Matrix<double, 2, kLineTangentSize>;

// Derivative of the distances in one camera by the line's tangent.
LineJacobian ByTangent(const Rigid3d& T_C_C0, const PluckerJacobian& plucker,
                       const Eigen::Matrix<double, 2, 3>& d_distances_d_moment) {
  const Eigen::Matrix3d R = T_C_C0.R();
  const Eigen::Matrix<double, 2, 3> by_moment = d_distances_d_moment * R;
  const Eigen::Matrix<double, 2, 3> by_direction =
      d_distances_d_moment * Skew(T_C_C0.translation) * R;
  return by_moment * plucker.d_moment + by_direction * plucker.d_direction;
}

// A prior of one radian on each coordinate of the tangent keeps the inverse finite.
Eigen::Matrix4d Covariance(const LineFit& fit) {
  const Eigen::Matrix4d information = fit.information + Eigen::Matrix4d::Identity();
  return information.ldlt().solve(Eigen::Matrix4d::Identity());
}

}  // namespace

std::optional<LineFit> EvaluateLine(const std::vector<LineSighting>& sightings, double noise,
                                    const OrthonormalLine& line) {
  LineFit fit;
  fit.line = line;
  const Rigid3d T_C0_W = sightings.front().T_W_C.Inverse();
  const PluckerLine line_C0 = ToPlucker(line.data());
  const PluckerJacobian plucker = ToPluckerJacobian(line.data());
  for (const LineSighting& sighting : sightings) {
    const Rigid3d T_C_C0 = (T_C0_W * sighting.T_W_C).Inverse();
    Eigen::Vector2d distances;
    Eigen::Matrix<double, 2, 3> d_distances;
    const Eigen::Vector3d moment = (T_C_C0 * line_C0).moment;
    if (!EndPointDistances(sighting.segment, moment, &distances, &d_distances)) return std::nullopt;
    const LineJacobian J = ByTangent(T_C_C0, plucker, d_distances) / noise;
    fit.information += J.transpose() * J;
    fit.gradient += J.transpose() * distances / noise;
    fit.cost += distances.squaredNorm() / (noise * noise);
  }
  return fit;
}

// Levenberg-Marquardt: from a poor start, a full step may lead astray.
std::optional<LineFit> FitLine(const std::vector<LineSighting>& sightings, double noise,
                               const OrthonormalLine& initial) {
  auto fit = EvaluateLine(sightings, noise, initial);
  double damping = kInitialDamping;
  for (int i = 0; fit && i < kMaxIterations; ++i) {
    Eigen::Matrix4d H = fit->information;
    H.diagonal() *= 1.0 + damping;
    const Eigen::Vector4d step = -H.ldlt().solve(fit->gradient);
    if (!step.allFinite()) return std::nullopt;
    OrthonormalLine moved;
    LinePlus(fit->line.data(), step.data(), moved.data());
    const auto next = EvaluateLine(sightings, noise, moved);
    if (!next || next->cost > fit->cost) {
      damping *= 10;
      continue;
    }
    const bool converged = fit->cost - next->cost <= kConverged * fit->cost;
    damping *= 0.1;
    fit = next;
    if (converged) break;
  }
  return fit;
}

double DirectionDeviation(const LineFit& fit) {
  const Eigen::Matrix4d covariance = Covariance(fit);
  // The direction U e2 moves by dtheta_x U e3 - dtheta_z U e1.
  const double a = covariance(0, 0), b = covariance(0, 2), c = covariance(2, 2);
  return std::sqrt(0.5 * (a + c) + std::hypot(0.5 * (a - c), b));
}

double PlaceDeviation(const LineFit& fit, const Eigen::Vector3d& p_C0) {
  const PluckerLine line = ToPlucker(fit.line.data());
  const PluckerJacobian J = ToPluckerJacobian(fit.line.data());
  // The line nears p where moment = p x direction; across it, it is off by
  // direction x (moment - p x direction) / |direction|^2.
  const Eigen::Matrix<double, 3, kLineTangentSize> d_place =
      Skew(line.direction) * (J.d_moment - Skew(p_C0) * J.d_direction) /
      line.direction.squaredNorm();
  const Eigen::Matrix3d covariance = d_place * Covariance(fit) * d_place.transpose();
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(covariance, Eigen::EigenvaluesOnly);
  return std::sqrt(solver.eigenvalues().maxCoeff());
}

}  // namespace plm_vins
