// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <opencv2/core.hpp>
#include <vector>

namespace plm_vins::simulator {

// A grey picture of known size in metres that repeats in both directions, with prefiltered smaller
// copies so that a far surface does not flicker. Immutable.
class MipTexture {
 public:
  // `image` is CV_8UC1, its row 0 at the top (largest v).
  MipTexture(const cv::Mat& image, double width, double height);

  // Brightness, 0 to 1, at (u, v) from the lower left corner, averaged over about `footprint`; all
  // lengths in [m].
  float Sample(float u, float v, float footprint) const;

 private:
  float SampleLevel(int level, float u, float v) const;

  float per_width_, per_height_;  // repetitions per metre
  float texel_;                   // of the full picture [m]
  std::vector<cv::Mat1b> levels_;
};

}  // namespace plm_vins::simulator
