// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <opencv2/core.hpp>
#include <optional>
#include <string>
#include <vector>

#include "feature_tracker/point_track.h"
#include "tracking/stereo/camera_pair.h"
#include "tracking/stereo/mounting_estimate.h"

namespace plm_vins {

// Finds tracked corners in the image of the second camera: correlation along the epipolar curve,
// from beyond infinity to 0.3 m, with a check for uniqueness and one from right to left; alignment
// with the patch that the track is aligned with in the first image; distance from the epipolar
// curve. The mounting may be off by half a degree, and the second camera late by some milliseconds:
// both are learned from the matches, and matches are given as of the first camera's timestamp.
class StereoMatcher {
 public:
  explicit StereoMatcher(const CameraPair& pair);

  // Throws std::invalid_argument where the image is not CV_8UC1 of the calibrated size.
  void CheckRight(const cv::Mat& right) const;

  // Searches in `right` for the tracks of the image `left` of the same stamp, both CV_8UC1 as they
  // came from the cameras. Sets the tracks' `right` and `right_search`.
  void Match(const cv::Mat& left, const cv::Mat& right, std::vector<PointTrack>* tracks);

  const MountingEstimate& mounting() const { return mounting_; }

  // Describes what seems to be wrong with the second camera, and what to do; empty if nothing is.
  std::string Finding() const;

 private:
  struct Place {
    StereoMatch match;
    Eigen::Vector2d pixel;  // in the second camera
    // [1/m]; negative if the rays of both cameras meet behind them.
    double inverse_depth = 0;
  };
  struct Images {
    const cv::Mat& left;
    const cv::Mat& right;
  };
  struct Search {
    PointTrack* track;
    std::optional<Place> place;
  };
  bool IsDue(const PointTrack& track) const;
  void Judge(std::vector<Search>* searches);
  std::optional<Place> Find(const Images& images, const PointTrack& track) const;
  // Searches all along the epipolar curve, and back; or only where the last match leads to.
  std::optional<Place> FindAnywhere(const Images& images, const PointTrack& track) const;
  std::optional<Place> FindAgain(const Images& images, const PointTrack& track) const;
  std::optional<Place> Align(const Images& images, const CurvePoint& seed,
                             const PointTrack& track) const;
  Eigen::Vector2d WhenSeen(const PointTrack& track) const;
  Eigen::Vector2d InTime(const StereoMatch& match) const;  // if the second camera were
  bool IsLate() const;
  bool IsTrusted() const;
  bool IsTurn(const PointTrack& track, int interval) const;
  bool IsBehind(const Place& place) const;  // more than a turned mounting explains
  double band_px() const;

  CameraPair stated_;
  CameraPair pair_;  // as the mounting is estimated to be
  MountingEstimate mounting_;
  // Shares of the searches in the last images.
  struct Shares {
    double found = 0;
    double behind = 0;  // matched beyond infinity
  };
  std::optional<Shares> shares_;
  int64_t searched_ = 0;  // images
  int unsearched_ = 0;    // images of the first camera since then
};

}  // namespace plm_vins
