// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/initialization/visual_inertial_alignment.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "common/geometry/so3.h"
#include "test/vins_estimator/initialization/simulated_frames.h"

namespace plm_vins {
namespace {

using Eigen::Quaterniond;
using Eigen::Vector3d;

// Exact states every quarter of a second with the IMU samples in between.
class AlignmentTest : public ::testing::Test {
 protected:
  void Simulate(simulator::Motion motion, uint64_t seed, bool noise) {
    auto options = testing::FlightOptions(motion, seed);
    options.add_imu_noise = noise;
    if (!noise) options.initial_bias.accel.setZero();
    const auto flight = testing::SimulateFlight(options, /*skip=*/4);
    sensor_ = flight.sensor;
    gyro_bias_ = options.initial_bias.gyro;
    truth_.clear();
    preintegrations_.clear();
    for (size_t i = 0; i < kCount; ++i) truth_.push_back(flight.truth[kStep * i]);
    for (size_t i = 0; i + 1 < kCount; ++i) {
      std::vector<ImuSample> samples;
      for (size_t k = kStep * i + 1; k <= kStep * (i + 1); ++k) {
        JoinImu(flight.frames[k].imu, &samples);
      }
      Preintegration imu(sensor_.imu_noise, {});
      for (const ImuSample& sample : samples) imu.Append(sample);
      preintegrations_.push_back(imu);
    }
  }

  std::vector<RotationMeasurement> Rotations(double information) const {
    std::vector<RotationMeasurement> rotations;
    for (size_t i = 0; i + 1 < kCount; ++i) {
      rotations.push_back({&preintegrations_[i],
                           truth_[i].rotation().conjugate() * truth_[i + 1].rotation(),
                           information * Eigen::Matrix3d::Identity()});
    }
    return rotations;
  }

  // Camera centers in units of `scale` [m], in a frame G that is rotated against W.
  std::optional<Alignment> Align(double scale, double gravity_norm = 9.81) {
    std::vector<AlignmentView> views;
    std::vector<const Preintegration*> preintegrations;
    for (const FrameState& state : truth_) {
      const Vector3d p_W_C = state.T_W_B() * sensor_.cameras[0].T_B_C.translation;
      views.push_back({kR_G_W * state.rotation(), kR_G_W * p_W_C / scale});
    }
    for (Preintegration& imu : preintegrations_) {
      imu.Repropagate({Vector3d::Zero(), gyro_bias_});
      preintegrations.push_back(&imu);
    }
    return AlignVisualInertial(
        views, preintegrations,
        {sensor_.cameras[0].T_B_C, gravity_norm, sensor_.accel_bias_deviation}, &reason_);
  }

  static constexpr size_t kCount = 10, kStep = 5;
  const Quaterniond kR_G_W = SO3Exp({0.5, -1.0, 2.0});
  SensorConfig sensor_;
  Vector3d gyro_bias_;
  std::vector<FrameState> truth_;
  std::vector<Preintegration> preintegrations_;
  std::string reason_;
};

TEST_F(AlignmentTest, ExactDataGiveScaleGravityAndVelocities) {
  Simulate(simulator::Motion::kGentle, 1, /*noise=*/false);
  const auto alignment = Align(2.5);
  ASSERT_TRUE(alignment) << reason_;
  EXPECT_NEAR(alignment->scale, 2.5, 0.005);
  EXPECT_LT(testing::AngleBetween(alignment->gravity_G, kR_G_W * Vector3d(0, 0, -1)), 1e-3);
  EXPECT_NEAR(alignment->gravity_G.norm(), 9.81, 1e-12);
  EXPECT_LT(alignment->accel_bias.norm(), 0.01);
  for (size_t i = 0; i < kCount; ++i) {
    EXPECT_LT((alignment->velocity_G[i] - kR_G_W * truth_[i].velocity()).norm(), 0.005);
  }
}

TEST_F(AlignmentTest, NoiseAndAccelBiasCostLittle) {
  for (uint64_t seed = 1; seed <= 10; ++seed) {
    Simulate(simulator::Motion::kFast, seed, /*noise=*/true);
    const auto alignment = Align(0.4);
    ASSERT_TRUE(alignment) << "seed " << seed << ": " << reason_;
    EXPECT_NEAR(alignment->scale, 0.4, 0.02) << "seed " << seed;
    // If unobservable, the accelerometer bias of 0.09 m/s^2 tilts gravity by half a degree.
    EXPECT_LT(testing::AngleBetween(alignment->gravity_G, kR_G_W * Vector3d(0, 0, -1)), 0.02);
    EXPECT_LT((alignment->velocity_G.back() - kR_G_W * truth_.back().velocity()).norm(), 0.06);
  }
}

TEST_F(AlignmentTest, RejectsWrongGravity) {
  Simulate(simulator::Motion::kGentle, 1, /*noise=*/false);
  EXPECT_FALSE(Align(1.0, /*gravity_norm=*/3.71));
  EXPECT_EQ(reason_, "estimated gravity is 9.81 m/s^2 instead of 3.71");
}

// At a constant velocity any scale fits, and noise decides on its sign.
TEST_F(AlignmentTest, ScaleIsUnobservableAtConstantVelocity) {
  std::mt19937 random(1);
  std::normal_distribution<double> noise(0, 1);
  const auto vector = [&](double deviation) {
    return Vector3d(deviation * noise(random), deviation * noise(random),
                    deviation * noise(random));
  };
  int negative = 0;
  for (int run = 0; run < 20; ++run) {
    truth_.clear();
    preintegrations_.clear();
    for (int64_t i = 0; i < static_cast<int64_t>(kCount); ++i) {
      FrameState state;
      state.SetPose({Quaterniond::Identity(), Vector3d(0.25 * i, 0, 0) + vector(0.003)});
      truth_.push_back(state);
      if (i == 0) continue;
      preintegrations_.emplace_back(sensor_.imu_noise, ImuBias());
      for (int64_t k = 0; k <= 50; ++k) {
        preintegrations_.back().Append({250'000'000 * (i - 1) + 5'000'000 * k, vector(0.001),
                                        Vector3d(0, 0, 9.81) + vector(0.03)});
      }
    }
    const auto alignment = Align(1);
    if (alignment) {
      EXPECT_LT(std::abs(alignment->scale - 1), 5 * alignment->scale_deviation);
      EXPECT_GT(alignment->scale_deviation, 0.1);
    } else {
      EXPECT_EQ(reason_, "scale not observable yet: the velocity changes too little");
      ++negative;
    }
  }
  EXPECT_GT(negative, 0);
}

TEST_F(AlignmentTest, MirroredMotionHasANegativeScale) {
  Simulate(simulator::Motion::kGentle, 1, /*noise=*/false);
  EXPECT_FALSE(Align(-2.5));
  EXPECT_EQ(reason_.find("the estimated scale is negative: check the signs of the accel"), 0u);
}

TEST_F(AlignmentTest, FindsTheGyroBias) {
  Simulate(simulator::Motion::kFast, 2, /*noise=*/true);
  const auto gyro_bias = EstimateGyroBias(Rotations(1e6), &reason_);
  ASSERT_TRUE(gyro_bias) << reason_;
  EXPECT_LT((*gyro_bias - gyro_bias_).norm(), 5e-4);
}

TEST_F(AlignmentTest, GyroBiasIsRobustAgainstOneWrongRotation) {
  Simulate(simulator::Motion::kFast, 2, /*noise=*/true);
  auto rotations = Rotations(1e6);
  rotations[3].R_B0_B1 = rotations[3].R_B0_B1 * SO3Exp({0.1, 0, 0});
  const auto gyro_bias = EstimateGyroBias(rotations, &reason_);
  ASSERT_TRUE(gyro_bias) << reason_;
  EXPECT_LT((*gyro_bias - gyro_bias_).norm(), 2e-3);
}

TEST_F(AlignmentTest, GyroBiasWithoutRotationsIsRejected) {
  EXPECT_FALSE(EstimateGyroBias({}, &reason_));
  EXPECT_EQ(reason_, "the gyro bias is unobservable in these images");
}

}  // namespace
}  // namespace plm_vins
