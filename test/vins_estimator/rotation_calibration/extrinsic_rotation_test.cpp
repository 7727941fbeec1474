// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/rotation_calibration/extrinsic_rotation.h"

#include <gtest/gtest.h>

#include "common/geometry/so3.h"
#include "simulator/random.h"

namespace plm_vins {
namespace {

using Eigen::Quaterniond;
using Eigen::Vector3d;
using simulator::Random;

constexpr double kDuration = 0.3;  // [s]
constexpr double kDeviation = 0.004;

Vector3d RandomVector(Random* random) {
  return {random->Normal(), random->Normal(), random->Normal()};
}

Quaterniond RandomRotation(Random* random) {
  return SO3Exp(random->Uniform(0, 3.1) * RandomVector(random).normalized());
}

// Rotations of a few degrees, with components of the rotation vector scaled by `spread` [rad].
struct Turns {
  Quaterniond R_B_C;
  Vector3d spread{0.06, 0.06, 0.06};
  Vector3d gyro_bias = Vector3d::Zero();
  double deviation = kDeviation;
  double outlier_ratio = 0;

  std::vector<RotationPair> Draw(int count, Random* random) const {
    std::vector<RotationPair> pairs;
    for (int i = 0; i < count; ++i) {
      const Vector3d turn = RandomVector(random).cwiseProduct(spread);
      const Vector3d noise = deviation * RandomVector(random);
      const bool outlier = random->Uniform(0, 1) < outlier_ratio;
      const Quaterniond R_then_now = R_B_C.conjugate() * SO3Exp(turn) * R_B_C * SO3Exp(noise);
      pairs.push_back({SO3Exp(turn + gyro_bias * kDuration),
                       outlier ? RandomRotation(random) : R_then_now, kDuration, kDeviation});
    }
    return pairs;
  }
};

TEST(ExtrinsicRotationTest, IsExactWithoutNoise) {
  Random random(1);
  for (int i = 0; i < 20; ++i) {
    Turns turns{RandomRotation(&random)};
    turns.deviation = 0;
    std::string reason;
    const auto R_B_C = CalibrateExtrinsicRotation(turns.Draw(60, &random), {}, &reason);
    ASSERT_TRUE(R_B_C) << reason;
    EXPECT_LT(R_B_C->angularDistance(turns.R_B_C), 1e-6);
  }
}

TEST(ExtrinsicRotationTest, FindsItUnderNoiseBiasAndOutliers) {
  Random random(2);
  for (int i = 0; i < 50; ++i) {
    Turns turns{RandomRotation(&random)};
    turns.gyro_bias = Vector3d(-0.003, 0.021, 0.078);
    turns.outlier_ratio = 0.2;
    std::string reason;
    const auto R_B_C = CalibrateExtrinsicRotation(turns.Draw(100, &random), {}, &reason);
    ASSERT_TRUE(R_B_C) << "draw " << i << ": " << reason;
    EXPECT_LT(R_B_C->angularDistance(turns.R_B_C), 0.03) << "draw " << i;
  }
}

// Any two axes suffice.
TEST(ExtrinsicRotationTest, TurnsAboutTwoAxesSuffice) {
  Random random(3);
  for (const Vector3d& spread : {Vector3d(0.08, 0.08, 0), Vector3d(0, 0.1, 0.07)}) {
    Turns turns{RandomRotation(&random), spread};
    std::string reason;
    const auto R_B_C = CalibrateExtrinsicRotation(turns.Draw(60, &random), {}, &reason);
    ASSERT_TRUE(R_B_C) << reason;
    EXPECT_LT(R_B_C->angularDistance(turns.R_B_C), 0.03);
  }
}

TEST(ExtrinsicRotationTest, RejectsTurnsAboutOneAxis) {
  Random random(4);
  Turns turns{RandomRotation(&random), Vector3d(0, 0, 0.1)};
  turns.gyro_bias = Vector3d(0.03, 0, 0);
  for (const double deviation : {0.0, kDeviation}) {
    turns.deviation = deviation;
    std::string reason;
    EXPECT_FALSE(CalibrateExtrinsicRotation(turns.Draw(150, &random), {}, &reason));
    EXPECT_NE(reason.find("second axis"), std::string::npos) << reason;
  }
}

TEST(ExtrinsicRotationTest, RejectsNoTurnAtAll) {
  Random random(5);
  const Turns turns{RandomRotation(&random), Vector3d::Zero()};
  std::string reason;
  EXPECT_FALSE(CalibrateExtrinsicRotation(turns.Draw(100, &random), {}, &reason));
  EXPECT_FALSE(reason.empty());
}

TEST(ExtrinsicRotationTest, RejectsTooFewPairs) {
  Random random(6);
  const Turns turns{RandomRotation(&random)};
  std::string reason;
  EXPECT_FALSE(CalibrateExtrinsicRotation({}, {}, &reason));
  EXPECT_NE(reason.find("0 of 30"), std::string::npos) << reason;
  EXPECT_FALSE(CalibrateExtrinsicRotation(turns.Draw(29, &random), {}, &reason));
  EXPECT_NE(reason.find("29 of 30"), std::string::npos) << reason;
}

TEST(ExtrinsicRotationTest, RejectsPairsThatContradictEachOther) {
  Random random(7);
  Turns turns{RandomRotation(&random)};
  turns.outlier_ratio = 1;
  std::string reason;
  EXPECT_FALSE(CalibrateExtrinsicRotation(turns.Draw(100, &random), {}, &reason));
  EXPECT_FALSE(reason.empty());
}

}  // namespace
}  // namespace plm_vins
