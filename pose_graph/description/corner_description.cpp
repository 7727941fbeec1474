// SPDX-License-Identifier: BSD-3-Clause
#include "pose_graph/description/corner_description.h"

#include <cmath>
#include <cstring>
#include <opencv2/features2d.hpp>

namespace plm_vins {
namespace {

constexpr float kPatchSize_px = 31;  // patch size that the ORB pattern was trained on
constexpr double kSmallStep = 1e-3;  // step along gravity to compute its image direction [rad]
constexpr double kDegreesPerRadian = 180 / M_PI;

}  // namespace

float GravityAngle(const CameraModel& camera, const Eigen::Quaterniond& R_O_C,
                   const Eigen::Vector2d& xy) {
  const Eigen::Vector3d down_C = R_O_C.conjugate() * -Eigen::Vector3d::UnitZ();
  const Eigen::Vector3d ray = xy.homogeneous().normalized();
  const auto here = camera.Project(ray);
  const auto below = camera.Project(ray + kSmallStep * down_C);
  if (!here || !below) return 0;
  const Eigen::Vector2d direction = *below - *here;
  const double degrees = std::atan2(direction.y(), direction.x()) * kDegreesPerRadian;
  return static_cast<float>(degrees < 0 ? degrees + 360 : degrees);
}

std::vector<std::optional<Descriptor>> DescribeCorners(const cv::Mat& gray,
                                                       const std::vector<Eigen::Vector2f>& uv_px,
                                                       const std::vector<float>& angles) {
  std::vector<cv::KeyPoint> corners;
  for (size_t i = 0; i < uv_px.size(); ++i) {
    // ORB drops corners at the border and may reorder the rest; class_id keeps their index.
    corners.emplace_back(uv_px[i].x(), uv_px[i].y(), kPatchSize_px, angles[i], /*response=*/1.0F,
                         /*octave=*/0, /*class_id=*/static_cast<int>(i));
  }
  const auto orb = cv::ORB::create(/*nfeatures=*/500, /*scaleFactor=*/2.0F, /*nlevels=*/1,
                                   /*edgeThreshold=*/kDescriptorBorder_px);
  cv::Mat rows;
  orb->compute(gray, corners, rows);
  std::vector<std::optional<Descriptor>> descriptors(uv_px.size());
  for (size_t row = 0; row < corners.size(); ++row) {
    Descriptor& descriptor = descriptors[corners[row].class_id].emplace();
    std::memcpy(descriptor.data(), rows.ptr(static_cast<int>(row)), sizeof(descriptor));
  }
  return descriptors;
}

}  // namespace plm_vins
