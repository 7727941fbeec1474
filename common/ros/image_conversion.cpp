// SPDX-License-Identifier: BSD-3-Clause
#include "common/ros/image_conversion.h"

#include <cv_bridge/cv_bridge.h>
#include <sensor_msgs/image_encodings.h>

#include <boost/make_shared.hpp>
#include <cstdint>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "common/io/gray_image.h"
#include "common/ros/geometry_conversion.h"

namespace plm_vins {
namespace {

// Validates the size, since cv_bridge computes it in 32 bits: an overflow by a large row step would
// make it read behind the message.
void CheckSize(const sensor_msgs::Image& image) {
  namespace encodings = sensor_msgs::image_encodings;
  const auto pixel_bits = static_cast<uint64_t>(encodings::numChannels(image.encoding)) *
                          static_cast<uint64_t>(encodings::bitDepth(image.encoding));
  const uint64_t row = uint64_t{image.width} * pixel_bits / 8;
  if (image.step >= row && uint64_t{image.height} * image.step == image.data.size()) return;
  throw std::invalid_argument(std::to_string(image.data.size()) + " bytes of data do not match " +
                              std::to_string(image.height) + " rows of " +
                              std::to_string(image.step) + " bytes with " +
                              std::to_string(image.width) + " pixels");
}

// Swaps the bytes of big-endian 16-bit pixels, which cv_bridge would interpret as two channels of 8
// bits.
sensor_msgs::ImageConstPtr LowByteFirst(const sensor_msgs::ImageConstPtr& message) {
  namespace encodings = sensor_msgs::image_encodings;
  if (!message->is_bigendian || encodings::bitDepth(message->encoding) != 16) return message;
  const auto turned = boost::make_shared<sensor_msgs::Image>(*message);
  turned->is_bigendian = 0;
  for (size_t row = 0; row < turned->data.size(); row += turned->step) {
    for (size_t i = 0; i + 1 < turned->step; i += 2) {
      std::swap(turned->data[row + i], turned->data[row + i + 1]);
    }
  }
  return turned;
}

// Shares the pixels of a gray message. Some drivers name only the OpenCV type of gray images, which
// cv_bridge cannot convert to mono8.
cv_bridge::CvImageConstPtr ToGray(const sensor_msgs::ImageConstPtr& message) {
  namespace encodings = sensor_msgs::image_encodings;
  const std::string& encoding = message->encoding;
  if (encoding == encodings::TYPE_8UC1) return cv_bridge::toCvShare(message, encoding);
  if (encoding != encodings::TYPE_16UC1) return cv_bridge::toCvShare(message, encodings::MONO8);
  const auto gray = boost::make_shared<cv_bridge::CvImage>();
  cv_bridge::toCvShare(message, encoding)->image.convertTo(gray->image, CV_8U, 255.0 / 65535.0);
  return gray;
}

// Returns an empty image on failure. OpenCV throws if the header claims too large an image.
cv::Mat Decode(const std::vector<uint8_t>& bytes) {
  if (bytes.empty()) return {};
  try {
    return cv::imdecode(bytes, kReadGrayAsStored);
  } catch (const std::exception&) {  // cv::Exception or std::bad_alloc
    return {};
  }
}

}  // namespace

ImageSample ToImageSample(const sensor_msgs::ImageConstPtr& message) {
  try {
    CheckSize(*message);
    const cv_bridge::CvImageConstPtr gray = ToGray(LowByteFirst(message));
    if (gray->image.type() != CV_8UC1) {
      throw std::invalid_argument("cv_bridge does not convert it to 8-bit gray");
    }
    return {ToNanoseconds(message->header.stamp), gray->image,
            std::make_shared<cv_bridge::CvImageConstPtr>(gray)};
  } catch (const std::exception& error) {  // exceptions of cv_bridge, OpenCV and others
    throw std::invalid_argument("image of encoding '" + message->encoding +
                                "' cannot be converted to gray: " + error.what());
  }
}

ImageSample ToImageSample(const sensor_msgs::Image& message) {
  const sensor_msgs::ImageConstPtr borrowed(&message, [](const sensor_msgs::Image*) {});
  const ImageSample sample = ToImageSample(borrowed);
  return {sample.t_ns, sample.gray.clone(), nullptr};
}

ImageSample ToImageSample(const sensor_msgs::CompressedImage& message) {
  const cv::Mat gray = Decode(message.data);
  if (gray.empty()) {
    throw std::invalid_argument("compressed image of format '" + message.format +
                                "' cannot be decoded");
  }
  return {ToNanoseconds(message.header.stamp), gray, nullptr};
}

DepthSample ToDepthSample(const sensor_msgs::ImageConstPtr& message) {
  namespace encodings = sensor_msgs::image_encodings;
  const std::string& encoding = message->encoding;
  try {
    CheckSize(*message);
    const bool is_integer = encoding == encodings::TYPE_16UC1 || encoding == encodings::MONO16;
    if (!is_integer && encoding != encodings::TYPE_32FC1) {
      throw std::invalid_argument("supported are 16UC1 [mm] and 32FC1 [m]; check depth_topic");
    }
    const auto depth = cv_bridge::toCvShare(LowByteFirst(message));
    return {ToNanoseconds(message->header.stamp), depth->image,
            std::make_shared<cv_bridge::CvImageConstPtr>(depth)};
  } catch (const std::exception& error) {
    throw std::invalid_argument("depth image of encoding '" + encoding +
                                "' cannot be read: " + error.what());
  }
}

sensor_msgs::ImagePtr ToMessage(const cv::Mat& bgr, int64_t t_ns, const std::string& frame_id) {
  return cv_bridge::CvImage(MakeHeader(t_ns, frame_id), sensor_msgs::image_encodings::BGR8, bgr)
      .toImageMsg();
}

}  // namespace plm_vins
