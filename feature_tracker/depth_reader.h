// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <opencv2/core.hpp>
#include <optional>
#include <string>
#include <vector>

#include "feature_tracker/following/point_track.h"

namespace plm_vins {

// Returns the depth [m] at a pixel of a depth image (see DepthSample), whose integers have the
// given unit [m]: the median of the 3 x 3 values around it. Returns nullopt if the pixel is outside
// the image, or if values are missing or differ, as they do at the edge of an object.
std::optional<double> DepthAt(const cv::Mat& depth, const cv::Point2f& pixel, double unit);

// Reads the depths of tracked corners from depth images, and detects images without a
// measurement: without a valid value at any corner, or with one value at all of them. Those of the
// second kind are not used.
class DepthReader {
 public:
  // Sets the tracks' depth. `image` is as DepthSample has it, empty if there is none; `unit` is
  // that of its integers [m].
  void Read(const cv::Mat& image, double unit, std::vector<PointTrack>* tracks);

  // Describes what is wrong with the images of the last second, and what to do; empty if all is
  // well.
  std::string Finding() const;

 private:
  int without_ = 0, constant_ = 0;  // consecutive images
  double constant_depth_ = 0;       // [m]
};

}  // namespace plm_vins
