// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <memory>
#include <opencv2/core.hpp>
#include <optional>

#include "common/camera/camera_model.h"
#include "common/config/config.h"
#include "common/measurements.h"

namespace plm_vins {

// What happened to the corners of one image.
struct PointTrackerStatistics {
  int previous = 0;           // corners to follow
  int flow_lost = 0;          // KLT failed or left the image
  int forward_backward = 0;   // did not come back
  int epipolar_outliers = 0;  // against the epipolar geometry
  int crowded = 0;            // came too close to an older one, or under the mask
  int detected = 0;           // new corners
};

// Follows corners from image to image and refills with new ones (façade of the point front end):
// CLAHE -> KLT with prediction -> forward-backward check -> alignment with the patch that the
// corner was found in -> epipolar RANSAC -> spread -> refill.
class PointTracker {
 public:
  using Features = PointFrame;
  using Statistics = PointTrackerStatistics;

  // No corner lies where the mask forbids it (as of ReadMask()), or the camera has no ray.
  PointTracker(const PointTrackerConfig& config, std::shared_ptr<const CameraModel> camera,
               const cv::Mat& mask = {});
  ~PointTracker();

  // `R_C1_C0` takes directions of the previous camera frame C0 to the current one C1 (from the
  // gyro); without it the corners' own motion predicts. Throws std::invalid_argument where the
  // image is not CV_8UC1 of the calibrated size or its stamp not after the one before; the tracker
  // is then unchanged.
  PointFrame Track(const ImageSample& image, const std::optional<Eigen::Quaterniond>& R_C1_C0);

  void Reset();  // forgets all tracks; ids go on

  // Replaces max_cnt from the next image on; of too many tracks the oldest stay.
  void SetMaxCorners(int count);

  const PointTrackerStatistics& statistics() const;

  // The last image with its tracks drawn (CV_8UC3), coloured by age.
  cv::Mat DrawTracks() const;

 private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace plm_vins
