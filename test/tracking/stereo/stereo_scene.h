// SPDX-License-Identifier: BSD-3-Clause
// A textured plane that two cameras with distorted lenses see: every pixel's match is known.
#pragma once

#include <Eigen/Geometry>
#include <cmath>
#include <memory>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "common/camera/camera_model.h"
#include "common/geometry/rigid3.h"
#include "common/geometry/so3.h"
#include "tracking/stereo/camera_pair.h"

namespace plm_vins {

inline CameraParameters StereoCameraParameters(double focal, double k1) {
  CameraParameters parameters;
  parameters.width = 376;
  parameters.height = 240;
  parameters.fx = parameters.fy = focal;
  parameters.cx = 187;
  parameters.cy = 121;
  parameters.distortion = {k1, 0.05, 1e-3, -5e-4};
  return parameters;
}

// The second camera is 0.11 m to the right of the first one, and a little turned.
inline Rigid3d StereoExtrinsics() {
  return {SO3Exp({0.01, -0.015, 0.02}), Eigen::Vector3d(-0.11, 0.002, 0.001)};
}

inline CameraPair StereoCameras(const Rigid3d& T_S_C = StereoExtrinsics()) {
  return {CameraModel::Create(StereoCameraParameters(230, -0.25)),
          CameraModel::Create(StereoCameraParameters(228, -0.22)), T_S_C};
}

class StereoScene {
 public:
  // The plane n . p = 1 of the first camera frame, n = `normal` [1/m].
  explicit StereoScene(const Eigen::Vector3d& normal = {0.05, 0.02, 0.5}, uint64_t seed = 1)
      : normal_(normal), texture_(kSide, kSide, CV_32F) {
    cv::RNG(seed).fill(texture_, cv::RNG::UNIFORM, 0.0, 1.0);
    cv::GaussianBlur(texture_, texture_, {}, 4);
    cv::normalize(texture_, texture_, 0, 255, cv::NORM_MINMAX);
  }

  double InverseDepth(const Eigen::Vector2d& xy) const { return normal_.dot(xy.homogeneous()); }

  // Returns the image of a camera V at T_V_C from the first camera.
  cv::Mat View(const CameraModel& camera, const Rigid3d& T_V_C = {}) const {
    const Rigid3d T_C_V = T_V_C.Inverse();
    cv::Mat map(camera.parameters().height, camera.parameters().width, CV_32FC2);
    for (int row = 0; row < map.rows; ++row) {
      for (int column = 0; column < map.cols; ++column) {
        const auto xy = camera.Unproject(Eigen::Vector2d(column, row));
        map.at<cv::Point2f>(row, column) =
            xy ? TexturePoint(T_C_V.translation, T_C_V.rotation * xy->homogeneous())
               : cv::Point2f(-1, -1);
      }
    }
    cv::Mat view, gray;
    cv::remap(texture_, view, map, cv::noArray(), cv::INTER_LINEAR, cv::BORDER_REFLECT);
    view.convertTo(gray, CV_8U);
    return gray;
  }

 private:
  static constexpr int kSide = 2400;
  static constexpr double kPixelsPerUnit = 900;  // of the plane, seen at unit depth

  cv::Point2f TexturePoint(const Eigen::Vector3d& origin, const Eigen::Vector3d& ray) const {
    const double distance = (1 - normal_.dot(origin)) / normal_.dot(ray);
    const Eigen::Vector2d place =
        (origin + distance * ray).head<2>() * normal_.z() * kPixelsPerUnit +
        Eigen::Vector2d::Constant(0.5 * kSide);
    return {static_cast<float>(place.x()), static_cast<float>(place.y())};
  }

  Eigen::Vector3d normal_;
  cv::Mat texture_;
};

}  // namespace plm_vins
