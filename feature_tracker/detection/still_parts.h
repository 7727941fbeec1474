// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <deque>
#include <memory>
#include <opencv2/core.hpp>
#include <optional>
#include <vector>

#include "common/camera/camera_model.h"
#include "common/measurements.h"

namespace plm_vins {

// Finds the parts of the image that stand still while the camera turns: dots of an infrared
// projector, dirt on the lens, text, parts of the vehicle. Their corners contradict the camera's
// motion, and must not be tracked.
//
// The image is compared with one from up to a second before, since which the camera has turned so
// far that the scene has moved by many pixels. Parts that look equal at the same place in both
// images do not belong to the scene. They are masked only if many tracks lie on them while other
// parts of the image move, because a biased gyroscope shows a rotation at standstill as well.
class StillParts {
 public:
  explicit StillParts(std::shared_ptr<const CameraModel> camera) : camera_(std::move(camera)) {}

  // Adds the next image, the rotation from the previous camera frame to its own (nullopt if
  // unknown), and the corners that were tracked into it [px].
  void Add(const ImageSample& image, const std::optional<Eigen::Quaterniond>& R_now_then,
           const std::vector<cv::Point2f>& corners);

  // CV_8UC1, zero where the image stands still; empty if nothing does.
  const cv::Mat& moving() const { return moving_; }

  // Largest share of the tracks that stood still in an image; zero if they were never masked, or
  // if what stood still has vanished.
  double largest_share() const { return largest_share_; }

  void Reset();

 private:
  struct Past {
    ImageSample image;
    Eigen::Quaterniond R_now_then;
  };

  // Returns the newest image from which the camera has turned far enough, or null.
  const Past* FindReference() const;
  bool Turns(const Eigen::Quaterniond& R_now_then, const cv::Point& pixel) const;
  double StandingShare(const Past& reference, const cv::Mat& gray,
                       const std::vector<cv::Point2f>& corners) const;
  // Returns the cells of the image (CV_8UC1) in which a rotation moves the scene by many pixels.
  cv::Mat TurnedCells(const Eigen::Quaterniond& R_now_then) const;
  void Compare(const Past& reference, const cv::Mat& gray, double standing_share);

  std::shared_ptr<const CameraModel> camera_;
  std::deque<Past> past_;  // oldest first
  std::optional<int64_t> compared_ns_;
  cv::Mat moving_;
  double largest_share_ = 0;
  double still_area_ = 0;  // share of the image where the scene moves, with largest_share_
};

}  // namespace plm_vins
