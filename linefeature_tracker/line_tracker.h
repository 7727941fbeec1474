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

// What happened to the lines of one image.
struct LineTrackerStatistics {
  int previous = 0;         // lines to follow
  int match_lost = 0;       // flow failed or looks different; LBD: no match
  int inconsistent = 0;     // too far from the prediction
  int edge_lost = 0;        // no edge, too short a one, out of sight or masked, where the flow led
  int duplicates = 0;       // came to lie on an older one
  bool detected = false;    // this image was searched for new lines
  int fragments = 0;        // found by the detector
  int candidates = 0;       // of them, after joining and the length filter
  int added = 0;            // new lines
  double detection_ms = 0;  // [ms], for reports only
};

// Follows line segments from image to image and refills with new ones (façade of the line front
// end). Flow: predict -> align -> gate -> refine -> drop duplicates -> detect where lines are
// missing. LBD: detect -> refine -> describe -> match around the prediction -> refill.
//
// A line's direction start -> end is fixed by its brighter side and never flips along a track.
class LineTracker {
 public:
  using Features = LineFrame;
  using Statistics = LineTrackerStatistics;

  // Lines end where the mask begins to forbid them: as of ReadMask().
  LineTracker(const LineTrackerConfig& config, std::shared_ptr<const CameraModel> camera,
              const cv::Mat& mask = {});
  ~LineTracker();

  // `R_C1_C0` takes directions of the previous camera frame C0 to the current one C1 (from the
  // gyro); without it the lines' own motion predicts. Throws std::invalid_argument where the image
  // is not CV_8UC1 of the calibrated size or its stamp not after the one before; the tracker is
  // then unchanged.
  LineFrame Track(const ImageSample& image, const std::optional<Eigen::Quaterniond>& R_C1_C0);

  void Reset();  // forgets all lines; ids go on

  // Replaces max_line_cnt from the next image on; of too many lines the oldest stay.
  void SetMaxLines(int count);

  const LineTrackerStatistics& statistics() const;

  // The last image with its lines drawn (CV_8UC3), coloured by age.
  cv::Mat DrawTracks() const;

 private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace plm_vins
