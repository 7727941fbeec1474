// SPDX-License-Identifier: BSD-3-Clause
// A plane of random texture, observed through a known homography: the motion of every pixel is
// known exactly.
#pragma once

#include <Eigen/Geometry>
#include <memory>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "common/camera/camera_model.h"
#include "common/measurements.h"

namespace plm_vins {

constexpr int kWidth = 376;
constexpr int kHeight = 240;
constexpr double kFocal = 230;
constexpr int64_t kFrame_ns = 50'000'000;

// A pinhole camera without distortion.
inline CameraParameters TestCameraParameters() {
  CameraParameters parameters;
  parameters.width = kWidth;
  parameters.height = kHeight;
  parameters.fx = parameters.fy = kFocal;
  parameters.cx = 0.5 * (kWidth - 1);
  parameters.cy = 0.5 * (kHeight - 1);
  return parameters;
}

inline std::shared_ptr<const CameraModel> TestCamera() {
  return CameraModel::Create(TestCameraParameters());
}

inline cv::Matx33d CameraMatrix() {
  const CameraParameters p = TestCameraParameters();
  return {p.fx, 0, p.cx, 0, p.fy, p.cy, 0, 0, 1};
}

// Homography of the pixels under a pure camera rotation.
inline cv::Matx33d RotationHomography(const Eigen::Quaterniond& R_now_then) {
  const Eigen::Matrix3d R = R_now_then.toRotationMatrix();
  const cv::Matx33d R_cv(R(0, 0), R(0, 1), R(0, 2), R(1, 0), R(1, 1), R(1, 2), R(2, 0), R(2, 1),
                         R(2, 2));
  return CameraMatrix() * R_cv * CameraMatrix().inv();
}

inline cv::Matx33d Translation(double x_px, double y_px) {
  return {1, 0, x_px, 0, 1, y_px, 0, 0, 1};
}

inline cv::Point2d Move(const cv::Matx33d& H, const cv::Point2d& p) {
  const cv::Vec3d q = H * cv::Vec3d(p.x, p.y, 1);
  return {q[0] / q[2], q[1] / q[2]};
}

// The texture has a higher resolution than the images, so that linear interpolation is accurate to
// a hundredth of a pixel.
class TexturedScene {
 public:
  explicit TexturedScene(uint64_t seed = 1)
      : texture_(kFineness * (kHeight + 2 * kMargin), kFineness * (kWidth + 2 * kMargin), CV_32F) {
    cv::Mat noise(kHeight + 2 * kMargin, kWidth + 2 * kMargin, CV_32F);
    cv::RNG(seed).fill(noise, cv::RNG::UNIFORM, 0.0, 1.0);
    cv::resize(noise, texture_, texture_.size(), 0, 0, cv::INTER_NEAREST);
    cv::GaussianBlur(texture_, texture_, {}, 2.0 * kFineness);
    cv::normalize(texture_, texture_, 0, 255, cv::NORM_MINMAX);
  }

  // Returns the image in which the pixel p of the reference view is at H p.
  cv::Mat View(const cv::Matx33d& H = cv::Matx33d::eye()) const {
    const cv::Matx33d scale(1.0 / kFineness, 0, 0, 0, 1.0 / kFineness, 0, 0, 0, 1);
    cv::Mat view, gray;
    cv::warpPerspective(texture_, view, H * Translation(-kMargin, -kMargin) * scale,
                        {kWidth, kHeight}, cv::INTER_LINEAR, cv::BORDER_REFLECT);
    view.convertTo(gray, CV_8U);
    return gray;
  }

 private:
  static constexpr int kMargin = 200;  // margin of the texture around the reference view [px]
  static constexpr int kFineness = 4;  // texture elements per pixel
  cv::Mat texture_;
};

}  // namespace plm_vins
