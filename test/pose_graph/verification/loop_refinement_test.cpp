// SPDX-License-Identifier: BSD-3-Clause
#include "pose_graph/verification/loop_refinement.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "common/geometry/so3.h"
#include "simulator/random.h"
#include "test/pose_graph/two_visits.h"

namespace plm_vins {
namespace {

using testing::kFocalLength;

const LevelTransform kTruth = {0.4, {5, -3, 0.5}};  // T_O1_O2

// Standard deviations of errors of the observations.
struct Noise {
  double image = 0;  // normalized
  double depth = 0;  // of a landmark along its ray, relative to its distance
  double tilt = 0;   // of O2 about its level axes [rad]
};

// Two cameras that observe the same points and lines, whose positions are known in both worlds.
LoopObservations See(int points, bool lines, const Noise& noise, simulator::Random* random) {
  LoopObservations all;
  const Rigid3d T_O1_earlier({Eigen::Quaterniond(Eigen::AngleAxisd(0.1, Eigen::Vector3d::UnitX()))},
                             {0, 0, 1});
  const Rigid3d T_O1_later({Eigen::Quaterniond(Eigen::AngleAxisd(0.2, Eigen::Vector3d::UnitY()))},
                           {0.4, 0.3, 1.1});
  all.T_O1_C = T_O1_earlier * testing::LookingAhead();
  all.T_O2_C = kTruth.Inverse().ToRigid() * T_O1_later * testing::LookingAhead();
  const Rigid3d T_C_O1_later = (kTruth.ToRigid() * all.T_O2_C).Inverse();
  const Eigen::Vector3d tilt(noise.tilt * random->Normal(), noise.tilt * random->Normal(), 0);
  const Eigen::Quaterniond R_tilted_O2 = SO3Exp(tilt);
  all.T_O2_C.rotation = R_tilted_O2 * all.T_O2_C.rotation;  // all of O2 is rotated about the camera
  const auto place = [&](const Rigid3d& T_W_C, const Eigen::Vector3d& p_C) {
    return Eigen::Vector3d(T_W_C * Eigen::Vector3d((1 + noise.depth * random->Normal()) * p_C));
  };
  const auto noisy = [&](const Eigen::Vector3d& p_C) {
    return Eigen::Vector2d(p_C.hnormalized() +
                           noise.image * Eigen::Vector2d(random->Normal(), random->Normal()));
  };
  for (int i = 0; i < points; ++i) {
    const Eigen::Vector3d p_O1(random->Uniform(3, 8), random->Uniform(-2, 2),
                               random->Uniform(0, 2));
    const Eigen::Vector3d p_C_earlier = all.T_O1_C.Inverse() * p_O1;
    const Eigen::Vector3d p_C_later = T_C_O1_later * p_O1;
    all.of_earlier.push_back({place(all.T_O1_C, p_C_earlier), noisy(p_C_later)});
    all.of_later.push_back({place(all.T_O2_C, p_C_later), noisy(p_C_earlier)});
  }
  for (int i = 0; lines && i < 8; ++i) {
    const SpaceSegment line = {{4.0 + i % 3, -1 + 0.3 * i, 0.5}, {5, -1 + 0.2 * i, 1.5}};
    LineObservation segment;
    segment.start = noisy(T_C_O1_later * line.start_O);
    segment.end = noisy(T_C_O1_later * (0.5 * (line.start_O + line.end_O)));  // a part of it
    all.lines.push_back({line, segment});
  }
  return all;
}

LevelTransform Disturbed() { return kTruth * LevelTransform{0.05, {0.1, -0.1, 0.05}}; }

// Error of the later camera's position and of the yaw.
Vector4d ErrorOf(const LevelTransform& T_O1_O2, const LoopObservations& observations) {
  Vector4d error;
  error << T_O1_O2 * observations.T_O2_C.translation - kTruth * observations.T_O2_C.translation,
      WrapAngle(T_O1_O2.yaw - kTruth.yaw);
  return error;
}

TEST(RefineLoop, FindsTheTruthWithoutNoise) {
  simulator::Random random(1);
  const LoopObservations observations = See(20, true, Noise(), &random);
  const auto loop = RefineLoop(LoopRefinementOptions(kFocalLength), observations, Disturbed());
  ASSERT_TRUE(loop);
  EXPECT_LT(ErrorOf(loop->T_O1_O2, observations).norm(), 1e-6);
}

TEST(RefineLoop, FindsTheTruthFromLinesOnly) {
  simulator::Random random(2);
  const LoopObservations observations = See(0, true, Noise(), &random);
  const auto loop = RefineLoop(LoopRefinementOptions(kFocalLength), observations, Disturbed());
  ASSERT_TRUE(loop);
  EXPECT_LT(ErrorOf(loop->T_O1_O2, observations).norm(), 1e-5);
}

TEST(RefineLoop, ToleratesOutliers) {
  simulator::Random random(3);
  LoopObservations observations = See(40, false, {0.2 / kFocalLength}, &random);
  for (int i = 0; i < 6; ++i) observations.of_earlier[i].xy += Eigen::Vector2d(0.05, -0.03);
  const auto loop = RefineLoop(LoopRefinementOptions(kFocalLength), observations, Disturbed());
  ASSERT_TRUE(loop);
  EXPECT_LT(ErrorOf(loop->T_O1_O2, observations).norm(), 0.03);
}

// Mean NEES for four degrees of freedom, with the noise that the options assume.
double MeanNees(const Noise& noise, uint64_t seed) {
  LoopRefinementOptions options(kFocalLength);
  options.point_noise = options.line_noise = noise.image;
  options.depth_noise = noise.depth;
  options.tilt = noise.tilt;
  options.floor_position = options.floor_yaw = 0;
  simulator::Random random(seed);
  constexpr int kRuns = 100;
  double nees = 0;
  for (int i = 0; i < kRuns; ++i) {
    const LoopObservations observations = See(15, true, noise, &random);
    const auto loop = RefineLoop(options, observations, kTruth);
    if (!loop) return std::numeric_limits<double>::infinity();
    const Vector4d error = ErrorOf(loop->T_O1_O2, observations);
    nees += error.dot(loop->covariance.inverse() * error) / kRuns;
  }
  return nees;
}

TEST(RefineLoop, CovarianceMatchesTheErrors) {
  // With image noise only, then with uncertain depths, then with errors of roll and pitch as well.
  for (const Noise& noise :
       {Noise{1.0 / kFocalLength, 1e-6, 1e-6}, Noise{1.0 / kFocalLength, 0.1, 1e-6},
        Noise{1.0 / kFocalLength, 0.1, 0.01}}) {
    const double nees = MeanNees(noise, 4);
    EXPECT_GT(nees, 3.0) << noise.depth << " " << noise.tilt;  // 4 +- 0.28, and a robust loss
    EXPECT_LT(nees, 5.5) << noise.depth << " " << noise.tilt;
  }
}

// An attitude error between the visits must not be confused with a translation.
TEST(RefineLoop, DistinguishesTiltFromTranslation) {
  const Noise noise = {0, 0, 0.5 * M_PI / 180};
  LoopRefinementOptions without(kFocalLength);
  without.tilt = 1e-6;
  double error = 0, error_without = 0;
  for (uint64_t seed = 1; seed <= 20; ++seed) {
    simulator::Random random(seed);
    const LoopObservations observations = See(30, false, noise, &random);
    const auto loop = RefineLoop(LoopRefinementOptions(kFocalLength), observations, kTruth);
    const auto level = RefineLoop(without, observations, kTruth);
    ASSERT_TRUE(loop && level);
    error += ErrorOf(loop->T_O1_O2, observations).head<3>().norm();
    error_without += ErrorOf(level->T_O1_O2, observations).head<3>().norm();
  }
  EXPECT_LT(error, 0.5 * error_without);
}

TEST(RefineLoop, AddsTheCommonErrorOfObservations) {
  simulator::Random random(5);
  const LoopObservations observations = See(30, false, Noise(), &random);
  LoopRefinementOptions options(kFocalLength);
  const auto with = RefineLoop(options, observations, kTruth);
  const double variance = options.floor_position * options.floor_position;
  options.floor_position = options.floor_yaw = 0;
  const auto without = RefineLoop(options, observations, kTruth);
  ASSERT_TRUE(with && without);
  EXPECT_NEAR(with->covariance(0, 0) - without->covariance(0, 0), variance, 1e-9);
}

TEST(RefineLoop, RejectsWithoutObservations) {
  EXPECT_FALSE(RefineLoop(LoopRefinementOptions(kFocalLength), LoopObservations(), kTruth));
}

}  // namespace
}  // namespace plm_vins
