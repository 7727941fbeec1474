// SPDX-License-Identifier: BSD-3-Clause
#include "pose_graph/ros/keyframe_images.h"

#include <iterator>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

namespace plm_vins {
namespace {

constexpr int kJpegQuality = 80;

}  // namespace

void KeyframeImages::Add(const MapImage& image, const cv::Mat& gray) {
  cv::Mat half;
  cv::resize(gray, half, {}, 0.5, 0.5, cv::INTER_AREA);
  cv::imencode(".jpg", half, compressed_[image], {cv::IMWRITE_JPEG_QUALITY, kJpegQuality});
}

cv::Mat KeyframeImages::Find(const MapImage& image) const {
  const auto found = compressed_.find(image);
  if (found == compressed_.end()) return {};
  return cv::imdecode(found->second, cv::IMREAD_GRAYSCALE);
}

void KeyframeImages::Keep(const std::function<bool(int)>& is_kept) {
  for (auto image = compressed_.begin(); image != compressed_.end();) {
    image = is_kept(image->first.keyframe) ? std::next(image) : compressed_.erase(image);
  }
}

}  // namespace plm_vins
