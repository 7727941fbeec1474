// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/structure_from_motion/stereo_structure.h"

#include <gtest/gtest.h>

#include <cmath>

#include "common/geometry/so3.h"
#include "simulator/random.h"
#include "vins_estimator/geometry/point_triangulation.h"

namespace plm_vins {
namespace {

using Eigen::Quaterniond;
using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr int kStereoViews = 6;
constexpr double kPixel = 1 / 460.0;

// A stereo camera, whose first camera is the body, that moves by 2 cm per view before a cloud of
// points, of which each is observed by four views in a row and by the second camera in the first of
// these.
struct StereoScene {
  StereoScene(double noise, double outlier_ratio, double step = 0.02, double nearest = 2,
              double farthest = 8, uint64_t seed = 1)
      : nearest(nearest), farthest(farthest) {
    simulator::Random random(seed);
    for (int i = 0; i < kStereoViews; ++i) {
      T_W_C.push_back({SO3Exp({0.01 * i, -0.03 * i, 0.02 * i}), step * i * Vector3d(0.5, 0.2, 1)});
    }
    for (int first = 0; first < kStereoViews; ++first) {
      for (int k = 0; k < 40; ++k) AddTrack(first, noise, outlier_ratio, &random);
    }
  }

  void AddTrack(int first, double noise, double outlier_ratio, simulator::Random* random) {
    const Vector3d ray(random->Uniform(-0.6, 0.6), random->Uniform(-0.4, 0.4), 1);
    const Vector3d p_W = T_W_C[first] * (random->Uniform(nearest, farthest) * ray);
    const auto seen_from = [&](const Rigid3d& T_W_camera) -> Vector2d {
      const Vector2d xy = (T_W_camera.Inverse() * p_W).hnormalized();
      return xy + noise * Vector2d(random->Normal(), random->Normal());
    };
    Track track;
    track.id = static_cast<int64_t>(tracks.size());
    for (int view = first; view < std::min(first + 4, kStereoViews); ++view) {
      track.observations.push_back({view, 0, seen_from(T_W_C[view])});
    }
    Track::Observation second{first, 1, seen_from(T_W_C[first] * T_C_C1)};
    if (random->Uniform(0, 1) < outlier_ratio) second.xy.x() -= random->Uniform(0, 0.05);
    track.observations.insert(track.observations.begin() + 1, second);
    tracks.push_back(track);
  }

  // Rotations that are wrong by up to a degree, as a gyroscope with a bias has them.
  std::vector<Quaterniond> WrongRotations() const {
    std::vector<Quaterniond> rotations;
    rotations.reserve(kStereoViews);
    for (int i = 0; i < kStereoViews; ++i) {
      rotations.push_back(T_W_C[i].rotation * SO3Exp(Vector3d(0.003, -0.002, 0.001) * i));
    }
    return rotations;
  }

  std::optional<StereoStructure> Reconstruct() {
    return ReconstructFromStereo(tracks, WrongRotations(), {{Rigid3d(), T_C_C1}, kPixel, kPixel},
                                 &reason);
  }

  // The greatest error of a view's position relative to the first view's.
  double PositionError(const StereoStructure& structure) const {
    double greatest = 0;
    for (int i = 1; i < kStereoViews; ++i) {
      const Rigid3d found = structure.T_G_B[0].Inverse() * structure.T_G_B[i];
      const Rigid3d truth = T_W_C[0].Inverse() * T_W_C[i];
      greatest = std::max(greatest, (found.translation - truth.translation).norm());
      greatest = std::max(greatest, SO3Log(found.rotation.conjugate() * truth.rotation).norm());
    }
    return greatest;
  }

  double nearest, farthest;  // points [m]
  Rigid3d T_C_C1{SO3Exp({0.01, 0.005, -0.01}), {0.11, 0, 0}};
  std::vector<Rigid3d> T_W_C;
  std::vector<Track> tracks;
  std::string reason;
};

TEST(StereoStructure, IsExactWithoutNoise) {
  StereoScene scene(/*noise=*/0, /*outlier_ratio=*/0);
  const auto structure = scene.Reconstruct();
  ASSERT_TRUE(structure) << scene.reason;
  EXPECT_LT(scene.PositionError(*structure), 1e-6);
}

TEST(StereoStructure, ToleratesNoiseAndWrongMatches) {
  StereoScene scene(0.5 * kPixel, /*outlier_ratio=*/0.2);
  const auto structure = scene.Reconstruct();
  ASSERT_TRUE(structure) << scene.reason;
  EXPECT_LT(scene.PositionError(*structure), 0.05);
}

TEST(StereoStructure, UsesMeasuredDepths) {
  StereoScene scene(/*noise=*/0, /*outlier_ratio=*/0);
  for (Track& track : scene.tracks) {
    Track::Observation &first = track.observations[0], &second = track.observations[1];
    const auto p_C = TriangulatePoint({{Rigid3d(), first.xy}, {scene.T_C_C1, second.xy}}, 0);
    first.depth = p_C.value().z();
    track.observations.erase(track.observations.begin() + 1);
  }
  const auto structure = scene.Reconstruct();
  ASSERT_TRUE(structure) << scene.reason;
  EXPECT_LT(scene.PositionError(*structure), 1e-6);
}

TEST(StereoStructure, NeedsNoMotion) {
  StereoScene scene(0.5 * kPixel, 0, /*step=*/0);
  const auto structure = scene.Reconstruct();
  ASSERT_TRUE(structure) << scene.reason;
  EXPECT_LT(scene.PositionError(*structure), 0.01);
}

// Half a pixel is an eighth of the disparity at 12 m. Bias and error of the scale must not exceed
// what is stated.
TEST(StereoStructure, StatesTheErrorOfTheScaleOfFarPoints) {
  constexpr int kScenes = 40;
  double sum = 0, sum_of_squares = 0;
  for (uint64_t seed = 1; seed <= kScenes; ++seed) {
    StereoScene scene(0.5 * kPixel, 0, /*step=*/0.08, /*nearest=*/6, /*farthest=*/20, seed);
    const auto structure = ReconstructFromStereo(
        scene.tracks, scene.WrongRotations(),
        {{Rigid3d(), scene.T_C_C1}, 0.5 * kPixel, 3 * kPixel, /*refinements=*/4}, &scene.reason);
    ASSERT_TRUE(structure) << scene.reason;
    const auto length = [](const std::vector<Rigid3d>& T_W_C) {
      return (T_W_C.back().translation - T_W_C.front().translation).norm();
    };
    const double error = std::log(length(structure->T_G_B) / length(scene.T_W_C));
    EXPECT_LT(structure->scale_deviation, 0.2);
    sum += error / structure->scale_deviation;
    sum_of_squares += std::pow(error / structure->scale_deviation, 2);
  }
  EXPECT_LT(std::abs(sum / kScenes), 1);
  EXPECT_LT(sum_of_squares / kScenes, 1.5);
}

TEST(StereoStructure, ReportsTooFewPointsWithDepth) {
  StereoScene scene(0, 0);
  for (Track& track : scene.tracks) {
    if (track.id % 8 != 0) track.observations.erase(track.observations.begin() + 1);
  }
  EXPECT_FALSE(scene.Reconstruct());
  EXPECT_NE(scene.reason.find("the sensor: 5 of 12"), std::string::npos) << scene.reason;
}

}  // namespace
}  // namespace plm_vins
