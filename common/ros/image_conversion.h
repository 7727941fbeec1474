// SPDX-License-Identifier: BSD-3-Clause
// Conversion of images to and from ROS messages. Separate from other messages, so that a node
// without images does not load the image libraries.
#pragma once

#include <sensor_msgs/CompressedImage.h>
#include <sensor_msgs/Image.h>

#include <opencv2/core.hpp>
#include <string>

#include "common/measurements.h"

namespace plm_vins {

// Converts a gray image of any encoding that cv_bridge supports (mono8, mono16, bgr8, rgb8, Bayer,
// ...). Throws std::invalid_argument with the encoding if it is not supported or the data do not
// have the size of the image. Pixels that are gray already are shared with the message, which the
// sample then co-owns.
ImageSample ToImageSample(const sensor_msgs::ImageConstPtr& message);
// Copies the pixels, so that the message need not outlive the sample.
ImageSample ToImageSample(const sensor_msgs::Image& message);
ImageSample ToImageSample(const sensor_msgs::CompressedImage& message);

// Depth of encoding 16UC1 or mono16 [mm], or 32FC1 [m]. Throws std::invalid_argument otherwise. The
// sample owns a share of the message.
DepthSample ToDepthSample(const sensor_msgs::ImageConstPtr& message);

// `bgr` is CV_8UC3.
sensor_msgs::ImagePtr ToMessage(const cv::Mat& bgr, int64_t t_ns, const std::string& frame_id);

}  // namespace plm_vins
