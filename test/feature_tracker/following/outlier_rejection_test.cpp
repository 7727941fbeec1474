// SPDX-License-Identifier: BSD-3-Clause
#include "feature_tracker/following/outlier_rejection.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "common/geometry/so3.h"

namespace plm_vins {
namespace {

constexpr double kPixel = 1.0 / 460;  // [rad]
constexpr double kThreshold = 1.0 * kPixel;

// A camera that moves through a cloud of points 2 to 12 m ahead; pixel noise on both rays.
class EpipolarTest : public testing::Test {
 protected:
  std::vector<RayPair> Simulate(const Eigen::Quaterniond& R_now_then, const Eigen::Vector3d& t_now,
                                size_t count = 150, double noise = 0.15 * kPixel) {
    std::vector<RayPair> pairs;
    while (pairs.size() < count) {
      const double depth = Uniform(2, 12);
      const Eigen::Vector3d p_C0 =
          depth * Eigen::Vector3d(Uniform(-0.8, 0.8), Uniform(-0.5, 0.5), 1);
      pairs.push_back({Noisy(p_C0.normalized(), noise),
                       Noisy((R_now_then * p_C0 + t_now).normalized(), noise)});
    }
    return pairs;
  }

  // Moves the first `count` rays by 8 to 30 pixels, most of them off their epipolar line.
  void Spoil(size_t count, std::vector<RayPair>* pairs) {
    for (size_t i = 0; i < count; ++i) {
      const double angle = Uniform(-M_PI, M_PI);
      const double size = Uniform(8, 30) * kPixel;
      const Eigen::Vector3d axis(std::cos(angle), std::sin(angle), 0);
      (*pairs)[i].ray_now = SO3Exp(size * axis) * (*pairs)[i].ray_now;
    }
  }

  double Uniform(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random_);
  }

  Eigen::Vector3d Noisy(const Eigen::Vector3d& ray, double noise) {
    std::normal_distribution<double> normal(0, noise);
    return SO3Exp({normal(random_), normal(random_), normal(random_)}) * ray;
  }

  static double Share(const std::vector<bool>& inliers, size_t begin, size_t end) {
    return static_cast<double>(std::count(inliers.begin() + begin, inliers.begin() + end, true)) /
           static_cast<double>(end - begin);
  }

  std::mt19937 random_{5};
  const Eigen::Quaterniond R_now_then_ = SO3Exp({0.02, -0.03, 0.01});
  const Eigen::Vector3d t_C1_{0.08, 0.02, -0.05};
};

TEST_F(EpipolarTest, SeparatesOutliersWithTheGyro) {
  auto pairs = Simulate(R_now_then_, t_C1_);
  Spoil(50, &pairs);
  const auto inliers = FindEpipolarInliers(pairs, R_now_then_, kThreshold);
  EXPECT_LT(Share(inliers, 0, 50), 0.15);  // those that moved along their epipolar line
  EXPECT_EQ(Share(inliers, 50, 150), 1.0);
}

TEST_F(EpipolarTest, SeparatesOutliersWithoutTheGyro) {
  auto pairs = Simulate(R_now_then_, t_C1_);
  Spoil(40, &pairs);
  const auto inliers = FindEpipolarInliers(pairs, std::nullopt, kThreshold);
  EXPECT_LT(Share(inliers, 0, 40), 0.15);
  EXPECT_GT(Share(inliers, 40, 150), 0.98);
}

TEST_F(EpipolarTest, ToleratesTheGyrosBias) {
  auto pairs = Simulate(R_now_then_, t_C1_);
  Spoil(30, &pairs);
  const Eigen::Quaterniond biased = SO3Exp({0.003, -0.002, 0.004}) * R_now_then_;
  const auto inliers = FindEpipolarInliers(pairs, biased, kThreshold);
  EXPECT_LT(Share(inliers, 0, 30), 0.2);
  EXPECT_GT(Share(inliers, 30, 150), 0.97);
}

TEST_F(EpipolarTest, KeepsGoodPairsWithoutParallax) {
  for (const bool turns : {true, false}) {
    const Eigen::Quaterniond R = turns ? R_now_then_ : Eigen::Quaterniond::Identity();
    const auto pairs = Simulate(R, Eigen::Vector3d::Zero());
    EXPECT_GT(Share(FindEpipolarInliers(pairs, R, kThreshold), 0, pairs.size()), 0.99);
    EXPECT_GT(Share(FindEpipolarInliers(pairs, std::nullopt, kThreshold), 0, pairs.size()), 0.99);
  }
}

TEST_F(EpipolarTest, KeepsIdenticalRays) {
  std::vector<RayPair> pairs = Simulate(Eigen::Quaterniond::Identity(), {0, 0, 0}, 50, 0);
  for (RayPair& pair : pairs) pair.ray_now = pair.ray_then;
  EXPECT_EQ(Share(FindEpipolarInliers(pairs, std::nullopt, kThreshold), 0, 50), 1.0);
}

TEST_F(EpipolarTest, KeepsGoodPairsMovingForward) {  // the epipole is in the image
  const auto pairs = Simulate(Eigen::Quaterniond::Identity(), {0, 0, -0.1});
  EXPECT_GT(Share(FindEpipolarInliers(pairs, std::nullopt, kThreshold), 0, pairs.size()), 0.99);
}

TEST_F(EpipolarTest, KeepsAllOfTooFew) {
  auto pairs = Simulate(R_now_then_, t_C1_, 7);
  Spoil(4, &pairs);
  EXPECT_EQ(Share(FindEpipolarInliers(pairs, R_now_then_, kThreshold), 0, 7), 1.0);
  EXPECT_TRUE(FindEpipolarInliers({}, std::nullopt, kThreshold).empty());
}

TEST_F(EpipolarTest, IsDeterministic) {
  auto pairs = Simulate(R_now_then_, t_C1_);
  Spoil(60, &pairs);
  EXPECT_EQ(FindEpipolarInliers(pairs, std::nullopt, kThreshold),
            FindEpipolarInliers(pairs, std::nullopt, kThreshold));
}

}  // namespace
}  // namespace plm_vins
