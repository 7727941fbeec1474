// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/structure_from_motion/stereo_structure.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <utility>

#include "common/format.h"
#include "common/geometry/so3.h"
#include "common/geometry/symmetric_system.h"
#include "vins_estimator/geometry/depth_limits.h"
#include "vins_estimator/geometry/point_triangulation.h"

namespace plm_vins {
namespace {

constexpr int kMinPoints = 12;  // with depth, in the first view and common to others
constexpr int kResectionIterations = 10, kRefiningIterations = 2;
constexpr double kRatioLosses[] = {16, 8, 4, 2, 2, 2, 2, 2};  // in standard deviations
constexpr double kLeastRatio = 0.1;       // of measured depths, against those that started
constexpr double kDepthDeviation = 0.02;  // of a measured depth, relative
constexpr double kPairRotation = 0.2 * M_PI / 180;  // deviation of the pair's rotation [rad]
constexpr double kLossScale = 2.0;                  // Cauchy loss, in standard deviations
constexpr double kMaxInlierResidual = 6.0;  // in standard deviations; depths are noisy as well

// Inverse depth of a point as one view measures it, and by the structure.
struct DepthPair {
  double measured, expected;
  double deviation;   // of the measured one
  double per_radian;  // change of the measured one if the second camera is turned
  double expected_deviation = 0;
  double share = 1;  // of its point's information, whose views have similar errors
};

// Returns the inverse depth along the ray `xy` at which it comes closest to the ray `xy_S` of a
// second camera; negative beyond infinity.
DepthPair DepthByTwoRays(const Eigen::Vector2d& xy, const Eigen::Vector2d& xy_S,
                         const Rigid3d& T_S_C, double noise) {
  const Eigen::Vector3d b = xy_S.homogeneous();
  const Eigen::Vector3d far = b.cross(T_S_C.rotation * xy.homogeneous());
  const Eigen::Vector3d per_inverse_depth = b.cross(T_S_C.translation);
  const double norm = per_inverse_depth.norm();
  const double per_radian = b.squaredNorm() / norm;
  return {-far.dot(per_inverse_depth) / (norm * norm), 0, M_SQRT2 * noise * per_radian, per_radian};
}

// Fits measured = ratio * expected + offset, robustly; returns the ratio and its deviation. Both
// have errors: in a least-squares fit, those of the expected ones would lessen the ratio. So the
// equations are projected on what is expected after the fit [York2004].
std::pair<double, double> FitRatio(const std::vector<DepthPair>& depths) {
  Eigen::Vector2d fit(1, 0);
  Eigen::Matrix2d H = Eigen::Matrix2d::Identity();
  for (const double loss : kRatioLosses) {
    H = Eigen::Vector2d(1e-6, 1 / (kPairRotation * kPairRotation)).asDiagonal();
    Eigen::Vector2d g = Eigen::Vector2d::Zero();
    for (const DepthPair& depth : depths) {
      const Eigen::Vector2d J(depth.expected, depth.per_radian);
      const double error = depth.measured - J.dot(fit);
      const double of_expected = depth.expected_deviation * depth.expected_deviation;
      const double variance = depth.deviation * depth.deviation + fit[0] * fit[0] * of_expected;
      const double weight = depth.share / (variance + error * error / (loss * loss));
      const Eigen::Vector2d adjusted(depth.expected + fit[0] * of_expected / variance * error,
                                     depth.per_radian);
      H += weight * adjusted * J.transpose();
      g += weight * adjusted * depth.measured;
    }
    fit = H.inverse() * g;
  }
  return {fit[0], std::sqrt(H.inverse()(0, 0))};
}

class Builder {
 public:
  Builder(const std::vector<Track>& tracks, const std::vector<Eigen::Quaterniond>& R_G_B,
          const StereoStructureOptions& options)
      : tracks_(tracks), R_G_B_(R_G_B), options_(options) {
    structure_.T_G_B.resize(R_G_B.size());
    structure_.rotation_information.assign(R_G_B.size(), Eigen::Matrix3d::Zero());
    structure_.position_information = structure_.rotation_information;
    structure_.p_G.resize(tracks.size());
  }

  std::optional<StereoStructure> Build(std::string* reason);
  bool Refine(std::string* reason);

 private:
  using Matrix6d = Eigen::Matrix<double, 6, 6>;
  using Vector6d = Eigen::Matrix<double, 6, 1>;

  // Normal equations of a view's pose, [position, rotation on the right].
  struct Resection {
    Matrix6d H = Matrix6d::Zero();
    Vector6d g = Vector6d::Zero();
    int inliers = 0;
  };

  bool IsUsed(const Track& track, const Track::Observation& observation) const {
    return !by_motion_ || observation.camera == track.observations.front().camera;
  }
  int ViewWithMostDepths() const;
  std::optional<Eigen::Vector3d> PointOf(const Track& track, int view) const;
  int TriangulateIn(int view);
  void AddPoint(const Eigen::Vector3d& p_G, const Track::Observation& seen,
                Resection* equations) const;
  Resection Linearize(int view) const;
  bool Resect(int view, int neighbor, std::string* reason);
  bool ResectFromHere(int view, std::string* reason);
  void TriangulateInAll();
  double DeviationByMotion(const std::vector<PosedPointObservation>& observations,
                           const Eigen::Vector3d& p_G) const;
  std::vector<DepthPair> DepthsInSingleViews() const;

  const std::vector<Track>& tracks_;
  const std::vector<Eigen::Quaterniond>& R_G_B_;
  const StereoStructureOptions options_;
  bool by_motion_ = false;  // refining, without second cameras, which may be turned
  StereoStructure structure_;
  std::vector<double> deviations_;  // of inverse depths by motion, one per track; 0 if unknown
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
  auto p_G = TriangulatePoint(observations, options_.min_angle);
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
      if (o.view == view && IsUsed(tracks_[i], o)) AddPoint(*structure_.p_G[i], o, &equations);
    }
  }
  return equations;
}

bool Builder::Resect(int view, int neighbor, std::string* reason) {
  const Rigid3d& T_G_neighbor = structure_.T_G_B[neighbor];
  structure_.T_G_B[view] = {T_G_neighbor.rotation * R_G_B_[neighbor].conjugate() * R_G_B_[view],
                            T_G_neighbor.translation};
  return ResectFromHere(view, reason);
}

bool Builder::ResectFromHere(int view, std::string* reason) {
  Rigid3d& T_G_B = structure_.T_G_B[view];
  Resection equations;
  const int iterations = by_motion_ ? kRefiningIterations : kResectionIterations;
  for (int i = 0; i < iterations; ++i) {
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
  const Eigen::Matrix3d H_t = equations.H.topLeftCorner<3, 3>();
  const Eigen::Matrix3d H_r = equations.H.bottomRightCorner<3, 3>();
  const Eigen::Matrix3d H_tr = equations.H.topRightCorner<3, 3>();
  const Eigen::Matrix3d H_rt = H_tr.transpose();
  structure_.rotation_information[view] = H_r - H_rt * SolveSymmetric(H_t, H_tr);
  structure_.position_information[view] = H_t - H_tr * SolveSymmetric(H_r, H_rt);
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
  if (options_.refinements > 0 && !Refine(reason)) return std::nullopt;
  return structure_;
}

}  // namespace

// Points with too little parallax keep their positions.
void Builder::TriangulateInAll() {
  deviations_.assign(tracks_.size(), 0);
  for (size_t i = 0; i < tracks_.size(); ++i) {
    if (!structure_.p_G[i]) continue;
    std::vector<PosedPointObservation> observations;
    for (const Track::Observation& o : tracks_[i].observations) {
      if (!IsUsed(tracks_[i], o)) continue;
      observations.push_back({structure_.T_G_B[o.view] * options_.T_B_C[o.camera], o.xy});
    }
    const auto p_G = TriangulatePoint(observations, options_.min_angle);
    if (!p_G) continue;
    structure_.p_G[i] = p_G;
    deviations_[i] = DeviationByMotion(observations, *p_G);
  }
}

// Returns the deviation of a point's inverse depth, by the spread of the cameras across its rays.
double Builder::DeviationByMotion(const std::vector<PosedPointObservation>& observations,
                                  const Eigen::Vector3d& p_G) const {
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (const auto& o : observations) mean += o.T_W_C.translation / observations.size();
  const Eigen::Vector3d ray = (p_G - mean).normalized();
  double spread = 0;
  for (const auto& o : observations) {
    spread += (o.T_W_C.translation - mean).cross(ray).squaredNorm();
  }
  return options_.noise / std::sqrt(spread);
}

std::vector<DepthPair> Builder::DepthsInSingleViews() const {
  std::vector<DepthPair> depths;
  for (size_t i = 0; i < tracks_.size(); ++i) {
    if (!structure_.p_G[i] || !(deviations_[i] > 0)) continue;
    const size_t before = depths.size();
    for (const Track::Observation& o : tracks_[i].observations) {
      const Track::Observation* first = tracks_[i].In(o.view);
      if (&o == first && !o.depth) continue;
      const Rigid3d T_G_C = structure_.T_G_B[o.view] * options_.T_B_C[first->camera];
      const double z = (T_G_C.Inverse() * *structure_.p_G[i]).z();
      if (!(z > kMinTriangulatedDepth)) continue;
      DepthPair depth{o.depth ? 1 / *o.depth : 0, 0, 0, 0};
      if (!o.depth) {
        depth = DepthByTwoRays(first->xy, o.xy,
                               options_.T_B_C[o.camera].Inverse() * options_.T_B_C[first->camera],
                               options_.noise);
      }
      depth.expected = 1 / z;
      depth.expected_deviation = deviations_[i];
      if (o.depth) depth.deviation = kDepthDeviation * depth.expected;
      depths.push_back(depth);
    }
    for (size_t k = before; k < depths.size(); ++k) {
      depths[k].share = 1.0 / (depths.size() - before);
    }
  }
  return depths;
}

bool Builder::Refine(std::string* reason) {
  const int count = static_cast<int>(R_G_B_.size());
  by_motion_ = true;
  for (int k = 0; k < options_.refinements; ++k) {
    TriangulateInAll();
    for (int view = 0; view < count; ++view) {
      if (structure_.position_information[view].isZero()) continue;  // the origin
      if (!ResectFromHere(view, reason)) return false;
    }
  }
  const auto [ratio, deviation] = FitRatio(DepthsInSingleViews());
  if (!(ratio > kLeastRatio)) {
    *reason = "measured depths are unrelated to those by motion";
    return false;
  }
  structure_.scale_deviation = deviation / ratio;
  for (Rigid3d& T_G_B : structure_.T_G_B) {  // the cameras' centers scale, not the lever arms
    const Eigen::Vector3d lever_G = T_G_B.rotation * options_.T_B_C[0].translation;
    T_G_B.translation = (T_G_B.translation + lever_G) / ratio - lever_G;
  }
  for (auto& p_G : structure_.p_G) {
    if (p_G) *p_G /= ratio;
  }
  for (Eigen::Matrix3d& information : structure_.position_information) {
    information *= ratio * ratio;
  }
  return true;
}

std::optional<StereoStructure> ReconstructFromStereo(const std::vector<Track>& tracks,
                                                     const std::vector<Eigen::Quaterniond>& R_G_B,
                                                     const StereoStructureOptions& options,
                                                     std::string* reason) {
  return Builder(tracks, R_G_B, options).Build(reason);
}

}  // namespace plm_vins
