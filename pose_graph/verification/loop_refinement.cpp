// SPDX-License-Identifier: BSD-3-Clause
#include "pose_graph/verification/loop_refinement.h"

#include <ceres/ceres.h>

#include <Eigen/Cholesky>
#include <memory>

namespace plm_vins {
namespace {

constexpr double kRobustWidth = 2.0;  // [standard deviations]
constexpr double kMinDepth = 1e-3;    // [m]

template <typename T>
using Vector3 = Eigen::Matrix<T, 3, 1>;

// The variable `place` is where the later camera is in A, and the yaw of T_A_B: the two hardly
// correlate, other than yaw and the translation of T_A_B, which is that of a far origin.
template <typename T>
Vector3<T> RotateAboutZ(const T& yaw, const Vector3<T>& v) {
  using std::cos;
  using std::sin;
  const T c = cos(yaw);
  const T s = sin(yaw);
  return {c * v.x() - s * v.y(), s * v.x() + c * v.y(), v.z()};
}

// A point of A in the later camera.
template <typename T>
Vector3<T> ToLaterCamera(const T* place, const Eigen::Vector3d& p_A, const Rigid3d& T_B_C) {
  const Vector3<T> offset = p_A.cast<T>() - Eigen::Map<const Vector3<T>>(place);
  return T_B_C.R().transpose().cast<T>() * RotateAboutZ<T>(-place[3], offset);
}

// A point of B in the earlier camera.
template <typename T>
Vector3<T> ToEarlierCamera(const T* place, const Eigen::Vector3d& p_B, const Rigid3d& T_B_C,
                           const Rigid3d& T_A_C) {
  const Vector3<T> offset = (p_B - T_B_C.translation).cast<T>();
  const Vector3<T> p_A = Eigen::Map<const Vector3<T>>(place) + RotateAboutZ<T>(place[3], offset);
  return T_A_C.R().transpose().cast<T>() * (p_A - T_A_C.translation.cast<T>());
}

template <typename T>
bool Reproject(const Vector3<T>& p_C, const Eigen::Vector2d& xy, double weight, T* residual) {
  if (p_C.z() <= T(kMinDepth)) return false;
  residual[0] = (p_C.x() / p_C.z() - xy.x()) * weight;
  residual[1] = (p_C.y() / p_C.z() - xy.y()) * weight;
  return true;
}

struct EarlierLandmarkCost {
  template <typename T>
  bool operator()(const T* place, T* residual) const {
    return Reproject<T>(ToLaterCamera(place, sighting.p_A, T_B_C), sighting.xy, weight, residual);
  }
  SeenPoint sighting;
  Rigid3d T_B_C;
  double weight;
};

struct LaterLandmarkCost {
  template <typename T>
  bool operator()(const T* place, T* residual) const {
    return Reproject<T>(ToEarlierCamera(place, sighting.p_A, T_B_C, T_A_C), sighting.xy, weight,
                        residual);
  }
  SeenPoint sighting;  // its point is one of B
  Rigid3d T_A_C;
  Rigid3d T_B_C;
  double weight;
};

// Both ends of the segment on the image of the line.
struct LineCost {
  template <typename T>
  bool operator()(const T* place, T* residual) const {
    using std::sqrt;
    const Eigen::Matrix<T, 3, 1> start = ToLaterCamera(place, sighting.line_A.start_O, T_B_C);
    const Eigen::Matrix<T, 3, 1> end = ToLaterCamera(place, sighting.line_A.end_O, T_B_C);
    const Eigen::Matrix<T, 3, 1> line = start.cross(end);
    const T norm = sqrt(line.x() * line.x() + line.y() * line.y());
    if (norm < T(1e-12)) return false;
    const Eigen::Vector3d a = sighting.segment.start.homogeneous();
    const Eigen::Vector3d b = sighting.segment.end.homogeneous();
    residual[0] = line.dot(a.cast<T>()) / norm * weight;
    residual[1] = line.dot(b.cast<T>()) / norm * weight;
    return true;
  }
  SeenSegment sighting;
  Rigid3d T_B_C;
  double weight;
};

void AddCosts(const LoopRefinementOptions& options, const LoopSightings& sightings, double* place,
              ceres::Problem* problem) {
  const auto add = [&](auto cost) {
    using Cost = decltype(cost);
    problem->AddResidualBlock(new ceres::AutoDiffCostFunction<Cost, 2, 4>(new Cost(cost)),
                              new ceres::HuberLoss(kRobustWidth), place);
  };
  const double point_weight = 1 / options.point_noise;
  for (const SeenPoint& sighting : sightings.of_earlier) {
    add(EarlierLandmarkCost{sighting, sightings.T_B_C, point_weight});
  }
  for (const SeenPoint& sighting : sightings.of_later) {
    add(LaterLandmarkCost{sighting, sightings.T_A_C, sightings.T_B_C, point_weight});
  }
  for (const SeenSegment& sighting : sightings.lines) {
    add(LineCost{sighting, sightings.T_B_C, 1 / options.line_noise});
  }
}

// The inverse of J^T J at the solution; nothing where it has none.
std::optional<Matrix4d> CovarianceAt(ceres::Problem* problem) {
  ceres::CRSMatrix sparse;
  problem->Evaluate(ceres::Problem::EvaluateOptions(), nullptr, nullptr, nullptr, &sparse);
  // One block of four variables: every row is full.
  using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, 4, Eigen::RowMajor>;
  const Eigen::Map<const RowMajor> J(sparse.values.data(), sparse.num_rows, 4);
  const Matrix4d H = J.transpose() * J;
  const Eigen::LLT<Matrix4d> factor(H);
  if (factor.info() != Eigen::Success) return std::nullopt;
  return Matrix4d(factor.solve(Matrix4d::Identity()));
}

}  // namespace

std::optional<RefinedLoop> RefineLoop(const LoopRefinementOptions& options,
                                      const LoopSightings& sightings, const LevelTransform& start) {
  Vector4d place;
  place << start * sightings.T_B_C.translation, start.yaw;
  ceres::Problem problem;
  AddCosts(options, sightings, place.data(), &problem);
  ceres::Solver::Options solver;
  solver.linear_solver_type = ceres::DENSE_QR;
  solver.max_num_iterations = 20;
  solver.logging_type = ceres::SILENT;
  ceres::Solver::Summary summary;
  ceres::Solve(solver, &problem, &summary);
  const auto covariance = summary.IsSolutionUsable() ? CovarianceAt(&problem) : std::nullopt;
  if (!covariance) return std::nullopt;

  RefinedLoop loop;
  loop.T_A_B.yaw = WrapAngle(place(3));
  loop.T_A_B.translation = place.head<3>() - loop.T_A_B.rotation() * sightings.T_B_C.translation;
  Vector4d floor;
  floor << Eigen::Vector3d::Constant(options.floor_position), options.floor_yaw;
  loop.covariance = *covariance;
  loop.covariance.diagonal() += floor.cwiseAbs2();
  return loop;
}

}  // namespace plm_vins
