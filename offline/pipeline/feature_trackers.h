// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <opencv2/core.hpp>
#include <optional>
#include <string>

#include "common/config/config.h"
#include "common/measurements.h"
#include "feature_tracker/point_tracking_stage.h"
#include "linefeature_tracker/line_tracking_stage.h"

namespace plm_vins {

// The features of one image. Points and lines have its timestamp and the flags of ReadyImage.
struct TrackedFeatures {
  TrackedPoints points;
  std::optional<TrackedLines> lines;  // nullopt if lines are not used
};

// The trackers of points and, if used, lines, which process the same images.
class FeatureTrackers {
 public:
  explicit FeatureTrackers(const Config& config);

  // Sets whether the lines of an image are tracked in a separate thread, concurrently with its
  // points. The results are the same.
  void TrackSideBySide(bool side_by_side) { side_by_side_ = side_by_side; }

  void AddImu(const ImuSample& sample);
  void AddImage(int camera, const ImageSample& image);
  void AddDepth(const DepthSample& image);
  std::optional<TrackedFeatures> Pop();
  std::optional<TrackedFeatures> Flush();

  // See TrackingStage.
  void LearnFrom(const FeatureTrackers& earlier) { points_.LearnFrom(earlier.points_); }
  bool HasLearned() const { return points_.HasLearned(); }

  std::string PairFinding() const { return points_.Finding(&PointTracker::PairFinding); }
  std::string StillPartsFinding() const {
    return points_.Finding(&PointTracker::StillPartsFinding);
  }
  const ImageCounts& image_counts() const { return points_.counts(); }

  // The newest image of camera 0 with its points or lines drawn (CV_8UC3); empty if there are none.
  cv::Mat DrawPoints() const { return points_.DrawTracks(); }
  cv::Mat DrawLines() const { return lines_ ? lines_->DrawTracks() : cv::Mat(); }

 private:
  template <typename TrackOne>
  std::optional<TrackedFeatures> TrackBoth(const TrackOne& track);

  PointTrackingStage points_;
  std::optional<LineTrackingStage> lines_;
  bool side_by_side_ = false;
};

}  // namespace plm_vins
