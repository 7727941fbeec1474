// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <opencv2/core.hpp>
#include <vector>

namespace plm_vins {

// What keyframes looked like, to be shown when the camera comes back: at half resolution and
// compressed, which takes less memory than the keyframe itself.
class KeyframeImages {
 public:
  // `gray`: CV_8UC1, at full resolution.
  void Add(int keyframe, const cv::Mat& gray);

  // CV_8UC1 at half resolution; empty where there is none, as of the keyframes of a loaded map.
  cv::Mat Find(int keyframe) const;

  // Forgets all others.
  void Keep(const std::function<bool(int keyframe)>& is_kept);

 private:
  std::map<int, std::vector<uint8_t>> compressed_;  // by keyframe
};

}  // namespace plm_vins
