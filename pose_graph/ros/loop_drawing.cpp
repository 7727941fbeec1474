// SPDX-License-Identifier: BSD-3-Clause
#include "pose_graph/ros/loop_drawing.h"

#include <opencv2/imgproc.hpp>
#include <optional>

namespace plm_vins {
namespace {

constexpr double kScale = 0.5;  // size of the drawing relative to the camera images
constexpr int kDiscRadius_px = 3;
constexpr int kLineThickness_px = 2;
const cv::Scalar kCornerColor(80, 220, 80);  // blue, green, red
const cv::Scalar kLineColor(0, 140, 255);

// One half of the drawing, which begins at column `offset_x_px`.
class Half {
 public:
  Half(const CameraModel& camera, double offset_x_px)
      : camera_(camera), offset_px_(offset_x_px, 0) {}

  // Returns the position of the point in the drawing, or nullopt if it is outside the half.
  std::optional<cv::Point2d> Find(const Eigen::Vector3d& p_C) const {
    const auto uv_px = camera_.Project(p_C);
    if (!uv_px || !camera_.IsInImage(*uv_px)) return std::nullopt;
    return cv::Point2d(kScale * uv_px->x(), kScale * uv_px->y()) + offset_px_;
  }

  void DrawSegment(const Eigen::Vector3d& start_C, const Eigen::Vector3d& end_C,
                   cv::Mat* picture) const {
    const auto start = Find(start_C);
    const auto end = Find(end_C);
    if (start && end) cv::line(*picture, *start, *end, kLineColor, kLineThickness_px, cv::LINE_AA);
  }

 private:
  const CameraModel& camera_;
  cv::Point2d offset_px_;
};

cv::Size DrawnSize(const CameraModel& camera) {
  return {cvRound(kScale * camera.parameters().width),
          cvRound(kScale * camera.parameters().height)};
}

void DrawCorners(const LoopObservations& observations, const Half& left, const Half& right,
                 cv::Mat* picture) {
  const Rigid3d T_C_O = observations.T_O1_C.Inverse();
  for (const SeenPoint& point : observations.of_earlier) {
    const auto before = left.Find(T_C_O * point.p_O);
    const auto now = right.Find(point.xy.homogeneous());
    if (!before || !now) continue;
    cv::line(*picture, *before, *now, kCornerColor, 1, cv::LINE_AA);
    cv::circle(*picture, *before, kDiscRadius_px, kCornerColor, cv::FILLED, cv::LINE_AA);
    cv::circle(*picture, *now, kDiscRadius_px, kCornerColor, cv::FILLED, cv::LINE_AA);
  }
}

void DrawLines(const LoopObservations& observations, const Half& left, const Half& right,
               cv::Mat* picture) {
  const Rigid3d T_C_O = observations.T_O1_C.Inverse();
  for (const auto& [line, segment] : observations.lines) {
    left.DrawSegment(T_C_O * line.start_O, T_C_O * line.end_O, picture);
    right.DrawSegment(segment.start.homogeneous(), segment.end.homogeneous(), picture);
  }
}

}  // namespace

cv::Mat DrawLoop(const CameraModels& cameras, const LoopObservations& observations,
                 const cv::Mat& earlier, const cv::Mat& later) {
  const CameraModel& earlier_camera = *cameras[observations.earlier_camera];
  const CameraModel& later_camera = *cameras[observations.later_camera];
  const cv::Rect left_part({0, 0}, DrawnSize(earlier_camera));
  const cv::Rect right_part({left_part.width, 0}, DrawnSize(later_camera));
  cv::Mat gray((left_part | right_part).size(), CV_8UC1, cv::Scalar(0));
  if (!earlier.empty()) cv::resize(earlier, gray(left_part), left_part.size());
  cv::resize(later, gray(right_part), right_part.size(), 0, 0, cv::INTER_AREA);
  cv::Mat picture;
  cv::cvtColor(gray, picture, cv::COLOR_GRAY2BGR);
  const Half left(earlier_camera, 0);
  const Half right(later_camera, right_part.x);
  DrawCorners(observations, left, right, &picture);
  DrawLines(observations, left, right, &picture);
  return picture;
}

}  // namespace plm_vins
