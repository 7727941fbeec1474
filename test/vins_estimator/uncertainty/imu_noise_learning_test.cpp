// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/uncertainty/imu_noise_learning.h"

#include <gtest/gtest.h>

#include "test/vins_estimator/simulated_problem.h"
#include "vins_estimator/problem/initial_prior.h"

namespace plm_vins {
namespace {

// A window at the true states with more IMU noise than configured.
class ImuNoiseLearningTest : public ::testing::Test {
 protected:
  ImuNoiseLearningTest() : simulated_(testing::SimulateShakenWindow(1)) {
    testing::ScaleAssumedNoise(1e-2, &window());
    configured_ = window().newest().motion_since_previous->noise();
  }

  SlidingWindow& window() { return simulated_.window; }
  const ImuNoise& NoiseOfInterval(size_t i) {
    return window().frames[i + 1].motion_since_previous->noise();
  }

  void Learn(bool is_first, ImuNoiseLearning* learning) {
    const ProblemOptions options = testing::OnePixelOptions();
    const auto prior = InitialPrior(InitialUncertainty(), options, window());
    ProblemBuilder builder(options, &window(), &prior);
    testing::AddAll(&simulated_, &builder);
    NormalEquations equations(builder.problem());
    equations.Linearize();
    learning->Learn(window(), is_first, &equations);
  }

  testing::SimulatedWindow simulated_;
  ImuNoise configured_;
};

TEST_F(ImuNoiseLearningTest, StartsAsConfigured) {
  const ImuNoiseLearning learning(configured_);
  EXPECT_EQ(learning.noise().accel_density, configured_.accel_density);
  EXPECT_FALSE(learning.Reweigh(&window()));
}

TEST_F(ImuNoiseLearningTest, FindsNoiseInTheOlderHalfOfTheWindowOnce) {
  ImuNoiseLearning learning(configured_);
  Learn(/*is_first=*/false, &learning);
  const ImuNoise found = learning.noise();
  EXPECT_GT(found.accel_density, 1.1 * configured_.accel_density);
  EXPECT_GT(found.gyro_density, 1.1 * configured_.gyro_density);
  Learn(/*is_first=*/false, &learning);
  EXPECT_EQ(learning.noise().accel_density, found.accel_density);
  EXPECT_EQ(learning.noise().gyro_density, found.gyro_density);
  Learn(/*is_first=*/true, &learning);  // the other half as well
  EXPECT_NE(learning.noise().accel_density, found.accel_density);
}

TEST_F(ImuNoiseLearningTest, IgnoresStandstillAndBiasSteps) {
  for (WindowFrame& frame : window().frames) frame.stationary = true;
  window().frames[2].stationary = false;
  window().frames[2].motion_since_previous->AllowBiasStep({0.1, 0.1});
  ImuNoiseLearning learning(configured_);
  Learn(/*is_first=*/true, &learning);
  EXPECT_EQ(learning.noise().accel_density, configured_.accel_density);
  EXPECT_EQ(learning.noise().gyro_density, configured_.gyro_density);
}

TEST_F(ImuNoiseLearningTest, IgnoresIntervalsOfAnotherTimeOffset) {
  window().td += 0.003;
  ImuNoiseLearning learning(configured_);
  Learn(/*is_first=*/true, &learning);
  EXPECT_EQ(learning.noise().accel_density, configured_.accel_density);
  EXPECT_EQ(learning.noise().gyro_density, configured_.gyro_density);
}

TEST_F(ImuNoiseLearningTest, IgnoresPartsOfDifferentNoise) {
  const auto learned_from_joined = [this](double variance_scale) {
    Preintegration& motion = *window().newest().motion_since_previous;
    const Preintegration alone = motion;
    const auto& samples = alone.samples();
    const size_t half = samples.size() / 2;
    motion = Preintegration(configured_, alone.linearization_bias());
    for (size_t i = 0; i <= half; ++i) motion.Append(samples[i]);
    Preintegration next(Scaled(configured_, variance_scale), alone.linearization_bias());
    for (size_t i = half; i < samples.size(); ++i) next.Append(samples[i]);
    motion.Join(next);
    for (WindowFrame& frame : window().frames) frame.stationary = true;
    window().newest().stationary = false;
    ImuNoiseLearning learning(configured_);
    Learn(/*is_first=*/true, &learning);
    motion = alone;
    return learning.noise().gyro_density;
  };
  EXPECT_GT(learned_from_joined(1.0), configured_.gyro_density);
  EXPECT_EQ(learned_from_joined(16.0), configured_.gyro_density);
}

TEST_F(ImuNoiseLearningTest, ReweighsOnlyIntervalsThatAreFarLessNoisy) {
  const ImuNoise noisier = Scaled(configured_, 1e4);
  window().frames[3].motion_since_previous->Reweigh(noisier);
  ImuNoiseLearning learning(configured_);
  Learn(/*is_first=*/true, &learning);
  EXPECT_TRUE(learning.Reweigh(&window()));
  EXPECT_EQ(NoiseOfInterval(0).accel_density, learning.noise().accel_density);
  EXPECT_EQ(NoiseOfInterval(2).accel_density, noisier.accel_density);
  EXPECT_EQ(NoiseOfInterval(5).gyro_density, learning.noise().gyro_density);
  EXPECT_EQ(NoiseOfInterval(5).gyro_walk, configured_.gyro_walk);
  EXPECT_FALSE(learning.Reweigh(&window()));
}

TEST_F(ImuNoiseLearningTest, KeepsTheRaisedNoiseOfAJoinedInterval) {
  Preintegration& doubted = *window().frames[3].motion_since_previous;
  doubted.Reweigh(Scaled(configured_, 1e4));
  doubted.AllowBiasStep({0.1, 0.1});
  doubted.Join(*window().frames[4].motion_since_previous);
  const Matrix15d before = doubted.Covariance();
  ImuNoiseLearning learning(configured_);
  Learn(/*is_first=*/true, &learning);
  EXPECT_TRUE(learning.Reweigh(&window()));
  EXPECT_EQ(doubted.Covariance(), before);
}

TEST_F(ImuNoiseLearningTest, ResetForgets) {
  ImuNoiseLearning learning(configured_);
  Learn(/*is_first=*/true, &learning);
  EXPECT_GT(learning.noise().accel_density, configured_.accel_density);
  learning.Reset();
  EXPECT_EQ(learning.noise().accel_density, configured_.accel_density);
}

}  // namespace
}  // namespace plm_vins
