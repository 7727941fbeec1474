// SPDX-License-Identifier: BSD-3-Clause
// Bright and dark polygons in a plane, observed by a camera: all edges are known exactly.
#pragma once

#include <Eigen/Geometry>
#include <memory>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <utility>
#include <vector>

#include "common/camera/camera_model.h"
#include "linefeature_tracker/segments/line_segment.h"

namespace plm_vins {

constexpr int64_t kFrame_ns = 50'000'000;

// A pinhole camera without distortion and with the image size of EuRoC's.
inline CameraParameters PlainParameters() {
  CameraParameters parameters;
  parameters.width = 752;
  parameters.height = 480;
  parameters.fx = parameters.fy = 458;
  parameters.cx = 375.5;
  parameters.cy = 239.5;
  return parameters;
}

// Returns PlainParameters() with a distortion that bends straight lines by many pixels.
inline CameraParameters DistortedParameters() {
  CameraParameters parameters = PlainParameters();
  parameters.distortion = {-0.28, 0.074, 0.0002, 0.00002};
  return parameters;
}

class LineScene {
 public:
  LineScene(const CameraParameters& parameters, int background)
      : camera_(CameraModel::Create(parameters)), background_(background) {}

  std::shared_ptr<const CameraModel> camera() const { return camera_; }

  // `corners` are normalized coordinates of the reference view.
  void AddPolygon(std::vector<Eigen::Vector2d> corners, int gray) {
    polygons_.push_back({std::move(corners), gray});
  }

  // Adds a bar around the segment, which is given in pixels of an undistorted reference view.
  void AddBar(const Eigen::Vector2d& start_px, const Eigen::Vector2d& end_px, double width_px,
              int gray) {
    const Eigen::Vector2d side = 0.5 * width_px * LineSegment{start_px, end_px}.Normal();
    std::vector<Eigen::Vector2d> corners;
    for (const Eigen::Vector2d& corner :
         {Eigen::Vector2d(start_px + side), Eigen::Vector2d(end_px + side),
          Eigen::Vector2d(end_px - side), Eigen::Vector2d(start_px - side)}) {
      corners.push_back(ToNormalised(corner));
    }
    AddPolygon(corners, gray);
  }

  Eigen::Vector2d ToNormalised(const Eigen::Vector2d& pixel) const {
    const CameraParameters& p = camera_->parameters();
    return {(pixel.x() - p.cx) / p.fx, (pixel.y() - p.cy) / p.fy};
  }

  // Returns all edges after the homography H of the normalized points.
  std::vector<LineSegment> Edges(const Eigen::Matrix3d& H = Eigen::Matrix3d::Identity()) const {
    std::vector<LineSegment> edges;
    for (const Polygon& polygon : polygons_) {
      for (size_t i = 0; i < polygon.corners.size(); ++i) {
        const Eigen::Vector2d& next = polygon.corners[(i + 1) % polygon.corners.size()];
        edges.push_back({Move(H, polygon.corners[i]), Move(H, next)});
      }
    }
    return edges;
  }

  // Renders the image by drawing at high resolution and averaging (fillPoly enlarges polygons by
  // half a fine pixel, 0.06 px of the image), optionally with noise of `noise` gray levels.
  cv::Mat View(const Eigen::Matrix3d& H = Eigen::Matrix3d::Identity(), double noise = 0) const {
    const CameraParameters& p = camera_->parameters();
    cv::Mat fine(kFineness * p.height, kFineness * p.width, CV_8UC1, cv::Scalar(background_));
    for (const Polygon& polygon : polygons_) {
      const std::vector<std::vector<cv::Point>> outline = {Outline(polygon, H)};
      cv::fillPoly(fine, outline, cv::Scalar(polygon.gray), cv::LINE_8, kShift);
    }
    cv::Mat image;
    cv::resize(fine, image, {p.width, p.height}, 0, 0, cv::INTER_AREA);
    cv::GaussianBlur(image, image, {}, 0.7);
    if (noise > 0) {
      cv::Mat disturbance(image.size(), CV_16S);
      cv::RNG(7).fill(disturbance, cv::RNG::NORMAL, 0.0, noise);
      cv::add(image, disturbance, image, cv::noArray(), CV_8U);
    }
    return image;
  }

  static Eigen::Vector2d Move(const Eigen::Matrix3d& H, const Eigen::Vector2d& xy) {
    return (H * xy.homogeneous()).hnormalized();
  }

 private:
  struct Polygon {
    std::vector<Eigen::Vector2d> corners;
    int gray = 0;
  };

  static constexpr int kFineness = 8;
  static constexpr int kShift = 4;           // fractional bits of drawn points
  static constexpr int kPointsPerEdge = 24;  // edges are curved under distortion

  std::vector<cv::Point> Outline(const Polygon& polygon, const Eigen::Matrix3d& H) const {
    std::vector<cv::Point> outline;
    for (size_t i = 0; i < polygon.corners.size(); ++i) {
      const Eigen::Vector2d& from = polygon.corners[i];
      const Eigen::Vector2d& to = polygon.corners[(i + 1) % polygon.corners.size()];
      for (int k = 0; k < kPointsPerEdge; ++k) {
        const double share = static_cast<double>(k) / kPointsPerEdge;
        const Eigen::Vector2d xy = Move(H, from + share * (to - from));
        const auto pixel = camera_->Project(xy.homogeneous());
        if (!pixel) continue;
        const Eigen::Vector2d fine =
            (1 << kShift) *
            (kFineness * (*pixel + Eigen::Vector2d(0.5, 0.5)) - Eigen::Vector2d(0.5, 0.5));
        outline.emplace_back(cvRound(fine.x()), cvRound(fine.y()));
      }
    }
    return outline;
  }

  std::shared_ptr<const CameraModel> camera_;
  int background_;
  std::vector<Polygon> polygons_;
};

// Largest distance of the found line's endpoints from the infinite edge, in pixels at the image
// center.
inline double NormalErrorInPixels(const LineSegment& edge, const LineSegment& found, double focal) {
  return focal * std::max(std::abs(edge.Distance(found.start)), std::abs(edge.Distance(found.end)));
}

}  // namespace plm_vins
