// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <opencv2/core.hpp>
#include <vector>

namespace plm_vins::simulator {

// A gray texture of known size [m], repeated in both directions, with a mipmap pyramid to avoid
// aliasing of distant surfaces. Immutable.
class MipTexture {
 public:
  // `image` is CV_8UC1 with row 0 at the top (largest v).
  MipTexture(const cv::Mat& image, double width, double height);

  // Returns the brightness, 0 to 1, at (u, v) from the lower left corner, averaged over about
  // `footprint`. All lengths are in [m].
  float Sample(float u, float v, float footprint) const;

 private:
  float SampleLevel(int level, float u, float v) const;

  float per_width_, per_height_;  // repetitions per meter
  float texel_;                   // at full resolution [m]
  std::vector<cv::Mat1b> levels_;
};

}  // namespace plm_vins::simulator
