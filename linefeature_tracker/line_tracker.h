// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <memory>
#include <opencv2/core.hpp>
#include <optional>

#include "common/camera/camera_model.h"
#include "common/config/config.h"
#include "common/measurements.h"
#include "tracking/other_views.h"
#include "tracking/stereo/camera_pair.h"

namespace plm_vins {

// Statistics of tracking one image.
struct LineTrackerStatistics {
  int previous = 0;         // tracks before this image
  int match_lost = 0;       // flow failed or changed appearance
  int inconsistent = 0;     // too far from the prediction
  int edge_lost = 0;        // no edge at the result of the flow, or too short, outside or masked
  int duplicates = 0;       // coincides with an older track
  bool detected = false;    // lines were detected in this image
  int fragments = 0;        // detected fragments
  int candidates = 0;       // lines after joining and the length filter
  int added = 0;            // new tracks
  double detection_ms = 0;  // [ms], for statistics only
};

// Facade of the line front end. Tracks line segments from image to image and adds new ones:
// predict -> align -> gate -> refine -> drop duplicates -> detect if lines are missing.
//
// The direction of a line (start to end) follows from its brighter side and never flips along a
// track.
class LineTracker {
 public:
  using Features = LineFrame;
  using Statistics = LineTrackerStatistics;

  // Lines are cut off where `mask` (see ReadMask()) excludes pixels. With a `pair`, whose first
  // camera is `camera`, lines are matched in the second camera, too. In the frames of the tracker
  // these cameras have the numbers 0 and 1.
  LineTracker(const LineTrackerConfig& config, std::shared_ptr<const CameraModel> camera,
              const cv::Mat& mask = {}, const std::optional<CameraPair>& pair = {});
  ~LineTracker();

  // `R_now_then` rotates the previous camera frame to the current one (from the gyroscope); if
  // nullopt, the tracks' own motion predicts. Throws std::invalid_argument if an image is not
  // CV_8UC1 of the calibrated size or the timestamp does not increase; the tracker is then
  // unchanged.
  LineFrame Track(const ImageSample& image, const std::optional<Eigen::Quaterniond>& R_now_then,
                  const OtherViews& others = {});

  void Reset();  // drops all tracks; ids continue

  const LineTrackerStatistics& statistics() const;

  // Returns the last image with its tracks drawn (CV_8UC3), colored by age.
  cv::Mat DrawTracks() const;

 private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace plm_vins
