// SPDX-License-Identifier: BSD-3-Clause
#include "pose_graph/keyframes/keyframe_maker.h"

#include <memory>
#include <vector>

#include "common/camera/ray_transfer.h"
#include "pose_graph/description/corner_description.h"
#include "pose_graph/keyframes/odometry_noise.h"

namespace plm_vins {
namespace {

// Returns the frame with all rays recomputed by the refined camera.
OdometryFrame Refined(const CameraModel& camera, const CameraModel& refined, OdometryFrame frame) {
  for (TrackedCorner& corner : frame.corners) {
    TransferRay(camera, refined, &corner.observation.xy);
  }
  for (TrackedSegment& segment : frame.segments) {
    TransferRay(camera, refined, &segment.observation.start);
    TransferRay(camera, refined, &segment.observation.end);
  }
  return frame;
}

std::vector<DescribedCorner> FollowedCorners(const OdometryFrame& frame) {
  std::vector<DescribedCorner> corners;
  for (const TrackedCorner& tracked : frame.corners) {
    const Eigen::Vector2f uv_px = tracked.observation.uv_px.cast<float>();
    const bool in_image = uv_px.x() >= 0 && uv_px.y() >= 0 && uv_px.x() < frame.gray.cols &&
                          uv_px.y() < frame.gray.rows;
    if (!in_image) continue;
    DescribedCorner& corner = corners.emplace_back();
    corner.track = tracked.observation.id;
    corner.uv_px = uv_px;
    corner.xy = tracked.observation.xy.cast<float>();
    if (tracked.p_O && corner.track >= 0) corner.p_O = tracked.p_O->cast<float>();
  }
  return corners;
}

void AddFoundCorners(const CornerSelectionOptions& options, const CameraModel& camera,
                     const cv::Mat& gray, std::vector<DescribedCorner>* corners) {
  std::vector<Eigen::Vector2f> known_px;
  for (const DescribedCorner& corner : *corners) known_px.push_back(corner.uv_px);
  for (const Eigen::Vector2f& uv_px : SelectCorners(options, gray, known_px)) {
    const auto xy = camera.Unproject(uv_px.cast<double>());
    if (!xy) continue;
    DescribedCorner& corner = corners->emplace_back();
    corner.uv_px = uv_px;
    corner.xy = xy->cast<float>();
  }
}

// Computes the descriptors and removes corners that have none.
void Describe(const CameraModel& camera, const Eigen::Quaterniond& R_O_C, const cv::Mat& gray,
              std::vector<DescribedCorner>* corners) {
  std::vector<Eigen::Vector2f> uv_px;
  std::vector<float> angles;
  for (const DescribedCorner& corner : *corners) {
    uv_px.push_back(corner.uv_px);
    angles.push_back(GravityAngle(camera, R_O_C, corner.xy.cast<double>()));
  }
  const auto descriptors = DescribeCorners(gray, uv_px, angles);
  std::vector<DescribedCorner> described;
  for (size_t i = 0; i < descriptors.size(); ++i) {
    if (!descriptors[i]) continue;
    described.push_back((*corners)[i]);
    described.back().descriptor = *descriptors[i];
  }
  *corners = std::move(described);
}

}  // namespace

Keyframe MakeKeyframe(const CornerSelectionOptions& options, const CameraModel& camera,
                      const OdometryFrame& frame) {
  if (frame.camera && frame.camera->intrinsics() != camera.parameters().intrinsics()) {
    const std::unique_ptr<const CameraModel> refined = CameraModel::Create(*frame.camera);
    return MakeKeyframe(options, *refined, Refined(camera, *refined, frame));
  }
  Keyframe keyframe;
  keyframe.t_ns = frame.t_ns;
  keyframe.T_O_B = frame.T_O_B;
  keyframe.covariance = LevelCovariance(frame.T_O_B, frame.covariance);
  keyframe.T_B_C = frame.T_B_C;
  keyframe.R_O_Manhattan = frame.R_O_Manhattan;
  keyframe.segments = frame.segments;
  keyframe.corners = FollowedCorners(frame);
  AddFoundCorners(options, camera, frame.gray, &keyframe.corners);
  Describe(camera, keyframe.T_O_C().rotation, frame.gray, &keyframe.corners);
  return keyframe;
}

}  // namespace plm_vins
