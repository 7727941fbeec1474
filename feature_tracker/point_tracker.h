// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <memory>
#include <opencv2/core.hpp>
#include <optional>
#include <string>

#include "common/camera/camera_model.h"
#include "common/config/config.h"
#include "common/measurements.h"
#include "tracking/other_views.h"
#include "tracking/stereo/camera_pair.h"

namespace plm_vins {

// Statistics of tracking one image.
struct PointTrackerStatistics {
  int previous = 0;           // tracks before this image
  int flow_lost = 0;          // flow failed or left the image
  int forward_backward = 0;   // failed the forward-backward check
  int epipolar_outliers = 0;  // rejected by the epipolar RANSAC
  int crowded = 0;            // too close to an older track, or masked
  int detected = 0;           // new corners
};

// Facade of the point front end. Tracks corners from image to image and adds new ones: CLAHE -> KLT
// with prediction -> forward-backward check -> alignment with the patch of the corner's detection
// -> epipolar RANSAC -> spacing -> detection.
class PointTracker {
 public:
  using Features = PointFrame;
  using Statistics = PointTrackerStatistics;

  // Corners are restricted to pixels that `mask` (see ReadMask()) allows and that have a ray. With
  // a `pair`, whose first camera is `camera`, corners are matched in the second camera, too. In the
  // frames of the tracker these cameras have the numbers 0 and 1.
  PointTracker(const PointTrackerConfig& config, std::shared_ptr<const CameraModel> camera,
               const cv::Mat& mask = {}, const std::optional<CameraPair>& pair = {});
  ~PointTracker();

  // `R_now_then` rotates the previous camera frame to the current one (from the gyroscope); if
  // nullopt, the tracks' own motion predicts. Throws std::invalid_argument if an image has a wrong
  // type or size or the timestamp does not increase; the tracker is then unchanged.
  PointFrame Track(const ImageSample& image, const std::optional<Eigen::Quaterniond>& R_now_then,
                   const OtherViews& others = {});

  void Reset();  // drops all tracks; ids continue

  const PointTrackerStatistics& statistics() const;

  // Describes what seems to be wrong with the pair, or with depth images, and what to do; empty if
  // nothing is.
  std::string PairFinding() const;

  // Describes parts of the image that stand still while the camera moves; empty if there are none.
  std::string StillPartsFinding() const;

  // Masks from the first image on what another tracker found to stand still in the same images.
  void LearnFrom(const PointTracker& earlier);

  // Returns whether parts of the image were masked after the first image.
  bool HasLearned() const;

  // Returns the last image with its tracks drawn (CV_8UC3), colored by age.
  cv::Mat DrawTracks() const;

 private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace plm_vins
