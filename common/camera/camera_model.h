// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace plm_vins {

// The intrinsics that can be refined: fx, fy, cx, cy [px] and the four distortion coefficients.
constexpr int kIntrinsicsSize = 8;
using Intrinsics = Eigen::Matrix<double, kIntrinsicsSize, 1>;
using IntrinsicsJacobian = Eigen::Matrix<double, 2, kIntrinsicsSize>;

// Calibration of one camera, as read from the configuration.
struct CameraParameters {
  enum class Model { kPinholeRadtan, kPinholeEquidistant, kMei };
  Model model = Model::kPinholeRadtan;
  int width = 0;                          // [px]
  int height = 0;                         // [px]
  double fx = 0, fy = 0, cx = 0, cy = 0;  // [px]; for MEI gamma1, gamma2, u0, v0
  // Radtan and MEI: k1, k2, p1, p2. Equidistant (Kannala-Brandt): k1, k2, k3, k4 of theta_d = theta
  // (1 + k1 theta^2 + k2 theta^4 + k3 theta^6 + k4 theta^8).
  Eigen::Vector4d distortion = Eigen::Vector4d::Zero();
  double xi = 0;  // MEI only: distance of the unit sphere's center from the projection center

  Intrinsics intrinsics() const;
  // Returns this camera with other intrinsics.
  CameraParameters With(const Intrinsics& intrinsics) const;
};

// A calibrated camera: projects points of the camera frame C (x right, y down, z forward) to raw
// pixels and unprojects pixels to rays. Immutable after construction; safe to share between
// threads.
class CameraModel {
 public:
  // Throws std::invalid_argument if a parameter is not finite, a focal length is not positive or xi
  // is negative.
  static std::unique_ptr<const CameraModel> Create(const CameraParameters& parameters);

  virtual ~CameraModel() = default;

  // Projects the point p_C [m] to a pixel, inside or outside the image. `d_pixel_d_point` is 2x3.
  // Returns nullopt if this model cannot observe the point: a pinhole sees only points in front of
  // it, and no model sees rays beyond the radius up to which its distortion is invertible.
  virtual std::optional<Eigen::Vector2d> Project(
      const Eigen::Vector3d& p_C, Eigen::Matrix<double, 2, 3>* d_pixel_d_point = nullptr) const = 0;

  // Returns the normalized, undistorted image point (x, y) of the ray (x, y, 1) through the pixel.
  // `d_xy_d_pixel` is 2x2. Returns nullopt if the pixel has no ray in front of the camera. Inverts
  // Project() to machine precision.
  virtual std::optional<Eigen::Vector2d> Unproject(
      const Eigen::Vector2d& pixel, Eigen::Matrix2d* d_xy_d_pixel = nullptr) const = 0;

  // Derivative, at constant pixel, of the normalized image point `xy` by the intrinsics. Returns
  // nullopt if the model does not observe that ray.
  std::optional<IntrinsicsJacobian> RayByIntrinsics(const Eigen::Vector2d& xy) const;

  const CameraParameters& parameters() const { return parameters_; }

  // Pixels per radian at the image center (mean of both axes); converts normalized errors to
  // pixels.
  virtual double FocalLength() const = 0;

  bool IsInImage(const Eigen::Vector2d& pixel, double border_px = 0) const {
    return pixel.x() >= border_px && pixel.y() >= border_px &&
           pixel.x() <= parameters_.width - 1 - border_px &&
           pixel.y() <= parameters_.height - 1 - border_px;
  }

 protected:
  explicit CameraModel(const CameraParameters& parameters) : parameters_(parameters) {}

  // Derivative of the distorted image-plane point by the distortion coefficients, for a ray (x, y,
  // 1) that Project() accepts.
  virtual Eigen::Matrix<double, 2, 4> PlaneByDistortion(const Eigen::Vector2d& xy) const = 0;

  // The last step of every model: from the distorted image-plane point to pixels, and back.
  Eigen::Vector2d PlaneToPixel(const Eigen::Vector2d& point) const {
    return focal().cwiseProduct(point) + center();
  }
  Eigen::Vector2d PixelToPlane(const Eigen::Vector2d& pixel) const {
    return (pixel - center()).cwiseQuotient(focal());
  }
  Eigen::Vector2d focal() const { return {parameters_.fx, parameters_.fy}; }   // [px]
  Eigen::Vector2d center() const { return {parameters_.cx, parameters_.cy}; }  // [px]

 private:
  CameraParameters parameters_;
};

// The cameras of a rig, by number.
using CameraModels = std::vector<std::shared_ptr<const CameraModel>>;

// `Cameras` are elements with CameraParameters `parameters`, such as those of SensorConfig.
template <typename Cameras>
CameraModels CreateAll(const Cameras& cameras) {
  CameraModels models;
  for (const auto& camera : cameras) models.push_back(CameraModel::Create(camera.parameters));
  return models;
}

// Time at which a rolling shutter reads a row, relative to the readout time of the whole image:
// -0.5 at the top, 0 in the middle, to which the image timestamp refers (as in VINS-Mono), and 0.5
// at the bottom. `height` is that of the image [px].
inline double ReadoutShare(double row_px, int height) { return row_px / height - 0.5; }

}  // namespace plm_vins
