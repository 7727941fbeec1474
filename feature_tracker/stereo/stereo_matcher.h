// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <opencv2/core.hpp>
#include <optional>
#include <string>
#include <vector>

#include "feature_tracker/following/point_track.h"
#include "tracking/stereo/camera_pair.h"
#include "tracking/stereo/extrinsics_estimate.h"

namespace plm_vins {

// Finds tracked corners in the image of the second camera. Correlates along the epipolar curve,
// from beyond infinity to 0.3 m, and requires a unique match that also holds backwards.
// The match is then aligned with the patch of the track and gated by its distance from the epipolar
// curve. The extrinsics may be off by half a degree, and the second camera late by some
// milliseconds. Both are learned from the matches. Matches are shifted to the first camera's
// timestamp.
class StereoMatcher {
 public:
  explicit StereoMatcher(const CameraPair& pair);

  // Throws std::invalid_argument if the image is not CV_8UC1 of the calibrated size.
  void CheckImage(const cv::Mat& second) const;

  // Searches in `second` for the tracks of the image `first` with the same timestamp, both CV_8UC1
  // as delivered by the cameras. Sets the tracks' `second`; resets it if there is no image.
  void Match(const cv::Mat& first, const cv::Mat& second, std::vector<PointTrack>* tracks);

  const ExtrinsicsEstimate& extrinsics() const { return extrinsics_; }

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
    const cv::Mat& first;
    const cv::Mat& second;
  };
  struct Search {
    PointTrack* track;
    std::optional<Place> place;
    bool is_good = false;  // fits the epipolar curve
  };
  bool IsDue(const PointTrack& track) const;
  void Judge(std::vector<Search>* searches);
  std::optional<Place> Find(const Images& images, const PointTrack& track) const;
  // Search along the whole epipolar curve and back, or only near the last match.
  std::optional<Place> FindAnywhere(const Images& images, const PointTrack& track) const;
  std::optional<Place> FindAgain(const Images& images, const PointTrack& track) const;
  std::optional<Place> Align(const Images& images, const CurvePoint& seed,
                             const PointTrack& track) const;
  Eigen::Vector2d WhenSeen(const PointTrack& track) const;
  Eigen::Vector2d InTime(const StereoMatch& match) const;  // the delay removed
  bool IsLate() const;
  bool IsTrusted() const;
  bool IsSwapped() const;     // points are matched behind the cameras
  bool MayBeSwapped() const;  // then points are also searched for there
  bool IsTurn(const PointTrack& track, int interval) const;
  bool IsBehind(
      const Place& place) const;  // beyond infinity by more than extrinsics errors explain
  // Search range to both sides of the epipolar curve of a track, from infinity to the least depth.
  double Band(const PointTrack& track) const;

  CameraPair stated_;
  CameraPair pair_;  // with the estimated extrinsics
  ExtrinsicsEstimate extrinsics_;
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
