// SPDX-License-Identifier: BSD-3-Clause
#include "common/camera/ray_transfer.h"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <optional>

namespace plm_vins {
namespace {

constexpr int kMaxSteps = 4;
constexpr double kMaxError = 1e-9;  // normalized

struct UnprojectedPixel {
  Eigen::Vector2d xy;
  Eigen::Matrix2d d_xy_d_pixel;
};

// Newton's method from the previous ray: similar calibrations need one or two steps, while
// unprojection from scratch needs five. Convergence is quadratic.
std::optional<UnprojectedPixel> UnprojectNear(const CameraModel& camera,
                                              const Eigen::Vector2d& pixel,
                                              const Eigen::Vector2d& guess) {
  UnprojectedPixel result;
  result.xy = guess;
  for (int i = 0; i < kMaxSteps; ++i) {
    Eigen::Matrix<double, 2, 3> d_pixel_d_ray;
    const auto seen = camera.Project(result.xy.homogeneous(), &d_pixel_d_ray);
    if (!seen) break;
    result.d_xy_d_pixel = d_pixel_d_ray.leftCols<2>().inverse();
    const Eigen::Vector2d step = result.d_xy_d_pixel * (pixel - *seen);
    result.xy += step;
    if (step.squaredNorm() < kMaxError) return result;
  }
  const auto xy = camera.Unproject(pixel, &result.d_xy_d_pixel);
  if (!xy) return std::nullopt;
  result.xy = *xy;
  return result;
}

}  // namespace

void TransferRay(const CameraModel& from, const CameraModel& to, Eigen::Vector2d* xy,
                 Eigen::Vector2d* velocity) {
  Eigen::Matrix<double, 2, 3> d_pixel_d_ray;
  const auto pixel = from.Project(xy->homogeneous(), &d_pixel_d_ray);
  if (!pixel) return;
  const auto moved = UnprojectNear(to, *pixel, *xy);
  if (!moved) return;
  *xy = moved->xy;
  *velocity = moved->d_xy_d_pixel * (d_pixel_d_ray.leftCols<2>() * *velocity);
}

void TransferRay(const CameraModel& from, const CameraModel& to, Eigen::Vector2d* xy) {
  Eigen::Vector2d velocity = Eigen::Vector2d::Zero();
  TransferRay(from, to, xy, &velocity);
}

}  // namespace plm_vins
