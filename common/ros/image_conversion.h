// SPDX-License-Identifier: BSD-3-Clause
// Images to ROS messages and back. Apart from other messages: a node that takes no images loads
// none of the libraries that read them.
#pragma once

#include <sensor_msgs/CompressedImage.h>
#include <sensor_msgs/Image.h>

#include <opencv2/core.hpp>
#include <string>

#include "common/measurements.h"

namespace plm_vins {

// Grey image of any encoding that cv_bridge can turn into one (mono8, mono16, bgr8, rgb8, Bayer,
// ...). Throws std::invalid_argument that names the encoding where there is no way, or where the
// bytes are not those of an image of that size. Pixels that are grey already stay where they are:
// the sample then owns a share of the message.
ImageSample ToImageSample(const sensor_msgs::ImageConstPtr& message);
// The same from a message that may go: with pixels of its own.
ImageSample ToImageSample(const sensor_msgs::Image& message);
ImageSample ToImageSample(const sensor_msgs::CompressedImage& message);

// A picture of type CV_8UC3 (BGR).
sensor_msgs::ImagePtr ToMessage(const cv::Mat& bgr, int64_t t_ns, const std::string& frame_id);

}  // namespace plm_vins
