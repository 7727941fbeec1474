// SPDX-License-Identifier: BSD-3-Clause
#include "common/camera/ray_transfer.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <memory>
#include <utility>

#include "simulator/default_sensors.h"
#include "test/testing/numeric_jacobian.h"

namespace plm_vins {
namespace {

using Eigen::Vector2d;

constexpr double kMillionthOfAPixel = 1e-6 / 460;  // normalized

CameraParameters Camera() { return simulator::DefaultSensors().cameras[0].parameters; }

// Transfers rays to a camera whose intrinsics all differ by `share` of 10 %.
class RayTransfer : public ::testing::TestWithParam<double> {
 protected:
  static CameraParameters Other(double share) {
    CameraParameters camera = Camera();
    camera.fx *= 1 + 0.1 * share;
    camera.fy *= 1 - 0.1 * share;
    camera.cx += 40 * share;
    camera.cy -= 40 * share;
    camera.distortion *= 1 + 0.1 * share;
    return camera;
  }

  Vector2d Expected(const Vector2d& xy) const {
    return *to_->Unproject(*from_->Project(xy.homogeneous()));
  }

  const std::unique_ptr<const CameraModel> from_ = CameraModel::Create(Camera());
  const std::unique_ptr<const CameraModel> to_ = CameraModel::Create(Other(GetParam()));
};

TEST_P(RayTransfer, KeepsPixelsAllOverTheImage) {
  const CameraParameters& camera = from_->parameters();
  for (int x = 0; x < camera.width; x += 50) {
    for (int y = 0; y < camera.height; y += 50) {
      const Vector2d before = *from_->Unproject(Vector2d(x, y));
      Vector2d xy = before;
      TransferRay(*from_, *to_, &xy);
      EXPECT_MATRIX_NEAR(xy, Expected(before), kMillionthOfAPixel);
    }
  }
}

TEST_P(RayTransfer, MovesVelocitiesAlong) {
  const Vector2d before(0.4, -0.3), velocity_before(1, -2);
  Vector2d xy = before, velocity = velocity_before;
  TransferRay(*from_, *to_, &xy, &velocity);
  constexpr double kTime = 1e-5;
  const Vector2d numeric =
      (Expected(before + kTime * velocity_before) - Expected(before - kTime * velocity_before)) /
      (2 * kTime);
  EXPECT_MATRIX_NEAR(velocity, numeric, 1e-4);
}

INSTANTIATE_TEST_SUITE_P(Shares, RayTransfer, ::testing::Values(0, 1e-4, 0.01, 0.3, 1));

TEST(RayTransferAtTheRim, KeepsRaysOutsideTheFieldOfView) {
  CameraParameters narrow = Camera();
  narrow.distortion << -0.28, 0, 0, 0;  // observes nothing beyond a radius of 1.09
  CameraParameters wide = narrow;
  wide.distortion.setZero();
  const auto narrow_camera = CameraModel::Create(narrow), wide_camera = CameraModel::Create(wide);
  for (const auto& [from, to] : {std::pair(narrow_camera.get(), wide_camera.get()),
                                 std::pair(wide_camera.get(), narrow_camera.get())}) {
    Vector2d xy(1.2, 0), velocity(1, 1);
    TransferRay(*from, *to, &xy, &velocity);
    EXPECT_EQ(xy, Vector2d(1.2, 0));
    EXPECT_EQ(velocity, Vector2d(1, 1));
  }
}

}  // namespace
}  // namespace plm_vins
