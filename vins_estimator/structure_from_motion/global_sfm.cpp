// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/structure_from_motion/global_sfm.h"

#include <ceres/ceres.h>

#include <algorithm>
#include <cmath>

#include "common/format.h"
#include "common/geometry/symmetric_system.h"
#include "vins_estimator/structure_from_motion/relative_pose.h"

namespace plm_vins {
namespace {

constexpr size_t kMinPairPoints = 20;  // common points of the initial pair
constexpr int kMinPointsToResect = 10;
constexpr int kMinStructurePoints = 20;          // in the whole structure
constexpr double kParallaxCap = 0.2;             // more does not improve the score of a pair [rad]
constexpr double kMinTriangulationSigmas = 4.0;  // least angle between rays, in standard deviations
constexpr double kMaxReprojectionSigmas = 3.0;
constexpr double kMinDepth = 1e-3;  // in units of the first baseline
constexpr int kBundleIterations = 12;
constexpr double kBundleTolerance = 1e-2;  // coarse: the visual-inertial bundle refines it
constexpr int kIntersectionIterations = 4;
constexpr double kMinDeterminant = 1e-10;  // of the normal equations, whose trace is one

// A line in G: all points origin + depth * direction (unit vector).
struct Line {
  Eigen::Vector3d origin, direction;
};

// Returns the point with the smallest angular distances from the lines, robustly. It triangulates a
// point from several cameras, and also resects a camera from several points.
std::optional<Eigen::Vector3d> IntersectLines(const std::vector<Line>& lines, double noise) {
  Eigen::Vector3d point = Eigen::Vector3d::Zero();
  for (int iteration = 0; iteration < kIntersectionIterations; ++iteration) {
    Eigen::Matrix3d A = Eigen::Matrix3d::Zero();
    Eigen::Vector3d b = Eigen::Vector3d::Zero();
    for (const Line& line : lines) {
      const Eigen::Matrix3d across =
          Eigen::Matrix3d::Identity() - line.direction * line.direction.transpose();
      double weight = 1;
      if (iteration > 0) {
        const Eigen::Vector3d offset = point - line.origin;
        const double sigma = noise * std::max(offset.norm(), 1e-3);
        weight = 1 / (sigma * sigma + (across * offset).squaredNorm());
      }
      A += weight * across;
      b += weight * across * line.origin;
    }
    const double size = A.trace();
    if (A.determinant() < kMinDeterminant * size * size * size) return std::nullopt;
    point = SolveSymmetric(A, b);
  }
  return point;
}

// Reprojection of a point into a view with known rotation. Blocks: p_G_C, p_G.
class PositionCost {
 public:
  PositionCost(const Eigen::Quaterniond& R_G_C, const Eigen::Vector2d& xy, double noise)
      : R_C_G_(R_G_C.conjugate()), xy_(xy), noise_(noise) {}

  template <typename T>
  bool operator()(const T* p_G_C, const T* p_G, T* residual) const {
    using Vector3 = Eigen::Matrix<T, 3, 1>;
    const Vector3 offset = Eigen::Map<const Vector3>(p_G) - Eigen::Map<const Vector3>(p_G_C);
    const Vector3 p_C = R_C_G_.cast<T>() * offset;
    if (p_C.z() < T(kMinDepth)) return false;
    residual[0] = (p_C.x() / p_C.z() - xy_.x()) / noise_;
    residual[1] = (p_C.y() / p_C.z() - xy_.y()) / noise_;
    return true;
  }

 private:
  Eigen::Quaterniond R_C_G_;
  Eigen::Vector2d xy_;
  double noise_;
};

// Incremental reconstruction.
class SfmBuilder {
 public:
  SfmBuilder(const std::vector<Track>& tracks, const std::vector<Eigen::Quaterniond>& R_G_C,
             const GlobalSfmOptions& options)
      : tracks_(tracks),
        R_G_C_(R_G_C),
        options_(options),
        noise_(options.noise_px / options.focal_length),
        posed_(R_G_C.size(), false) {
    structure_.p_G_C.assign(R_G_C.size(), Eigen::Vector3d::Zero());
    structure_.p_G.resize(tracks.size());
  }

  std::optional<Structure> Build(std::string* reason);

 private:
  Eigen::Vector3d Ray(const Track::Observation& o) const {
    return R_G_C_[o.view] * o.xy.homogeneous().normalized();
  }
  Eigen::Vector3d InCamera(int view, const Eigen::Vector3d& p_G) const {
    return R_G_C_[view].conjugate() * (p_G - structure_.p_G_C[view]);
  }
  bool Start(std::string* reason);
  std::pair<int, int> BestPair() const;
  void Place(int view, const Eigen::Vector3d& p_G_C);
  std::optional<Eigen::Vector3d> TriangulateTrack(const Track& track) const;
  int NextView() const;
  bool Resect(int view);
  bool AdjustBundle();
  void RemoveOutliers();
  bool Fits(const Track& track, const Eigen::Vector3d& p_G) const;
  void MoveOriginToFirstView();

  const std::vector<Track>& tracks_;
  const std::vector<Eigen::Quaterniond>& R_G_C_;
  GlobalSfmOptions options_;
  double noise_;  // noise of a normalized coordinate
  std::vector<bool> posed_;
  Structure structure_;
};

// Returns the pair with the largest sum of (capped) parallax angles over its common points; without
// parallax, the pair with the most points.
std::pair<int, int> SfmBuilder::BestPair() const {
  const int n = static_cast<int>(R_G_C_.size());
  Eigen::MatrixXd score = Eigen::MatrixXd::Zero(n, n);
  for (const Track& track : tracks_) {
    for (size_t i = 0; i < track.observations.size(); ++i) {
      for (size_t j = i + 1; j < track.observations.size(); ++j) {
        const Track::Observation &a = track.observations[i], &b = track.observations[j];
        score(a.view, b.view) += std::min(1e-9 + Ray(a).cross(Ray(b)).norm(), kParallaxCap);
      }
    }
  }
  int first = 0, second = 0;
  score.maxCoeff(&first, &second);
  return {first, second};
}

bool SfmBuilder::Start(std::string* reason) {
  const auto [first, second] = BestPair();
  const auto correspondences = FindCorrespondences(tracks_, first, second);
  if (first == second || correspondences.size() < kMinPairPoints) {
    *reason = "too few common points: " + std::to_string(correspondences.size()) + " of " +
              std::to_string(kMinPairPoints);
    return false;
  }
  const Eigen::Quaterniond R_now_then = R_G_C_[second].conjugate() * R_G_C_[first];
  const double parallax_px = options_.focal_length * MedianParallax(correspondences, R_now_then);
  if (parallax_px < options_.min_parallax_px) {
    *reason =
        Format("too little parallax: %.1f px of %.1f px", parallax_px, options_.min_parallax_px);
    return false;
  }
  const auto pose = EstimateRelativePose(correspondences, R_now_then, noise_, reason);
  if (!pose) return false;
  Place(first, Eigen::Vector3d::Zero());
  Place(second, -(R_G_C_[second] * pose->t_now_then));
  return true;
}

std::optional<Eigen::Vector3d> SfmBuilder::TriangulateTrack(const Track& track) const {
  std::vector<Line> lines;
  double widest = 0;
  for (const Track::Observation& o : track.observations) {
    if (!posed_[o.view]) continue;
    lines.push_back({structure_.p_G_C[o.view], Ray(o)});
    for (const Line& line : lines) {
      widest = std::max(widest, line.direction.cross(lines.back().direction).norm());
    }
  }
  if (widest < kMinTriangulationSigmas * noise_) return std::nullopt;
  auto point = IntersectLines(lines, noise_);
  if (!point) return std::nullopt;
  for (const Track::Observation& o : track.observations) {
    if (posed_[o.view] && InCamera(o.view, *point).z() <= kMinDepth) return std::nullopt;
  }
  return point;
}

// Sets the position of a view and re-triangulates the points that it observes.
void SfmBuilder::Place(int view, const Eigen::Vector3d& p_G_C) {
  structure_.p_G_C[view] = p_G_C;
  posed_[view] = true;
  for (size_t i = 0; i < tracks_.size(); ++i) {
    if (tracks_[i].In(view) != nullptr) structure_.p_G[i] = TriangulateTrack(tracks_[i]);
  }
}

// Returns the view without position that observes the most points; -1 if none observes enough.
int SfmBuilder::NextView() const {
  std::vector<int> seen(posed_.size(), 0);
  for (size_t i = 0; i < tracks_.size(); ++i) {
    if (!structure_.p_G[i]) continue;
    for (const Track::Observation& o : tracks_[i].observations) seen[o.view] += !posed_[o.view];
  }
  const auto most = std::max_element(seen.begin(), seen.end());
  return *most < kMinPointsToResect ? -1 : static_cast<int>(most - seen.begin());
}

bool SfmBuilder::Resect(int view) {
  std::vector<Line> lines;
  for (size_t i = 0; i < tracks_.size(); ++i) {
    if (!structure_.p_G[i]) continue;
    for (const Track::Observation& o : tracks_[i].observations) {
      if (o.view == view) lines.push_back({*structure_.p_G[i], Ray(o)});
    }
  }
  const auto position = IntersectLines(lines, noise_);
  if (!position) return false;
  Place(view, *position);
  return true;
}

bool SfmBuilder::AdjustBundle() {
  ceres::Problem problem;
  for (size_t i = 0; i < tracks_.size(); ++i) {
    if (!structure_.p_G[i]) continue;
    for (const Track::Observation& o : tracks_[i].observations) {
      problem.AddResidualBlock(new ceres::AutoDiffCostFunction<PositionCost, 2, 3, 3>(
                                   new PositionCost(R_G_C_[o.view], o.xy, noise_)),
                               new ceres::CauchyLoss(1.0), structure_.p_G_C[o.view].data(),
                               structure_.p_G[i]->data());
    }
  }
  // Scale and origin are not fixed: the solver's damping keeps them in place.
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::DENSE_SCHUR;
  options.max_num_iterations = kBundleIterations;
  options.function_tolerance = kBundleTolerance;
  options.num_threads = 1;
  options.logging_type = ceres::SILENT;
  ceres::Solver::Summary summary;
  ceres::Solve(options, &problem, &summary);
  return summary.IsSolutionUsable();
}

// Returns whether all observations of the track are inliers.
bool SfmBuilder::Fits(const Track& track, const Eigen::Vector3d& p_G) const {
  for (const Track::Observation& o : track.observations) {
    const Eigen::Vector3d p_C = InCamera(o.view, p_G);
    if (p_C.z() <= 0) return false;
    const double squared = (p_C.hnormalized() - o.xy).squaredNorm();
    if (squared > std::pow(kMaxReprojectionSigmas * noise_, 2)) return false;
  }
  return true;
}

void SfmBuilder::RemoveOutliers() {
  for (size_t i = 0; i < tracks_.size(); ++i) {
    if (!structure_.p_G[i]) continue;
    if (Fits(tracks_[i], *structure_.p_G[i])) {
      ++structure_.num_points;
    } else {
      structure_.p_G[i].reset();
    }
  }
}

void SfmBuilder::MoveOriginToFirstView() {
  const Eigen::Vector3d origin = structure_.p_G_C[0];
  for (Eigen::Vector3d& position : structure_.p_G_C) position -= origin;
  for (auto& point : structure_.p_G) {
    if (point) *point -= origin;
  }
}

std::optional<Structure> SfmBuilder::Build(std::string* reason) {
  if (!Start(reason)) return std::nullopt;
  while (!std::all_of(posed_.begin(), posed_.end(), [](bool posed) { return posed; })) {
    const int view = NextView();
    if (view < 0 || !Resect(view)) {
      *reason = "a frame shares too few points with the others";
      return std::nullopt;
    }
  }
  if (!AdjustBundle()) {
    *reason = "the bundle adjustment of the structure failed";
    return std::nullopt;
  }
  RemoveOutliers();
  if (structure_.num_points < kMinStructurePoints) {
    *reason = "too few points in the structure: " + std::to_string(structure_.num_points) + " of " +
              std::to_string(kMinStructurePoints);
    return std::nullopt;
  }
  MoveOriginToFirstView();
  return structure_;
}

}  // namespace

std::optional<Structure> ReconstructStructure(const std::vector<Track>& tracks,
                                              const std::vector<Eigen::Quaterniond>& R_G_C,
                                              const GlobalSfmOptions& options,
                                              std::string* reason) {
  return SfmBuilder(tracks, R_G_C, options).Build(reason);
}

}  // namespace plm_vins
