// SPDX-License-Identifier: BSD-3-Clause
#include "pose_graph/verification/level_pose_ransac.h"

#include <algorithm>
#include <cmath>
#include <random>

namespace plm_vins {
namespace {

constexpr size_t kMinInliers = 3;  // two observations always agree
constexpr uint32_t kSeed = 1;

// Returns the number of samples of which, with this confidence, one has inliers only.
int IterationsFor(double inlier_share, double confidence) {
  const double hit = inlier_share * inlier_share;
  if (hit >= 1) return 1;
  return static_cast<int>(std::ceil(std::log(1 - confidence) / std::log(1 - hit)));
}

size_t CountInliers(const LevelTransform& T_O_G, const std::vector<SeenPoint>& observations,
                    const Eigen::Quaterniond& R_G_C, double max_error) {
  const Viewpoint viewpoint(T_O_G, R_G_C);
  return std::count_if(observations.begin(), observations.end(), [&](const SeenPoint& observation) {
    return viewpoint.Error(observation) <= max_error;
  });
}

std::vector<size_t> InliersOf(const LevelTransform& T_O_G,
                              const std::vector<SeenPoint>& observations,
                              const Eigen::Quaterniond& R_G_C, double max_error) {
  const Viewpoint viewpoint(T_O_G, R_G_C);
  std::vector<size_t> inliers;
  for (size_t i = 0; i < observations.size(); ++i) {
    if (viewpoint.Error(observations[i]) <= max_error) inliers.push_back(i);
  }
  return inliers;
}

}  // namespace

std::vector<LevelTransform> SolveTwoPoints(const Eigen::Vector3d& ray1_G,
                                           const Eigen::Vector3d& p1_O,
                                           const Eigen::Vector3d& ray2_G,
                                           const Eigen::Vector3d& p2_O) {
  // p1_O - p2_O = Rz(yaw) (l1 ray1_G - l2 ray2_G). The z components restrict the ray lengths (l1,
  // l2) to a line: nearest + s along.
  const Eigen::Vector3d difference = p1_O - p2_O;
  const Eigen::Vector2d heights(ray1_G.z(), -ray2_G.z());
  if (heights.squaredNorm() < 1e-12) return {};
  const Eigen::Vector2d nearest = heights * difference.z() / heights.squaredNorm();
  const Eigen::Vector2d along = Eigen::Vector2d(-heights.y(), heights.x()).normalized();
  Eigen::Matrix2d horizontal;
  horizontal << ray1_G.head<2>(), -ray2_G.head<2>();

  const Eigen::Vector2d start = horizontal * nearest;
  const Eigen::Vector2d slope = horizontal * along;
  const double a = slope.squaredNorm();
  const double b = start.dot(slope);
  const double c = start.squaredNorm() - difference.head<2>().squaredNorm();
  const double discriminant = b * b - a * c;
  if (a < 1e-12 || discriminant < 0) return {};

  std::vector<LevelTransform> poses;
  for (const double sign : {-1.0, 1.0}) {
    const Eigen::Vector2d lengths = nearest + (-b + sign * std::sqrt(discriminant)) / a * along;
    if (lengths.minCoeff() <= 0) continue;
    const Eigen::Vector2d seen = horizontal * lengths;
    LevelTransform T_O_G;
    T_O_G.yaw =
        WrapAngle(std::atan2(difference.y(), difference.x()) - std::atan2(seen.y(), seen.x()));
    T_O_G.translation = p1_O - T_O_G.rotation() * (lengths(0) * ray1_G);
    poses.push_back(T_O_G);
  }
  return poses;
}

std::optional<LevelPose> FindLevelPose(const LevelPoseRansacOptions& options,
                                       const std::vector<SeenPoint>& observations,
                                       const Eigen::Quaterniond& R_G_C) {
  if (observations.size() < 2) return std::nullopt;
  std::mt19937 random(kSeed);
  LevelTransform best;
  size_t most = 0;  // inlier count
  int iterations = options.max_iterations;
  for (int i = 0; i < iterations; ++i) {
    const SeenPoint& first = observations[random() % observations.size()];
    const SeenPoint& second = observations[random() % observations.size()];
    if (&first == &second) continue;
    const auto poses = SolveTwoPoints(R_G_C * first.xy.homogeneous(), first.p_O,
                                      R_G_C * second.xy.homogeneous(), second.p_O);
    for (const LevelTransform& pose : poses) {
      const size_t inliers = CountInliers(pose, observations, R_G_C, options.max_error);
      if (inliers <= most) continue;
      best = pose;
      most = inliers;
      const double share = static_cast<double>(most) / observations.size();
      iterations = std::min(iterations, IterationsFor(share, options.confidence) + i);
    }
  }
  if (most < kMinInliers) return std::nullopt;
  return LevelPose{best, InliersOf(best, observations, R_G_C, options.max_error)};
}

}  // namespace plm_vins
