// SPDX-License-Identifier: BSD-3-Clause
#include "pose_graph/keyframes/keyframe_maker.h"

#include <utility>
#include <vector>

#include "common/append.h"
#include "common/camera/ray_transfer.h"
#include "pose_graph/description/corner_description.h"
#include "pose_graph/keyframes/odometry_noise.h"

namespace plm_vins {
namespace {

// Returns the models of the refined cameras, or those given of cameras that are not refined.
CameraModels RefinedModels(const CameraModels& cameras, const OdometryFrame& frame) {
  CameraModels refined = cameras;
  for (size_t i = 0; i < frame.refined.size(); ++i) {
    if (frame.refined[i].intrinsics() == cameras[i]->parameters().intrinsics()) continue;
    refined[i] = CameraModel::Create(frame.refined[i]);
  }
  return refined;
}

// Recomputes a ray of `camera` by the refined model.
void Transfer(const CameraModels& cameras, const CameraModels& refined, int camera,
              Eigen::Vector2d* xy) {
  if (refined[camera] != cameras[camera]) TransferRay(*cameras[camera], *refined[camera], xy);
}

// Returns the tracked corners in the images, whose rays are those of `cameras`.
std::vector<DescribedCorner> FollowedCorners(const CameraModels& cameras,
                                             const CameraModels& refined,
                                             const OdometryFrame& frame) {
  std::vector<DescribedCorner> corners;
  for (const TrackedCorner& tracked : frame.corners) {
    const int camera = tracked.observation.camera;
    const auto image = frame.images.find(camera);
    if (image == frame.images.end()) continue;
    const Eigen::Vector2f uv_px = tracked.observation.uv_px.cast<float>();
    const cv::Mat& gray = image->second.gray;
    const bool in_image =
        uv_px.x() >= 0 && uv_px.y() >= 0 && uv_px.x() < gray.cols && uv_px.y() < gray.rows;
    if (!in_image) continue;
    Eigen::Vector2d xy = tracked.observation.xy;
    Transfer(cameras, refined, camera, &xy);
    DescribedCorner& corner = corners.emplace_back();
    corner.track = tracked.observation.id;
    corner.camera = camera;
    corner.uv_px = uv_px;
    corner.xy = xy.cast<float>();
    if (tracked.p_O && corner.track >= 0) corner.p_O = tracked.p_O->cast<float>();
  }
  return corners;
}

// Returns the tracked segments in the images, whose rays are those of `cameras`.
std::vector<TrackedSegment> FollowedSegments(const CameraModels& cameras,
                                             const CameraModels& refined,
                                             const OdometryFrame& frame) {
  std::vector<TrackedSegment> segments;
  for (TrackedSegment segment : frame.segments) {
    LineObservation& seen = segment.observation;
    if (frame.images.count(seen.camera) == 0) continue;
    Transfer(cameras, refined, seen.camera, &seen.start);
    Transfer(cameras, refined, seen.camera, &seen.end);
    segments.push_back(segment);
  }
  return segments;
}

// Adds corners of the image of camera number `number`, whose corners `corners` are.
void AddFoundCorners(const CornerSelectionOptions& options, const CameraModel& camera, int number,
                     const cv::Mat& gray, std::vector<DescribedCorner>* corners) {
  std::vector<Eigen::Vector2f> known_px;
  for (const DescribedCorner& corner : *corners) known_px.push_back(corner.uv_px);
  for (const Eigen::Vector2f& uv_px : SelectCorners(options, gray, known_px)) {
    const auto xy = camera.Unproject(uv_px.cast<double>());
    if (!xy) continue;
    DescribedCorner& corner = corners->emplace_back();
    corner.camera = number;
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

Keyframe MakeKeyframe(const CornerSelectionOptions& options, const CameraModels& cameras,
                      const OdometryFrame& frame) {
  const CameraModels refined = RefinedModels(cameras, frame);
  Keyframe keyframe;
  keyframe.t_ns = frame.t_ns;
  keyframe.T_O_B = frame.T_O_B;
  keyframe.covariance = LevelCovariance(frame.T_O_B, frame.covariance);
  keyframe.T_B_C = frame.T_B_C;
  keyframe.segments = FollowedSegments(cameras, refined, frame);
  keyframe.corners = FollowedCorners(cameras, refined, frame);
  std::vector<DescribedCorner> described;
  for (const auto& [camera, image] : frame.images) {
    std::vector<DescribedCorner> corners = keyframe.CornersIn(camera);
    AddFoundCorners(options, *refined[camera], camera, image.gray, &corners);
    Describe(*refined[camera], keyframe.T_O_C(camera).rotation, image.gray, &corners);
    Append(corners, &described);
  }
  keyframe.corners = std::move(described);
  return keyframe;
}

}  // namespace plm_vins
