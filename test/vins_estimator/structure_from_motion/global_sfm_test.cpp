// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/structure_from_motion/global_sfm.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "common/geometry/so3.h"
#include "common/statistics.h"
#include "simulator/random.h"
#include "test/vins_estimator/initialization/simulated_frames.h"

namespace plm_vins {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

using Eigen::Quaterniond;
using Eigen::Vector3d;

const GlobalSfmOptions kOptions = {/*focal_length=*/460, /*noise_px=*/1, /*min_parallax_px=*/15};
constexpr int kViews = 8;

// Cameras on an arc in front of a point cloud; each point is observed by four consecutive cameras,
// so that the first and the last camera have no common points.
struct Scene {
  std::vector<Quaterniond> R_G_C;
  std::vector<Vector3d> p_G_C;
  std::vector<Vector3d> points;
  std::vector<Track> tracks;

  Scene(double step, double noise, double outlier_ratio, int points_per_view, uint64_t seed) {
    simulator::Random random(seed);
    for (int i = 0; i < kViews; ++i) {
      R_G_C.push_back(SO3Exp({0.01 * i, -0.03 * i, 0.02 * i}));
      p_G_C.push_back(step * Vector3d(i, 0.3 * i * i / kViews, -0.2 * i));
    }
    for (int i = 0; i < kViews; ++i) {
      for (int k = 0; k < points_per_view; ++k) AddPoint(i, noise, outlier_ratio, &random);
    }
  }

  void AddPoint(int first, double noise, double outlier_ratio, simulator::Random* random) {
    const Vector3d ray(random->Uniform(-0.6, 0.6), random->Uniform(-0.4, 0.4), 1);
    const Vector3d p_G = R_G_C[first] * (random->Uniform(2, 6) * ray) + p_G_C[first];
    Track track;
    track.id = static_cast<int64_t>(tracks.size());
    for (int view = first; view < std::min(first + 4, kViews); ++view) {
      const Vector3d p_C = R_G_C[view].conjugate() * (p_G - p_G_C[view]);
      Eigen::Vector2d xy = p_C.hnormalized();
      xy += noise * Eigen::Vector2d(random->Normal(), random->Normal());
      if (random->Uniform(0, 1) < outlier_ratio) xy.x() += random->Uniform(0.05, 0.2);
      track.observations.push_back({view, 0, xy});
    }
    points.push_back(p_G);
    tracks.push_back(track);
  }
};

// Largest position error after alignment of the scale, relative to the scene's size.
double RelativeError(const Structure& structure, const Scene& scene) {
  double product = 0, squares = 0;
  for (int i = 0; i < kViews; ++i) {
    product += structure.p_G_C[i].dot(scene.p_G_C[i]);
    squares += structure.p_G_C[i].squaredNorm();
  }
  double worst = 0;
  for (int i = 0; i < kViews; ++i) {
    worst = std::max(worst, (product / squares * structure.p_G_C[i] - scene.p_G_C[i]).norm());
  }
  return worst / testing::SizeOf(scene.p_G_C);
}

TEST(GlobalSfmTest, ExactTracksGiveTheExactStructureUpToScale) {
  const Scene scene(0.1, 0, 0, 20, 1);
  std::string reason;
  const auto structure = ReconstructStructure(scene.tracks, scene.R_G_C, kOptions, &reason);
  ASSERT_TRUE(structure) << reason;
  EXPECT_LT(RelativeError(*structure, scene), 1e-6);
  EXPECT_EQ(structure->p_G_C[0], Vector3d::Zero());
}

// 13 of 1000 scenes are rejected; the others have errors of 0.026 (median), 0.078 (a hundredth
// exceeds it) and at most 0.135. The median of ten exceeds 0.05 in about one of 1000 cases.
TEST(GlobalSfmTest, NoiseAndOutliersCostLittle) {
  std::vector<double> errors;
  for (uint64_t seed = 1; seed <= 10; ++seed) {
    const Scene scene(0.1, 0.5 / 460, 0.03, 25, seed);
    std::string reason;
    const auto structure = ReconstructStructure(scene.tracks, scene.R_G_C, kOptions, &reason);
    ASSERT_TRUE(structure) << "seed " << seed << ": " << reason;
    errors.push_back(RelativeError(*structure, scene));
    EXPECT_LT(errors.back(), 0.15) << "seed " << seed;
    EXPECT_GT(structure->num_points, 100) << "seed " << seed;
  }
  EXPECT_LT(Median(errors), 0.05);
}

TEST(GlobalSfmTest, RejectsWithoutTranslation) {
  const Scene scene(0, 0.5 / 460, 0, 25, 1);
  std::string reason;
  EXPECT_FALSE(ReconstructStructure(scene.tracks, scene.R_G_C, kOptions, &reason));
  EXPECT_THAT(reason, StartsWith("too little parallax: "));
}

TEST(GlobalSfmTest, RejectsFewPoints) {
  const Scene scene(0.1, 0, 0, 4, 1);
  std::string reason;
  EXPECT_FALSE(ReconstructStructure(scene.tracks, scene.R_G_C, kOptions, &reason));
  EXPECT_THAT(reason, StartsWith("too few common points: "));
}

TEST(GlobalSfmTest, RejectsAFrameWithoutPoints) {
  Scene scene(0.1, 0, 0, 20, 1);
  scene.R_G_C.push_back(Quaterniond::Identity());
  std::string reason;
  EXPECT_FALSE(ReconstructStructure(scene.tracks, scene.R_G_C, kOptions, &reason));
  EXPECT_THAT(reason, HasSubstr("shares too few points"));
}

}  // namespace
}  // namespace plm_vins
