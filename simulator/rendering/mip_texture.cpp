// SPDX-License-Identifier: BSD-3-Clause
#include "simulator/rendering/mip_texture.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <stdexcept>

namespace plm_vins::simulator {
namespace {

// The two texels next to a non-negative coordinate, wrapped around, and the weight of the second
// one.
struct TexelPair {
  int first, second;
  float weight;
};

TexelPair Locate(float position, int count) {
  const float wrapped =
      (position - static_cast<float>(static_cast<int>(position))) * static_cast<float>(count) -
      0.5f;
  const int below = static_cast<int>(wrapped + 1.0f) - 1;  // floor, since wrapped is at least -0.5
  return {below < 0 ? count - 1 : std::min(below, count - 1), below + 1 >= count ? 0 : below + 1,
          wrapped - static_cast<float>(below)};
}

float Mix(float a, float b, float weight) { return a + weight * (b - a); }

}  // namespace

MipTexture::MipTexture(const cv::Mat& image, double width, double height)
    : per_width_(static_cast<float>(1.0 / width)),
      per_height_(static_cast<float>(1.0 / height)),
      texel_(static_cast<float>(height / image.rows)) {
  if (image.empty() || image.type() != CV_8UC1) throw std::invalid_argument("texture is not gray");
  levels_.emplace_back();
  cv::flip(image, levels_.back(), 0);  // row 0 moves to v = 0
  while (levels_.back().cols > 1 || levels_.back().rows > 1) {
    const cv::Mat1b& finer = levels_.back();
    cv::Mat1b coarser;
    cv::resize(finer, coarser, cv::Size((finer.cols + 1) / 2, (finer.rows + 1) / 2), 0, 0,
               cv::INTER_AREA);
    levels_.push_back(coarser);
  }
}

float MipTexture::Sample(float u, float v, float footprint) const {
  const float ratio = footprint / texel_;
  if (ratio <= 1.0f) return SampleLevel(0, u, v);
  const float level = std::min(std::log2(ratio), static_cast<float>(levels_.size() - 1));
  const int finer = static_cast<int>(level);
  const int coarser = std::min(finer + 1, static_cast<int>(levels_.size() - 1));
  return Mix(SampleLevel(finer, u, v), SampleLevel(coarser, u, v),
             level - static_cast<float>(finer));
}

float MipTexture::SampleLevel(int level, float u, float v) const {
  const cv::Mat1b& image = levels_[level];
  const TexelPair x = Locate(u * per_width_, image.cols);
  const TexelPair y = Locate(v * per_height_, image.rows);
  const uchar* lower = image[y.first];
  const uchar* upper = image[y.second];
  return Mix(Mix(lower[x.first], lower[x.second], x.weight),
             Mix(upper[x.first], upper[x.second], x.weight), y.weight) *
         (1.0f / 255.0f);
}

}  // namespace plm_vins::simulator
