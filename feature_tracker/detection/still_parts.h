// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <deque>
#include <memory>
#include <opencv2/core.hpp>
#include <optional>
#include <string>
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
// images may not belong to the scene. They are masked only if many tracks lie on them while other
// parts of the image move, because a biased gyroscope shows a rotation at standstill as well; and
// only if they stood still in the last turn about another axis or to the other side as well,
// because near points stand still for a moment where turning and flying past cancel. One comparison
// finds about five of six dots, because some coincide with edges of the scene. So a part stays
// masked until two comparisons in turn see it move.
class StillParts {
 public:
  explicit StillParts(std::shared_ptr<const CameraModel> camera) : camera_(std::move(camera)) {}

  // Adds the next image, the rotation from the previous camera frame to its own (nullopt if
  // unknown), and the corners that were tracked into it [px].
  void Add(const ImageSample& image, const std::optional<Eigen::Quaterniond>& R_now_then,
           const std::vector<cv::Point2f>& corners);

  // CV_8UC1, zero where the image stands still; empty if nothing does.
  const cv::Mat& moving() const { return moving_; }

  // Returns what stood still and what to do; an empty string if nothing was masked, or if what
  // stood still has vanished.
  std::string Finding() const;

  // Masks from the first image on what another run over the same images found.
  void LearnFrom(const StillParts& earlier);

  // Returns whether something was masked that was not known from the first image on.
  bool has_learned() const { return has_learned_; }

  void Reset();

 private:
  struct Past {
    ImageSample image;
    Eigen::Quaterniond R_now_then;
  };

  // Result of a comparison.
  struct Turn {
    Eigen::Vector3d axis;  // of the rotation
    cv::Mat still;         // CV_8UC1: not zero where the image stands still; empty if nowhere
  };

  // Returns the newest image from which the camera has turned far enough, or null.
  const Past* FindReference() const;
  bool Turns(const Eigen::Quaterniond& R_now_then, const cv::Point& pixel) const;
  double StandingShare(const Past& reference, const cv::Mat& gray,
                       const std::vector<cv::Point2f>& corners) const;
  // Returns the cells of the image (CV_8UC1) in which a rotation moves the scene by many pixels.
  cv::Mat TurnedCells(const Eigen::Quaterniond& R_now_then) const;
  // Returns whether the camera moves in the world: a biased gyroscope turns at standstill as well.
  bool CameraMoves(const Past& reference, const cv::Mat& gray, const cv::Mat& turned) const;
  void Compare(const Past& reference, const cv::Mat& gray, const cv::Mat& turned,
               const std::vector<cv::Point2f>& corners);
  // Returns the parts that stand still in this turn and did so in the last turn about another axis,
  // or are masked already.
  cv::Mat Lasting(const Turn& turn) const;
  void Remember(Turn turn);

  std::shared_ptr<const CameraModel> camera_;
  std::deque<Past> past_;  // oldest first
  std::optional<int64_t> compared_ns_;
  std::deque<Turn> turns_;  // the newest first
  cv::Mat still_;   // CV_8UC1: not zero in parts that stand still, without their surroundings
  cv::Mat moving_;  // all but still_ and its surroundings
  cv::Mat moved_;   // CV_8UC1: not zero where the newest comparison saw the image move
  bool has_learned_ = false;
  double largest_share_ = 0;  // of the corners that stood still in an image
  double still_area_ = 0;     // share of the image where the scene moves, with largest_share_
};

}  // namespace plm_vins
