// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/initialization/static_initializer.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/geometry/so3.h"

namespace plm_vins {
namespace {

using ::testing::HasSubstr;

using Eigen::Vector3d;

constexpr double kGravity = 9.81;

std::vector<ImuSample> Repeat(const Vector3d& gyro, const Vector3d& accel) {
  return std::vector<ImuSample>(100, ImuSample{0, gyro, accel});
}

TEST(StaticInitializerTest, FindsTiltAndGyroBias) {
  const Eigen::Quaterniond R_W_B = SO3Exp({0, 0, -0.7}) * SO3Exp({0.4, 1.2, 0});
  const Vector3d bias(0.01, -0.02, 0.08);
  std::string reason;
  const auto state = InitializeFromStandstill(
      Repeat(bias, R_W_B.conjugate() * Vector3d(0, 0, kGravity)), kGravity, &reason);
  ASSERT_TRUE(state) << reason;
  const Vector3d up_B = R_W_B.conjugate() * Vector3d::UnitZ();
  EXPECT_LT((state->rotation().conjugate() * Vector3d::UnitZ() - up_B).norm(), 1e-12);
  EXPECT_NEAR(Yaw(Eigen::Quaterniond(state->rotation())), 0, 1e-12);
  EXPECT_LT((state->gyro_bias() - bias).norm(), 1e-12);
  EXPECT_EQ(state->accel_bias(), Vector3d::Zero());
  EXPECT_EQ(state->velocity(), Vector3d::Zero());
  EXPECT_EQ(state->position(), Vector3d::Zero());
}

TEST(StaticInitializerTest, WorksUpsideDown) {
  std::string reason;
  const auto state = InitializeFromStandstill(Repeat(Vector3d::Zero(), Vector3d(0, 0, -kGravity)),
                                              kGravity, &reason);
  ASSERT_TRUE(state) << reason;
  EXPECT_NEAR((state->rotation() * Vector3d::UnitZ()).z(), -1, 1e-12);
}

TEST(StaticInitializerTest, RejectsImpossibleMeansWithReason) {
  std::string reason;
  EXPECT_FALSE(
      InitializeFromStandstill(Repeat(Vector3d::Zero(), Vector3d(0, 0, 1)), kGravity, &reason));
  EXPECT_THAT(reason, HasSubstr("1.00 m/s^2"));
  EXPECT_FALSE(InitializeFromStandstill(Repeat(Vector3d(0, 0, 1), Vector3d(0, 0, kGravity)),
                                        kGravity, &reason));
  EXPECT_THAT(reason, HasSubstr("1.00 rad/s"));
  EXPECT_FALSE(InitializeFromStandstill({}, kGravity, &reason));
}

}  // namespace
}  // namespace plm_vins
