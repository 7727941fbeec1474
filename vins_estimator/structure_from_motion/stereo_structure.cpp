// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/structure_from_motion/stereo_structure.h"

#include <Eigen/Cholesky>
#include <algorithm>

#include "common/format.h"
#include "common/geometry/so3.h"
#include "common/geometry/symmetric_system.h"
#include "vins_estimator/geometry/depth_limits.h"
#include "vins_estimator/geometry/point_triangulation.h"

namespace plm_vins {
namespace {

constexpr int kMinPoints = 12;  // with depth, in the first view and common to others
constexpr int kResectionIterations = 10;
constexpr double kLossScale = 2.0;          // Cauchy loss, in standard deviations
constexpr double kMaxInlierResidual = 6.0;  // in standard deviations; depths are noisy as well

class Builder {
 public:
  Builder(const std::vector<Track>& tracks, const std::vector<Eigen::Quaterniond>& R_G_B,
          const StereoStructureOptions& options)
      : tracks_(tracks), R_G_B_(R_G_B), options_(options) {
    structure_.T_G_B.resize(R_G_B.size());
    structure_.rotation_information.assign(R_G_B.size(), Eigen::Matrix3d::Zero());
    structure_.p_G.resize(tracks.size());
  }

  std::optional<StereoStructure> Build(std::string* reason);

 private:
  using Matrix6d = Eigen::Matrix<double, 6, 6>;
  using Vector6d = Eigen::Matrix<double, 6, 1>;

  // Normal equations of a view's pose, [position, rotation on the right].
  struct Resection {
    Matrix6d H = Matrix6d::Zero();
    Vector6d g = Vector6d::Zero();
    int inliers = 0;
  };

  int ViewWithMostDepths() const;
  std::optional<Eigen::Vector3d> PointOf(const Track& track, int view) const;
  int TriangulateIn(int view);
  void AddPoint(const Eigen::Vector3d& p_G, const Track::Observation& seen,
                Resection* equations) const;
  Resection Linearize(int view) const;
  bool Resect(int view, int neighbor, std::string* reason);

  const std::vector<Track>& tracks_;
  const std::vector<Eigen::Quaterniond>& R_G_B_;
  const StereoStructureOptions options_;
  StereoStructure structure_;
};

// Counts what is observed beyond one image of each point.
int Builder::ViewWithMostDepths() const {
  std::vector<int> depths(R_G_B_.size(), 0);
  for (const Track& track : tracks_) {
    for (const Track::Observation& o : track.observations) {
      depths[o.view] += o.depth || &o != track.In(o.view);
    }
  }
  return static_cast<int>(std::max_element(depths.begin(), depths.end()) - depths.begin());
}

// Returns the position by the observations in one view: by the measured depth, or by two cameras.
// Returns nullopt without these, if their rays are nearly parallel, or if they do not belong to one
// point.
std::optional<Eigen::Vector3d> Builder::PointOf(const Track& track, int view) const {
  std::vector<PosedPointObservation> observations;
  for (const Track::Observation& o : track.observations) {
    if (o.view != view) continue;
    const Rigid3d T_G_C = structure_.T_G_B[view] * options_.T_B_C[o.camera];
    if (o.depth) return T_G_C * (*o.depth * o.xy.homogeneous());
    observations.push_back({T_G_C, o.xy});
  }
  if (observations.size() < 2) return std::nullopt;
  const auto p_G = TriangulatePoint(observations, options_.min_angle);
  if (!p_G) return std::nullopt;
  const auto& [T_G_C, xy] = observations.front();
  const Eigen::Vector2d error = (T_G_C.Inverse() * *p_G).hnormalized() - xy;
  if (error.norm() > kMaxInlierResidual * options_.noise) return std::nullopt;
  return p_G;
}

// Adds the points that have a depth in the view; returns their number.
int Builder::TriangulateIn(int view) {
  int added = 0;
  for (size_t i = 0; i < tracks_.size(); ++i) {
    if (structure_.p_G[i]) continue;
    structure_.p_G[i] = PointOf(tracks_[i], view);
    added += structure_.p_G[i].has_value();
  }
  return added;
}

void Builder::AddPoint(const Eigen::Vector3d& p_G, const Track::Observation& seen,
                       Resection* equations) const {
  const Rigid3d &T_G_B = structure_.T_G_B[seen.view], &T_B_C = options_.T_B_C[seen.camera];
  const Eigen::Matrix3d R_B_G = T_G_B.R().transpose(), R_C_B = T_B_C.R().transpose();
  const Eigen::Vector3d p_B = R_B_G * (p_G - T_G_B.translation);
  const Eigen::Vector3d p_C = R_C_B * (p_B - T_B_C.translation);
  if (p_C.z() < kMinTriangulatedDepth) return;
  const Eigen::Vector2d residual = (p_C.hnormalized() - seen.xy) / options_.noise;
  Eigen::Matrix<double, 2, 3> projection;
  projection << 1, 0, -p_C.x() / p_C.z(), 0, 1, -p_C.y() / p_C.z();
  projection /= p_C.z() * options_.noise;
  Eigen::Matrix<double, 2, 6> J;
  J << -projection * R_C_B * R_B_G, projection * R_C_B * Skew(p_B);
  const double weight = 1 / (1 + residual.squaredNorm() / (kLossScale * kLossScale));
  equations->H += weight * J.transpose() * J;
  equations->g += weight * J.transpose() * residual;
  equations->inliers += residual.norm() < kMaxInlierResidual;
}

Builder::Resection Builder::Linearize(int view) const {
  Resection equations;
  for (size_t i = 0; i < tracks_.size(); ++i) {
    if (!structure_.p_G[i]) continue;
    for (const Track::Observation& o : tracks_[i].observations) {
      if (o.view == view) AddPoint(*structure_.p_G[i], o, &equations);
    }
  }
  return equations;
}

bool Builder::Resect(int view, int neighbor, std::string* reason) {
  Rigid3d& T_G_B = structure_.T_G_B[view];
  const Rigid3d& T_G_neighbor = structure_.T_G_B[neighbor];
  T_G_B = {T_G_neighbor.rotation * R_G_B_[neighbor].conjugate() * R_G_B_[view],
           T_G_neighbor.translation};
  Resection equations;
  for (int i = 0; i < kResectionIterations; ++i) {
    equations = Linearize(view);
    const Vector6d step = -SolveSymmetric(equations.H, equations.g);
    if (!step.allFinite()) break;
    T_G_B.translation += step.head<3>();
    T_G_B.rotation = (T_G_B.rotation * SO3Exp(step.tail<3>())).normalized();
  }
  if (equations.inliers < kMinPoints) {
    *reason =
        Format("too few points with a depth fit a motion: %d of %d", equations.inliers, kMinPoints);
    return false;
  }
  const Eigen::Matrix3d H_tr = equations.H.topRightCorner<3, 3>();
  structure_.rotation_information[view] =
      equations.H.bottomRightCorner<3, 3>() -
      H_tr.transpose() * equations.H.topLeftCorner<3, 3>().ldlt().solve(H_tr);
  return true;
}

std::optional<StereoStructure> Builder::Build(std::string* reason) {
  const int first = ViewWithMostDepths(), count = static_cast<int>(R_G_B_.size());
  const int points = TriangulateIn(first);
  if (points < kMinPoints) {
    *reason = Format("too few points with a depth by two cameras or the sensor: %d of %d", points,
                     kMinPoints);
    return std::nullopt;
  }
  for (int view = first + 1; view < count; ++view) {
    if (!Resect(view, view - 1, reason)) return std::nullopt;
    TriangulateIn(view);
  }
  for (int view = first - 1; view >= 0; --view) {
    if (!Resect(view, view + 1, reason)) return std::nullopt;
    TriangulateIn(view);
  }
  return structure_;
}

}  // namespace

std::optional<StereoStructure> ReconstructFromStereo(const std::vector<Track>& tracks,
                                                     const std::vector<Eigen::Quaterniond>& R_G_B,
                                                     const StereoStructureOptions& options,
                                                     std::string* reason) {
  return Builder(tracks, R_G_B, options).Build(reason);
}

}  // namespace plm_vins
