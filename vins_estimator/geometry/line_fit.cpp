// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/geometry/line_fit.h"

#include <Eigen/Eigenvalues>
#include <cmath>

#include "common/geometry/so3.h"
#include "common/geometry/symmetric_system.h"

namespace plm_vins {
namespace {

constexpr int kMaxIterations = 20;
constexpr double kInitialDamping = 1e-4;
constexpr double kConverged = 1e-6;  // relative decrease of the cost

using LineJacobian = Eigen::Matrix<double, 2, kLineTangentSize>;

// Transforms the moment of a line from the first camera's frame into another camera's: R moment +
// [t]x R direction.
struct LineCamera {
  Eigen::Matrix3d R;
  Eigen::Matrix3d tR;  // [t]x R
  SegmentEndPoints segment;
};

std::vector<LineCamera> CamerasOf(const std::vector<PosedLineObservation>& observations) {
  std::vector<LineCamera> cameras;
  cameras.reserve(observations.size());
  const Rigid3d T_C0_W = observations.front().T_W_C.Inverse();
  for (const PosedLineObservation& observation : observations) {
    const Rigid3d T_C_C0 = (T_C0_W * observation.T_W_C).Inverse();
    const Eigen::Matrix3d R = T_C_C0.R();
    cameras.push_back({R, Skew(T_C_C0.translation) * R, observation.segment});
  }
  return cameras;
}

std::optional<LineFit> Evaluate(const std::vector<LineCamera>& cameras, double noise,
                                const OrthonormalLine& line) {
  LineFit fit;
  fit.line = line;
  const PluckerLine line_C0 = ToPlucker(line.data());
  const PluckerJacobian plucker = ToPluckerJacobian(line.data());
  for (const LineCamera& camera : cameras) {
    const Eigen::Vector3d moment = camera.R * line_C0.moment + camera.tR * line_C0.direction;
    Eigen::Vector2d distances;
    Eigen::Matrix<double, 2, 3> d_distances;
    if (!EndPointDistances(camera.segment, moment, &distances, &d_distances)) return std::nullopt;
    const LineJacobian J =
        d_distances * (camera.R * plucker.d_moment + camera.tR * plucker.d_direction) / noise;
    fit.information += J.transpose() * J;
    fit.gradient += J.transpose() * distances / noise;
    fit.cost += distances.squaredNorm() / (noise * noise);
  }
  return fit;
}

// A prior of one radian on each tangent coordinate keeps the covariance finite.
Eigen::Matrix4d Covariance(const LineFit& fit) {
  const Eigen::Matrix4d information = fit.information + Eigen::Matrix4d::Identity();
  return InverseOfSymmetric(information);
}

}  // namespace

std::optional<LineFit> EvaluateLine(const std::vector<PosedLineObservation>& observations,
                                    double noise, const OrthonormalLine& line) {
  return Evaluate(CamerasOf(observations), noise, line);
}

// Uses Levenberg-Marquardt, because full Gauss-Newton steps may diverge from a poor start.
std::optional<LineFit> FitLine(const std::vector<PosedLineObservation>& observations, double noise,
                               const OrthonormalLine& initial) {
  const std::vector<LineCamera> cameras = CamerasOf(observations);
  auto fit = Evaluate(cameras, noise, initial);
  double damping = kInitialDamping;
  for (int i = 0; fit && i < kMaxIterations; ++i) {
    Eigen::Matrix4d H = fit->information;
    H.diagonal() *= 1.0 + damping;
    const Eigen::Vector4d step = -SolveSymmetric(H, fit->gradient);
    if (!step.allFinite()) return std::nullopt;
    OrthonormalLine moved;
    LinePlus(fit->line.data(), step.data(), moved.data());
    const auto next = Evaluate(cameras, noise, moved);
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
  // The line is nearest to p where moment = p x direction; its perpendicular offset from p is
  // direction x (moment - p x direction) / |direction|^2.
  const Eigen::Matrix<double, 3, kLineTangentSize> d_place =
      Skew(line.direction) * (J.d_moment - Skew(p_C0) * J.d_direction) /
      line.direction.squaredNorm();
  const Eigen::Matrix3d covariance = d_place * Covariance(fit) * d_place.transpose();
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(covariance, Eigen::EigenvaluesOnly);
  return std::sqrt(solver.eigenvalues().maxCoeff());
}

}  // namespace plm_vins
