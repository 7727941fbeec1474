// SPDX-License-Identifier: BSD-3-Clause
#include "pose_graph/verification/loop_refinement.h"

#include <ceres/ceres.h>

#include <Eigen/Cholesky>

#include "pose_graph/verification/loop_costs.h"

namespace plm_vins {
namespace {

constexpr double kRobustWidth = 2.0;  // [standard deviations]

using PlaceVector = Eigen::Matrix<double, kPlaceSize, 1>;
using PlaceMatrix = Eigen::Matrix<double, kPlaceSize, kPlaceSize>;

// Whitening of a landmark's reprojection error. `ray_C` is its ray from the host camera: the depth
// error shifts the projection along the image of this ray, in proportion to the baseline.
Eigen::Matrix2d WhiteningOf(const LoopRefinementOptions& options, const Eigen::Vector3d& p_C,
                            const Eigen::Vector3d& ray_C) {
  Eigen::Matrix2d covariance =
      Eigen::Matrix2d::Identity() * options.point_noise * options.point_noise;
  if (p_C.z() > kMinDepth) {
    const Eigen::Vector2d shift = (ray_C.head<2>() - p_C.hnormalized() * ray_C.z()) / p_C.z();
    covariance += options.depth_noise * options.depth_noise * shift * shift.transpose();
  }
  return covariance.llt().matrixL().solve(Eigen::Matrix2d::Identity());
}

// Adds the observations of both visits, with covariances linearized at `place`.
void AddCosts(const LoopRefinementOptions& options, const LoopObservations& observations,
              double* place, ceres::Problem* problem) {
  const Rigid3d& T_O1_C = observations.T_O1_C;
  const Rigid3d& T_O2_C = observations.T_O2_C;
  const auto add = [&](auto cost) {
    using Cost = decltype(cost);
    problem->AddResidualBlock(new ceres::AutoDiffCostFunction<Cost, 2, kPlaceSize>(new Cost(cost)),
                              new ceres::HuberLoss(kRobustWidth), place);
  };
  const Eigen::Vector3d earlier_in_later = ToLaterCamera(place, T_O1_C.translation, T_O2_C);
  for (const SeenPoint& observation : observations.of_earlier) {
    const Eigen::Vector3d p_C = ToLaterCamera(place, observation.p_O, T_O2_C);
    add(EarlierLandmarkCost{observation, T_O2_C,
                            WhiteningOf(options, p_C, p_C - earlier_in_later)});
  }
  const Eigen::Vector3d later_in_earlier =
      ToEarlierCamera(place, T_O2_C.translation, T_O2_C, T_O1_C);
  for (const SeenPoint& observation : observations.of_later) {
    const Eigen::Vector3d p_C = ToEarlierCamera(place, observation.p_O, T_O2_C, T_O1_C);
    add(LaterLandmarkCost{observation, T_O1_C, T_O2_C,
                          WhiteningOf(options, p_C, p_C - later_in_earlier)});
  }
  for (const SeenSegment& observation : observations.lines) {
    add(LineCost{observation, T_O2_C, 1 / options.line_noise});
  }
  add(TiltCost{1 / options.tilt});
}

// Covariance of position and yaw at the solution, (J^T J)^-1; nullopt if it is rank deficient.
std::optional<Matrix4d> CovarianceAt(ceres::Problem* problem) {
  ceres::CRSMatrix sparse;
  problem->Evaluate(ceres::Problem::EvaluateOptions(), nullptr, nullptr, nullptr, &sparse);
  // There is a single parameter block, so every row is dense.
  using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, kPlaceSize, Eigen::RowMajor>;
  const Eigen::Map<const RowMajor> J(sparse.values.data(), sparse.num_rows, kPlaceSize);
  const PlaceMatrix H = J.transpose() * J;
  const Eigen::LLT<PlaceMatrix> factor(H);
  if (factor.info() != Eigen::Success) return std::nullopt;
  return Matrix4d(factor.solve(PlaceMatrix::Identity()).topLeftCorner<4, 4>());
}

}  // namespace

std::optional<RefinedLoop> RefineLoop(const LoopRefinementOptions& options,
                                      const LoopObservations& observations,
                                      const LevelTransform& start) {
  PlaceVector place;
  place << start * observations.T_O2_C.translation, start.yaw, 0, 0;
  ceres::Problem problem;
  AddCosts(options, observations, place.data(), &problem);
  ceres::Solver::Options solver;
  solver.linear_solver_type = ceres::DENSE_QR;
  solver.max_num_iterations = 20;
  solver.logging_type = ceres::SILENT;
  ceres::Solver::Summary summary;
  ceres::Solve(solver, &problem, &summary);
  const auto covariance = summary.IsSolutionUsable() ? CovarianceAt(&problem) : std::nullopt;
  if (!covariance) return std::nullopt;

  RefinedLoop loop;
  loop.T_O1_O2.yaw = WrapAngle(place(3));
  loop.T_O1_O2.translation =
      place.head<3>() - loop.T_O1_O2.rotation() * observations.T_O2_C.translation;
  Vector4d floor;
  floor << Eigen::Vector3d::Constant(options.floor_position), options.floor_yaw;
  loop.covariance = *covariance;
  loop.covariance.diagonal() += floor.cwiseAbs2();
  return loop;
}

}  // namespace plm_vins
