// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/rotation_calibration/rotation_fit.h"

#include <gtest/gtest.h>

#include "common/geometry/so3.h"
#include "simulator/random.h"

namespace plm_vins {
namespace {

using Cause = RotationFit::Cause;
using Eigen::Vector3d;

const Eigen::Quaterniond kR_B_C = SO3Exp({0.3, -1.2, 0.4});

// Errors of the calibration, of which tests set one.
struct Errors {
  double delay = 0;
  double focal = 0;
  Vector3d extrinsics = Vector3d::Zero();
  Eigen::Matrix3d gyro = Eigen::Matrix3d::Identity();
};

// Random rotations of 0.1 rad in 0.3 s, measured with an error of 0.002 rad per axis; one in twenty
// is an outlier.
RotationFit Explain(const Errors& errors, size_t count = 100, double turn = 0.1) {
  simulator::Random random(3);
  std::vector<RotationPair> pairs(count);
  for (size_t i = 0; i < count; ++i) {
    RotationPair& pair = pairs[i];
    pair.duration = 0.3;
    const Vector3d phi_B = turn * random.NormalVector3();
    pair.rate_change = 3 * turn * random.NormalVector3();
    pair.R_B0_B1 = SO3Exp(errors.gyro * (phi_B - errors.delay * pair.rate_change) +
                          Vector3d(0.003, -0.006, 0.009));
    Vector3d phi_C = kR_B_C.conjugate() * (SO3Exp(errors.extrinsics) * phi_B);
    phi_C.head<2>() /= 1 + errors.focal;
    if (i % 20 == 7) phi_C += Vector3d(0.3, 0, 0.2);
    pair.R_then_now = SO3Exp(phi_C + 0.002 * random.NormalVector3());
  }
  return ExplainRotations(pairs, kR_B_C);
}

TEST(RotationFit, FindsNothingIfAllIsRight) { EXPECT_EQ(Explain({}).cause, Cause::kNone); }

TEST(RotationFit, FindsADelay) {
  Errors errors;
  for (const double delay : {-0.03, 0.02}) {
    errors.delay = delay;
    const RotationFit fit = Explain(errors);
    EXPECT_EQ(fit.cause, Cause::kTimeOffset);
    EXPECT_NEAR(fit.amount, delay, 0.002);
  }
}

TEST(RotationFit, FindsAWrongFocalLength) {
  Errors errors;
  for (const double focal : {-0.1, 0.05}) {
    errors.focal = focal;
    const RotationFit fit = Explain(errors);
    EXPECT_EQ(fit.cause, Cause::kFocalLength);
    EXPECT_NEAR(fit.amount, focal, 0.15 * std::abs(focal));
  }
}

TEST(RotationFit, FindsAWrongMounting) {
  Errors errors;
  errors.extrinsics = {0.03, -0.04, 0};
  const RotationFit fit = Explain(errors);
  EXPECT_EQ(fit.cause, Cause::kExtrinsics);
  EXPECT_NEAR(fit.amount, 0.05, 0.005);
}

TEST(RotationFit, FindsScaleAndAxesOfTheGyro) {
  Errors errors;
  errors.gyro << 1.05, 0, 0, 0.02, 0.97, 0, 0, 0, 1;
  const RotationFit fit = Explain(errors);
  EXPECT_EQ(fit.cause, Cause::kGyro);
  EXPECT_NEAR(fit.amount, 0.055, 0.01);
}

TEST(RotationFit, IsUnknownWithFewOrSmallRotations) {
  EXPECT_EQ(Explain({}, 30).cause, Cause::kUnknown);
  EXPECT_EQ(Explain({}, 100, 0.01).cause, Cause::kUnknown);
}

}  // namespace
}  // namespace plm_vins
