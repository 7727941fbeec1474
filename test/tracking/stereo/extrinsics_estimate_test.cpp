// SPDX-License-Identifier: BSD-3-Clause
#include "tracking/stereo/extrinsics_estimate.h"

#include <gtest/gtest.h>

#include <random>

#include "test/tracking/stereo/stereo_scene.h"

namespace plm_vins {
namespace {

constexpr double kFocal = 460;  // [px]
constexpr double kDegree = M_PI / 180;

// Points at 1 to 10 m as cameras mounted by `truth` see them, the second one `delay` [s] late.
std::vector<StereoMatch> Matches(const Rigid3d& truth, double delay, int count = 100,
                                 double noise_px = 0.2) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> place(-0.6, 0.6), inverse_depth(0.1, 1.0);
  std::normal_distribution<double> noise(0, noise_px / kFocal), speed(0.5, 0.5);
  std::vector<StereoMatch> matches;
  for (int i = 0; i < count; ++i) {
    StereoMatch match;
    match.xy = {place(random), place(random)};
    match.velocity = {speed(random), speed(random)};
    const Eigen::Vector2d later = match.xy + delay * match.velocity;
    const Eigen::Vector3d p_S =
        truth.rotation * later.homogeneous() + inverse_depth(random) * truth.translation;
    match.xy_S = p_S.hnormalized() + Eigen::Vector2d(noise(random), noise(random));
    matches.push_back(match);
  }
  return matches;
}

Rigid3d Turned(const Eigen::Vector3d& angles) {
  return {SO3Exp(angles) * StereoExtrinsics().rotation, StereoExtrinsics().translation};
}

void Feed(const std::vector<StereoMatch>& matches, ExtrinsicsEstimate* estimate) {
  for (int i = 0; i < 10; ++i) estimate->Update(matches);
}

TEST(ExtrinsicsEstimateTest, LearnsTheRotationOfTheCamera) {
  const Eigen::Vector3d angles = Eigen::Vector3d(0.3, -0.2, 0.3) * kDegree;
  ExtrinsicsEstimate estimate(StereoExtrinsics(), kFocal);
  Feed(Matches(Turned(angles), 0), &estimate);
  // About the baseline's own direction and about the axis; about the other one, only the shape of
  // the epipolar curves tells.
  EXPECT_NEAR(estimate.rotation().x(), angles.x(), 0.02 * kDegree);
  EXPECT_NEAR(estimate.rotation().y(), angles.y(), 0.1 * kDegree);
  EXPECT_NEAR(estimate.rotation().z(), angles.z(), 0.1 * kDegree);
  for (const StereoMatch& match : Matches(Turned(angles), 0, 20)) {
    EXPECT_LT(std::abs(estimate.Error(match)), 1);
    EXPECT_TRUE(estimate.Accepts(match));
  }
  EXPECT_NEAR(estimate.T_S_C().translation.norm(), StereoExtrinsics().translation.norm(), 1e-12);
}

TEST(ExtrinsicsEstimateTest, LearnsTheDelayOfTheSecondCamera) {
  for (const double delay : {0.005, -0.01}) {
    ExtrinsicsEstimate estimate(StereoExtrinsics(), kFocal);
    const std::vector<StereoMatch> matches = Matches(StereoExtrinsics(), delay);
    Feed(matches, &estimate);
    EXPECT_NEAR(estimate.delay(), delay, 1e-3);
    const std::vector<StereoMatch> in_time = Matches(StereoExtrinsics(), 0);
    for (size_t i = 0; i < matches.size(); ++i) {
      EXPECT_LT((estimate.WithoutDelay(matches[i]) - in_time[i].xy_S).norm() * kFocal, 1);
    }
  }
}

TEST(ExtrinsicsEstimateTest, LearnsTheErrorOfTheFocalLength) {
  for (const double zoom : {0.05, -0.02, 0.005}) {
    ExtrinsicsEstimate estimate(StereoExtrinsics(), kFocal);
    std::vector<StereoMatch> matches = Matches(StereoExtrinsics(), 0);
    for (StereoMatch& match : matches) match.xy_S /= 1 + zoom;
    Feed(matches, &estimate);
    EXPECT_NEAR(estimate.zoom(), zoom == 0.005 ? 0 : zoom, 0.003) << zoom;
    EXPECT_NEAR(estimate.delay(), 0, 5e-4) << zoom;
  }
}

TEST(ExtrinsicsEstimateTest, IsRobustAgainstWrongMatches) {
  std::vector<StereoMatch> matches = Matches(StereoExtrinsics(), 0);
  for (size_t i = 0; i < matches.size(); i += 3) matches[i].xy_S.y() += 0.004 * (1.0 + i % 7);
  ExtrinsicsEstimate estimate(StereoExtrinsics(), kFocal);
  Feed(matches, &estimate);
  EXPECT_LT(estimate.rotation().norm(), 0.1 * kDegree);
  int accepted = 0;
  for (size_t i = 0; i < matches.size(); i += 3) accepted += estimate.Accepts(matches[i]);
  EXPECT_LE(accepted, 6);  // of 34; some are wrong by less than two pixels
}

TEST(ExtrinsicsEstimateTest, AcceptsThePriorUncertaintyAtFirst) {
  const ExtrinsicsEstimate estimate(StereoExtrinsics(), kFocal);
  EXPECT_TRUE(estimate.Accepts(Matches(Turned({0.4 * kDegree, 0, 0}), 0, 1).front()));
  EXPECT_FALSE(estimate.Accepts(Matches(Turned({3 * kDegree, 0, 0}), 0, 1).front()));
}

// Rotation about the baseline moves epipolar curves by the full angle; that about the vertical,
// which takes long to be known, moves points along them.
TEST(ExtrinsicsEstimateTest, DeviationIsAcrossTheEpipolarCurve) {
  const Rigid3d sideways(Eigen::Quaterniond::Identity(), Eigen::Vector3d(-0.1, 0, 0));
  ExtrinsicsEstimate estimate(sideways, kFocal);
  const StereoMatch far{{0, 0}, {0, 0}, {0, 0}};
  EXPECT_NEAR(estimate.Deviation(far), kFocal * 0.4 * kDegree, 1e-6);
  Feed(Matches(sideways, 0), &estimate);
  for (const StereoMatch& match : Matches(sideways, 0, 20)) {
    EXPECT_LT(estimate.Deviation(match), 0.1);
  }
}

TEST(ExtrinsicsEstimateTest, ErrorIsTheDistanceFromTheEpipolarLine) {
  const ExtrinsicsEstimate estimate(StereoExtrinsics(), kFocal);
  StereoMatch match = Matches(StereoExtrinsics(), 0, 1, 0).front();
  EXPECT_NEAR(estimate.StatedError(match), 0, 1e-9);
  const Eigen::Vector2d along =
      (StereoExtrinsics().translation.head<2>() - match.xy_S * StereoExtrinsics().translation.z())
          .normalized();
  match.xy_S += 2 / kFocal * Eigen::Vector2d(-along.y(), along.x());
  EXPECT_NEAR(std::abs(estimate.StatedError(match)), 2, 1e-6);
}

}  // namespace
}  // namespace plm_vins
