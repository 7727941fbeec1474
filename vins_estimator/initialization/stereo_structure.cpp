// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/initialization/stereo_structure.h"

#include <Eigen/Cholesky>
#include <algorithm>

#include "common/format.h"
#include "common/geometry/so3.h"
#include "vins_estimator/geometry/depth_limits.h"
#include "vins_estimator/geometry/point_triangulation.h"

namespace plm_vins {
namespace {

constexpr int kMinPoints = 12;  // with depth, in the first view and common to others
constexpr int kResectionIterations = 10;
constexpr double kLossScale = 2.0;          // Cauchy loss, in standard deviations
constexpr double kMaxInlierResidual = 6.0;  // in standard deviations; depths are noisy as well

bool HasDepth(const ViewObservation& observation) { return observation.right || observation.depth; }

class Builder {
 public:
  Builder(const std::vector<Track>& tracks, const std::vector<Eigen::Quaterniond>& R_G_C,
          const StereoStructureOptions& options)
      : tracks_(tracks), R_G_C_(R_G_C), options_(options) {
    structure_.T_G_C.resize(R_G_C.size());
    structure_.rotation_information.assign(R_G_C.size(), Eigen::Matrix3d::Zero());
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

  int ViewWithMostPairs() const;
  std::optional<Eigen::Vector3d> PointOf(const ViewObservation& seen, const Rigid3d& T_G_C) const;
  int TriangulateIn(int view);
  void AddPoint(const Eigen::Vector3d& p_G, const Eigen::Vector2d& xy, const Rigid3d& T_G_C,
                Resection* equations) const;
  Resection Linearize(int view) const;
  bool Resect(int view, int neighbor, std::string* reason);

  const std::vector<Track>& tracks_;
  const std::vector<Eigen::Quaterniond>& R_G_C_;
  const StereoStructureOptions options_;
  StereoStructure structure_;
};

int Builder::ViewWithMostPairs() const {
  std::vector<int> pairs(R_G_C_.size(), 0);
  for (const Track& track : tracks_) {
    for (const ViewObservation& o : track.observations) pairs[o.view] += HasDepth(o);
  }
  return static_cast<int>(std::max_element(pairs.begin(), pairs.end()) - pairs.begin());
}

// Returns nullopt if both observations are nearly parallel or do not belong to one point.
std::optional<Eigen::Vector3d> Builder::PointOf(const ViewObservation& seen,
                                                const Rigid3d& T_G_C) const {
  if (seen.depth) return T_G_C * (*seen.depth * seen.xy.homogeneous());
  auto p_G = TriangulatePoint({{T_G_C, seen.xy}, {T_G_C * options_.T_C_C1, *seen.right}},
                              options_.min_angle);
  if (!p_G) return std::nullopt;
  const Eigen::Vector2d error = (T_G_C.Inverse() * *p_G).hnormalized() - seen.xy;
  if (error.norm() > kMaxInlierResidual * options_.noise) return std::nullopt;
  return p_G;
}

// Adds the points that have a depth in the view; returns their number.
int Builder::TriangulateIn(int view) {
  const Rigid3d& T_G_C = structure_.T_G_C[view];
  int added = 0;
  for (size_t i = 0; i < tracks_.size(); ++i) {
    const ViewObservation* seen = tracks_[i].In(view);
    if (structure_.p_G[i] || seen == nullptr || !HasDepth(*seen)) continue;
    structure_.p_G[i] = PointOf(*seen, T_G_C);
    added += structure_.p_G[i].has_value();
  }
  return added;
}

void Builder::AddPoint(const Eigen::Vector3d& p_G, const Eigen::Vector2d& xy, const Rigid3d& T_G_C,
                       Resection* equations) const {
  const Eigen::Matrix3d R_C_G = T_G_C.R().transpose();
  const Eigen::Vector3d p_C = R_C_G * (p_G - T_G_C.translation);
  if (p_C.z() < kMinTriangulatedDepth) return;
  const Eigen::Vector2d residual = (p_C.hnormalized() - xy) / options_.noise;
  Eigen::Matrix<double, 2, 3> projection;
  projection << 1, 0, -p_C.x() / p_C.z(), 0, 1, -p_C.y() / p_C.z();
  projection /= p_C.z() * options_.noise;
  Eigen::Matrix<double, 2, 6> J;
  J << -projection * R_C_G, projection * Skew(p_C);
  const double weight = 1 / (1 + residual.squaredNorm() / (kLossScale * kLossScale));
  equations->H += weight * J.transpose() * J;
  equations->g += weight * J.transpose() * residual;
  equations->inliers += residual.norm() < kMaxInlierResidual;
}

Builder::Resection Builder::Linearize(int view) const {
  Resection equations;
  for (size_t i = 0; i < tracks_.size(); ++i) {
    const ViewObservation* seen = tracks_[i].In(view);
    if (!structure_.p_G[i] || seen == nullptr) continue;
    AddPoint(*structure_.p_G[i], seen->xy, structure_.T_G_C[view], &equations);
  }
  return equations;
}

bool Builder::Resect(int view, int neighbor, std::string* reason) {
  Rigid3d& T_G_C = structure_.T_G_C[view];
  const Rigid3d& T_G_neighbor = structure_.T_G_C[neighbor];
  T_G_C = {T_G_neighbor.rotation * R_G_C_[neighbor].conjugate() * R_G_C_[view],
           T_G_neighbor.translation};
  Resection equations;
  for (int i = 0; i < kResectionIterations; ++i) {
    equations = Linearize(view);
    const Vector6d step = -equations.H.ldlt().solve(equations.g);
    if (!step.allFinite()) break;
    T_G_C.translation += step.head<3>();
    T_G_C.rotation = (T_G_C.rotation * SO3Exp(step.tail<3>())).normalized();
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
  const int first = ViewWithMostPairs(), count = static_cast<int>(R_G_C_.size());
  const int points = TriangulateIn(first);
  if (points < kMinPoints) {
    *reason = Format("too few points with a depth by the second camera or the sensor: %d of %d",
                     points, kMinPoints);
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
                                                     const std::vector<Eigen::Quaterniond>& R_G_C,
                                                     const StereoStructureOptions& options,
                                                     std::string* reason) {
  return Builder(tracks, R_G_C, options).Build(reason);
}

}  // namespace plm_vins
