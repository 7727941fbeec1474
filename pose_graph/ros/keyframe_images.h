// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <opencv2/core.hpp>
#include <vector>

#include "pose_graph/keyframes/keyframe.h"

namespace plm_vins {

// Stores keyframe images for the display of loops, at half resolution and compressed; they take
// less memory than the keyframes themselves.
class KeyframeImages {
 public:
  // `gray` is CV_8UC1 at full resolution.
  void Add(const MapImage& image, const cv::Mat& gray);

  // Returns CV_8UC1 at half resolution; empty if not stored, as for keyframes of a loaded map.
  cv::Mat Find(const MapImage& image) const;

  // Deletes the images of all other keyframes.
  void Keep(const std::function<bool(int keyframe)>& is_kept);

 private:
  std::map<MapImage, std::vector<uint8_t>> compressed_;
};

}  // namespace plm_vins
