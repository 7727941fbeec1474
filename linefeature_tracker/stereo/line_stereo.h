// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <opencv2/core.hpp>
#include <optional>
#include <vector>

#include "common/config/config.h"
#include "linefeature_tracker/following/line_refinement.h"
#include "linefeature_tracker/segments/line_track.h"
#include "tracking/stereo/camera_pair.h"

namespace plm_vins {

// Finds tracked lines in the image of the second camera. A few points of a line are searched for
// along their epipolar curves. The inverse depth is linear along the image of a line, so a fit to
// most of these points predicts the line in the second camera, where its edge is located as in the
// first image. A line that is almost parallel to the epipolar curves is not matched, since its
// depth is unobservable.
class LineStereo {
 public:
  LineStereo(const LineTrackerConfig& config, const CameraPair& pair);

  // Throws std::invalid_argument if the image is not CV_8UC1 of the calibrated size.
  void CheckImage(const cv::Mat& second) const;

  // Searches in `second` for the tracks of the image `first` with the same timestamp, both CV_8UC1
  // as delivered by the cameras. Sets the tracks' `second` and `inverse_depths`.
  void Match(const cv::Mat& first, const cv::Mat& second, std::vector<LineTrack>* tracks);

 private:
  struct Images {
    const cv::Mat& first;
    const cv::Mat& second;
  };
  // Inverse depth at a fraction of the way from the start of a line to its end [1/m].
  struct LineDepth {
    double share = 0;
    double inverse_depth = 0;
  };
  void MatchOne(const Images& images, LineTrack* track) const;
  bool IsTurn(const LineTrack& track, int interval) const;
  // Inverse depths at the start and the end [1/m].
  std::optional<Eigen::Vector2d> FindDepths(const Images& images, const LineSegment& segment) const;
  // Inverse depth of the point at a share of the way from start to end [1/m].
  std::optional<double> DepthAt(const Images& images, const LineSegment& segment,
                                double share) const;
  Eigen::Vector2d DepthsBy(const LineSegment& second, const LineSegment& segment) const;
  std::optional<Eigen::Vector2d> Agree(const std::vector<LineDepth>& samples) const;
  std::optional<SecondSegment> Locate(const cv::Mat& second, const LineSegment& segment,
                                      const Eigen::Vector2d& inverse_depths) const;

  CameraPair pair_;
  Eigen::Vector3d p_C_S_;  // position of the second camera
  LineRefinement refinement_;
  int64_t searched_ = 0;  // images
  int unsearched_ = 0;    // images of the first camera since then
};

}  // namespace plm_vins
