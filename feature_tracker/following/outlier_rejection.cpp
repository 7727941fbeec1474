// SPDX-License-Identifier: BSD-3-Clause
#include "feature_tracker/following/outlier_rejection.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "common/geometry/epipolar_constraint.h"
#include "common/geometry/robust_weight.h"
#include "common/geometry/so3.h"
#include "common/geometry/symmetric_system.h"
#include "common/geometry/tangent_basis.h"

namespace plm_vins {
namespace {

constexpr size_t kMinPairs = 8;
constexpr int kHypothesesOfTwo = 40;    // (1 - 0.5^2)^40 = 1e-5: half may be outliers
constexpr int kHypothesesOfFive = 100;  // (1 - 0.6^5)^100 = 3e-4: 40 % may be outliers
constexpr double kCoarseFactor = 3.0;   // factor on the threshold in the first fit of the rotation
constexpr int kRotationIterations = 10;
constexpr int kSolverIterations = 4;
constexpr double kNotRobust = 1.0;  // [rad], exceeds any error

// Relative camera pose up to scale: p_now ~ R p_then + s t.
struct EpipolarGeometry {
  Eigen::Matrix3d R_now_then = Eigen::Matrix3d::Identity();
  Eigen::Vector3d t_now = Eigen::Vector3d::UnitZ();  // unit length
};

// Residual of the epipolar constraint t . (a x b) = 0 with a = R ray_then, b = ray_now, normalized
// to the angular error of either ray (first-order or Sampson error) [rad].
struct EpipolarResidual {
  EpipolarResidual(const EpipolarGeometry& geometry, const RayPair& pair)
      : a(geometry.R_now_then * pair.ray_then),
        b(pair.ray_now),
        weight(1.0 / std::sqrt(0.5 * (geometry.t_now.cross(a).squaredNorm() +
                                      geometry.t_now.cross(b).squaredNorm()) +
                               kEpipole)),
        error(weight * geometry.t_now.dot(a.cross(b))) {}

  static constexpr double kEpipole = 1e-9;  // avoids a division by zero for rays along t
  Eigen::Vector3d a, b;
  double weight;
  double error;  // [rad]
};

// A pair of rays, for any number of translation directions with the same rotation.
struct TurnedPair {
  TurnedPair(const Eigen::Matrix3d& R_now_then, const RayPair& pair)
      : a(R_now_then * pair.ray_then), b(pair.ray_now), normal(a.cross(b)) {}

  // Square of EpipolarResidual::error: |t x a|^2 = 1 - (t . a)^2.
  double SquaredError(const Eigen::Vector3d& t_now) const {
    const double along_a = t_now.dot(a), along_b = t_now.dot(b), across = t_now.dot(normal);
    return across * across /
           (1 - 0.5 * (along_a * along_a + along_b * along_b) + EpipolarResidual::kEpipole);
  }

  Eigen::Vector3d a, b, normal;
};

std::vector<TurnedPair> TurnAll(const std::vector<RayPair>& pairs, const Eigen::Matrix3d& R) {
  std::vector<TurnedPair> turned;
  turned.reserve(pairs.size());
  for (const RayPair& pair : pairs) turned.emplace_back(R, pair);
  return turned;
}

// Sum of truncated squared errors (MSAC); the summation stops once it reaches `limit`.
double Cost(const std::vector<TurnedPair>& pairs, const Eigen::Vector3d& t_now, double threshold,
            double limit) {
  double cost = 0;
  for (const TurnedPair& pair : pairs) {
    if (cost >= limit) break;
    cost += std::min(pair.SquaredError(t_now), threshold * threshold);
  }
  return cost;
}

// Robust rotation-only fit of the rays by Gauss-Newton on b - R a.
Eigen::Matrix3d FitRotation(const std::vector<RayPair>& pairs, double scale) {
  Eigen::Matrix3d R = Eigen::Matrix3d::Identity();
  for (int i = 0; i < kRotationIterations; ++i) {
    Eigen::Matrix3d H = Eigen::Matrix3d::Zero();
    Eigen::Vector3d g = Eigen::Vector3d::Zero();
    for (const RayPair& pair : pairs) {
      const Eigen::Vector3d a = R * pair.ray_then;
      const Eigen::Vector3d error = pair.ray_now - a;
      const double weight = GemanMcClureWeight(error.norm(), scale);
      H += weight * (Eigen::Matrix3d::Identity() - a * a.transpose());
      g += weight * a.cross(error);
    }
    const Eigen::Vector3d step = SolveSymmetric(H, g);
    if (!step.allFinite()) break;
    R = SO3Exp(step) * R;
  }
  return R;
}

// Translation direction from two pairs: t . (a x b) = 0 for both.
std::optional<Eigen::Vector3d> TranslationOfTwo(const Eigen::Matrix3d& R_now_then,
                                                const RayPair& pair0, const RayPair& pair1) {
  const Eigen::Vector3d normal0 = (R_now_then * pair0.ray_then).cross(pair0.ray_now);
  const Eigen::Vector3d normal1 = (R_now_then * pair1.ray_then).cross(pair1.ray_now);
  const Eigen::Vector3d t = normal0.cross(normal1);
  const double length = t.norm();
  if (!(length > 0)) return std::nullopt;
  return t / length;
}

// One robust Gauss-Newton step on rotation (R <- Exp(w) R) and translation direction. It is damped,
// since the latter is unobservable without parallax.
EpipolarGeometry Refine(const std::vector<RayPair>& pairs, const EpipolarGeometry& geometry,
                        double scale) {
  using Matrix5d = Eigen::Matrix<double, 5, 5>;
  using Vector5d = Eigen::Matrix<double, 5, 1>;
  constexpr double kDamping = 1e-4;
  const Eigen::Matrix<double, 3, 2> basis = TangentBasis(geometry.t_now);
  Matrix5d H = kDamping * Matrix5d::Identity();
  Vector5d g = Vector5d::Zero();
  for (const RayPair& pair : pairs) {
    const EpipolarResidual r(geometry, pair);
    const Vector5d J = EpipolarGradient(r.weight, r.a, r.b, geometry.t_now, basis);
    const double weight = GemanMcClureWeight(r.error, scale);
    H.noalias() += weight * J * J.transpose();
    g.noalias() -= weight * r.error * J;
  }
  const Vector5d step = SolveSymmetric(H, g);
  if (!step.allFinite()) return geometry;
  return {SO3Exp(step.head<3>()) * geometry.R_now_then,
          (geometry.t_now + basis * step.tail<2>()).normalized()};
}

// Draws `count` pairs with replacement.
std::vector<RayPair> Draw(const std::vector<RayPair>& pairs, size_t count, std::mt19937* random) {
  std::vector<RayPair> sample;
  while (sample.size() < count) sample.push_back(pairs[(*random)() % pairs.size()]);
  return sample;
}

// RANSAC. The translation is computed from two pairs and the given rotation. If the rotation is
// unknown, it is optimized together with the translation over the (larger) sample.
EpipolarGeometry FindGeometry(const std::vector<RayPair>& pairs, const Eigen::Matrix3d& R,
                              bool is_rotation_known, double threshold) {
  std::mt19937 random;  // default seed, for reproducible results
  EpipolarGeometry best{R, Eigen::Vector3d::UnitZ()};
  const std::vector<TurnedPair> turned = TurnAll(pairs, R);
  double best_cost = Cost(turned, best.t_now, threshold, std::numeric_limits<double>::infinity());
  const int hypotheses = is_rotation_known ? kHypothesesOfTwo : kHypothesesOfFive;
  for (int i = 0; i < hypotheses; ++i) {
    const auto sample = Draw(pairs, is_rotation_known ? 2 : 5, &random);
    const auto t = TranslationOfTwo(R, sample[0], sample[1]);
    if (!t) continue;
    EpipolarGeometry geometry{R, *t};
    for (int k = 0; !is_rotation_known && k < kSolverIterations; ++k) {
      geometry = Refine(sample, geometry, kNotRobust);
    }
    const double cost = Cost(is_rotation_known ? turned : TurnAll(pairs, geometry.R_now_then),
                             geometry.t_now, threshold, best_cost);
    if (cost < best_cost) {
      best = geometry;
      best_cost = cost;
    }
  }
  return best;
}

}  // namespace

std::vector<bool> FindEpipolarInliers(const std::vector<RayPair>& pairs,
                                      const std::optional<Eigen::Quaterniond>& R_now_then,
                                      double threshold) {
  std::vector<bool> inliers(pairs.size(), true);
  if (pairs.size() < kMinPairs) return inliers;
  const double coarse = kCoarseFactor * threshold;
  const Eigen::Matrix3d R =
      R_now_then ? R_now_then->toRotationMatrix() : FitRotation(pairs, coarse);
  EpipolarGeometry geometry = FindGeometry(pairs, R, R_now_then.has_value(), coarse);
  for (const double scale : {coarse, coarse, threshold, threshold, threshold}) {
    geometry = Refine(pairs, geometry, scale);
  }
  for (size_t i = 0; i < pairs.size(); ++i) {
    inliers[i] = std::abs(EpipolarResidual(geometry, pairs[i]).error) <= threshold;
  }
  return inliers;
}

}  // namespace plm_vins
