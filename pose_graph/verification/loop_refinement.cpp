// SPDX-License-Identifier: BSD-3-Clause
#include "pose_graph/verification/loop_refinement.h"

#include <ceres/ceres.h>
#include <ceres/rotation.h>

#include <Eigen/Cholesky>

namespace plm_vins {
namespace {

constexpr double kRobustWidth = 2.0;  // [standard deviations]
constexpr double kMinDepth = 1e-3;    // [m]

// Parameters: position of the later camera in O1, yaw of T_O1_O2, and a tilt of O2 about its level
// axes, since the roll and pitch errors of odometry differ between the visits. (The camera's
// position hardly correlates with the yaw, unlike the translation of T_O1_O2, whose origin is far.)
constexpr int kPlaceSize = 6;

using PlaceVector = Eigen::Matrix<double, kPlaceSize, 1>;
using PlaceMatrix = Eigen::Matrix<double, kPlaceSize, kPlaceSize>;

// The costs below are whitened residuals; O1 and O2 are those of LoopObservations.

template <typename T>
Eigen::Matrix<T, 3, 3> RotationFromO2(const T* place) {
  const T yaw[3] = {T(0), T(0), place[3]};
  const T tilt[3] = {place[4], place[5], T(0)};
  Eigen::Matrix<T, 3, 3> about_z, about_level;
  ceres::AngleAxisToRotationMatrix(yaw, about_z.data());
  ceres::AngleAxisToRotationMatrix(tilt, about_level.data());
  return about_z * about_level;
}

// Transforms a point from O1 to the later camera.
template <typename T>
Eigen::Matrix<T, 3, 1> ToLaterCamera(const T* place, const Eigen::Vector3d& p_O1,
                                     const Rigid3d& T_O2_C) {
  const Eigen::Matrix<T, 3, 1> offset =
      p_O1.cast<T>() - Eigen::Map<const Eigen::Matrix<T, 3, 1>>(place);
  return T_O2_C.R().transpose().cast<T>() * (RotationFromO2(place).transpose() * offset);
}

// Transforms a point from O2 to the earlier camera.
template <typename T>
Eigen::Matrix<T, 3, 1> ToEarlierCamera(const T* place, const Eigen::Vector3d& p_O2,
                                       const Rigid3d& T_O2_C, const Rigid3d& T_O1_C) {
  const Eigen::Matrix<T, 3, 1> offset = (p_O2 - T_O2_C.translation).cast<T>();
  const Eigen::Matrix<T, 3, 1> p_O1 =
      Eigen::Map<const Eigen::Matrix<T, 3, 1>>(place) + RotationFromO2(place) * offset;
  return T_O1_C.R().transpose().cast<T>() * (p_O1 - T_O1_C.translation.cast<T>());
}

template <typename T>
bool ReprojectionError(const Eigen::Matrix<T, 3, 1>& p_C, const Eigen::Vector2d& xy,
                       const Eigen::Matrix2d& whitening, T* residual) {
  if (p_C.z() <= T(kMinDepth)) return false;
  const Eigen::Matrix<T, 2, 1> error = p_C.hnormalized() - xy.cast<T>();
  Eigen::Map<Eigen::Matrix<T, 2, 1>>{residual} = whitening.cast<T>() * error;
  return true;
}

// Reprojection error of an earlier visit's landmark in the later image.
struct EarlierLandmarkCost {
  template <typename T>
  bool operator()(const T* place, T* residual) const {
    return ReprojectionError<T>(ToLaterCamera(place, observation.p_O, T_O2_C), observation.xy,
                                whitening, residual);
  }
  SeenPoint observation;
  Rigid3d T_O2_C;
  Eigen::Matrix2d whitening;
};

// Reprojection error of a later visit's landmark in the earlier image.
struct LaterLandmarkCost {
  template <typename T>
  bool operator()(const T* place, T* residual) const {
    return ReprojectionError<T>(ToEarlierCamera(place, observation.p_O, T_O2_C, T_O1_C),
                                observation.xy, whitening, residual);
  }
  SeenPoint observation;  // with its point in O2
  Rigid3d T_O1_C;
  Rigid3d T_O2_C;
  Eigen::Matrix2d whitening;
};

// Distances of the segment's endpoints from the projected line.
struct LineCost {
  template <typename T>
  bool operator()(const T* place, T* residual) const {
    using std::sqrt;
    const Eigen::Matrix<T, 3, 1> start = ToLaterCamera(place, observation.line.start_O, T_O2_C);
    const Eigen::Matrix<T, 3, 1> end = ToLaterCamera(place, observation.line.end_O, T_O2_C);
    const Eigen::Matrix<T, 3, 1> line = start.cross(end);
    const T norm = sqrt(line.x() * line.x() + line.y() * line.y());
    if (norm < T(1e-12)) return false;
    const Eigen::Vector3d a = observation.segment.start.homogeneous();
    const Eigen::Vector3d b = observation.segment.end.homogeneous();
    residual[0] = line.dot(a.cast<T>()) / norm * weight;
    residual[1] = line.dot(b.cast<T>()) / norm * weight;
    return true;
  }
  SeenSegment observation;
  Rigid3d T_O2_C;
  double weight;
};

// Prior of the tilt about the level axes.
struct TiltCost {
  template <typename T>
  bool operator()(const T* place, T* residual) const {
    residual[0] = place[4] * weight;
    residual[1] = place[5] * weight;
    return true;
  }
  double weight;
};

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
